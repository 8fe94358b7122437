// SPDX-License-Identifier: Apache-2.0
#include "models/step_text.h"

#include <fmt/format.h>

#include <cctype>
#include <cstdlib>

namespace oriel::models {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// The end of a string or a comment that begins there; the same place if none does.
std::size_t end_of_quoted(std::string_view text, std::size_t at) {
  if (text[at] == '\'') {
    const std::size_t end = text.find('\'', at + 1);  // a doubled quote begins another string
    return end == text.npos ? text.size() : end + 1;
  }
  if (text.substr(at, 2) == "/*") {
    const std::size_t end = text.find("*/", at + 2);
    return end == text.npos ? text.size() : end + 2;
  }
  return at;
}

/// Without comments.
std::string uncommented(std::string_view text) {
  if (text.find("/*") == text.npos) return std::string(text);
  std::string made;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = end_of_quoted(text, i);
    if (end == i)
      made += text[i++];
    else {
      if (text[i] == '\'') made += text.substr(i, end - i);
      i = end;
    }
  }
  return made;
}

/// Splits what stands between parentheses at its commas.
std::vector<std::string> split(std::string_view content) {
  std::vector<std::string> parts;
  if (trimmed(content).empty()) return parts;
  int depth = 0;
  std::size_t start = 0;
  for (std::size_t i = 0; i < content.size();) {
    if (const std::size_t end = end_of_quoted(content, i); end != i) {
      i = end;
      continue;
    }
    const char c = content[i];
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0) {
      parts.emplace_back(trimmed(content.substr(start, i - start)));
      start = i + 1;
    }
    ++i;
  }
  parts.emplace_back(trimmed(content.substr(start)));
  return parts;
}

/// One statement without its semicolon.
void add_entity(std::string_view statement, std::vector<StepEntity>& entities) {
  statement = trimmed(statement);
  const std::size_t equals = statement.find('='), open = statement.find('(');
  if (!statement.starts_with('#') || open == statement.npos || equals > open ||
      !statement.ends_with(')'))
    return;
  StepEntity entity;
  entity.id = step_reference(trimmed(statement.substr(0, equals)));
  for (const char c : trimmed(statement.substr(equals + 1, open - equals - 1)))
    entity.name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  if (entity.id == 0 || entity.name.empty()) return;
  entity.arguments = split(statement.substr(open + 1, statement.size() - open - 2));
  entities.push_back(std::move(entity));
}

}  // namespace

StepFile parse_step(std::string_view text) {
  const std::string clean = uncommented(text);
  const std::string_view all = clean;
  StepFile file;
  const std::size_t data = all.find("DATA;");
  if (data == all.npos) return file;
  constexpr std::size_t kData = 5;
  file.head = all.substr(0, data + kData);
  std::size_t start = data + kData;
  for (std::size_t i = start; i < all.size();) {
    if (const std::size_t end = end_of_quoted(all, i); end != i) {
      i = end;
    } else if (all[i++] == ';') {
      add_entity(all.substr(start, i - 1 - start), file.entities);
      start = i;
    }
  }
  return file;
}

std::string StepFile::text() const {
  std::string made = head + "\n";
  for (const StepEntity& e : entities)
    made += fmt::format("#{}={}({});\n", e.id, e.name, fmt::join(e.arguments, ","));
  return made + "ENDSEC;\nEND-ISO-10303-21;\n";
}

std::vector<std::string> step_list(std::string_view argument) {
  if (argument.size() < 2 || argument.front() != '(' || argument.back() != ')') return {};
  return split(argument.substr(1, argument.size() - 2));
}

std::uint64_t step_reference(std::string_view argument) {
  if (!argument.starts_with('#')) return 0;
  return std::strtoull(std::string(argument.substr(1)).c_str(), nullptr, 10);
}

}  // namespace oriel::models
