// SPDX-License-Identifier: Apache-2.0
// Which requests the server answers: checks of Host and Origin, names of files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oriel::studio {

/// The names under which the server is known.
///
/// Model:   a page of another site must not reach the server. Its requests carry the site's name in
///          Origin, or in Host if the site's name resolves to this machine (DNS rebinding).
/// Checked: StudioServerTest.ForeignHostsAndOriginsAreRefused
class OwnAddress {
 public:
  /// Inputs:  listen: further address that the server listens on; empty or the loopback: none.
  OwnAddress(unsigned short port, const std::string& listen = {});

  bool is_host(std::string_view host) const;
  /// Whether an Origin header names a page of this server; `null` does not.
  bool is_origin(std::string_view origin) const;
  /// For connect-src of the content security policy.
  std::string websocket_sources() const;

 private:
  std::vector<std::string> hosts_;
};

/// What a client has to be told.
enum class Verdict : unsigned short { Accepted = 200, Forbidden = 403, Misdirected = 421 };

/// The headers that decide. Absent headers are null.
struct RequestHeaders {
  const std::string* host = nullptr;
  const std::string* origin = nullptr;
  const std::string* fetch_site = nullptr;  ///< Sec-Fetch-Site
  bool has_token = false;                   ///< the right token in X-Oriel-Token
};

/// Inputs:  sensitive: upgrades and requests below /api/, which need the page's origin or a token.
/// Checked: StudioServerTest.*
Verdict judge(const OwnAddress& own, const RequestHeaders& headers, bool sensitive);

/// Whether `name` can be a file in a folder that clients may name: letters, digits, `.`, `_`, `-`
/// and blanks, not starting with a dot or blank, at most 100 bytes.
/// Checked: RequestChecks.PlainNames
bool is_plain_name(std::string_view name);

/// Decodes %XX. Returns an empty string for invalid or NUL bytes.
std::string percent_decoded(std::string_view text);

/// The value of a parameter of a query `a=b&c=d`, decoded; empty if absent.
std::string query_value(std::string_view query, std::string_view name);

}  // namespace oriel::studio
