// SPDX-License-Identifier: Apache-2.0
#include "studio/request_checks.h"

#include <algorithm>
#include <cctype>

namespace oriel::studio {
namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

int hex_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

bool contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

}  // namespace

OwnAddress::OwnAddress(unsigned short port, const std::string& listen) {
  const std::string suffix = ":" + std::to_string(port);
  hosts_ = {"127.0.0.1" + suffix, "localhost" + suffix, "[::1]" + suffix};
  if (listen.empty()) return;
  const bool is_v6 = listen.find(':') != std::string::npos;
  const std::string host = lower_case(is_v6 ? "[" + listen + "]" : listen) + suffix;
  if (!contains(hosts_, host)) hosts_.push_back(host);
}

bool OwnAddress::is_host(std::string_view host) const {
  return host.size() < 256 && contains(hosts_, lower_case(host));
}

bool OwnAddress::is_origin(std::string_view origin) const {
  constexpr std::string_view kScheme = "http://";
  return origin.starts_with(kScheme) && is_host(origin.substr(kScheme.size()));
}

std::string OwnAddress::websocket_sources() const {
  std::string sources;
  // Content security policies have no literal IPv6 addresses.
  for (const std::string& host : hosts_)
    if (host.front() != '[') sources += (sources.empty() ? "ws://" : " ws://") + host;
  return sources;
}

Verdict judge(const OwnAddress& own, const RequestHeaders& headers, bool sensitive) {
  if (!headers.host || !own.is_host(*headers.host)) return Verdict::Misdirected;
  if (headers.origin && !own.is_origin(*headers.origin)) return Verdict::Forbidden;
  if (headers.fetch_site && lower_case(*headers.fetch_site) == "cross-site")
    return Verdict::Forbidden;
  if (sensitive && !headers.origin && !headers.has_token) return Verdict::Forbidden;
  return Verdict::Accepted;
}

bool is_plain_name(std::string_view name) {
  if (name.empty() || name.size() > 100 || name.front() == '.' || name.front() == ' ') return false;
  return std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '-' ||
           c == ' ';
  });
}

std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return {};
    const int high = hex_value(text[i + 1]), low = hex_value(text[i + 2]);
    if (high < 0 || low < 0 || (high == 0 && low == 0)) return {};
    decoded += static_cast<char>(16 * high + low);
    i += 2;
  }
  return decoded;
}

std::string query_value(std::string_view query, std::string_view name) {
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    const std::size_t equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == name)
      return percent_decoded(pair.substr(equals + 1));
  }
  return {};
}

}  // namespace oriel::studio
