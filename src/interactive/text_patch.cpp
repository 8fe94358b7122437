// SPDX-License-Identifier: Apache-2.0
#include "interactive/text_patch.h"

#include <algorithm>

namespace oriel::interactive {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

bool is_punctuation(char c) {
  return std::string_view("=,(){}[]%").find(c) != std::string_view::npos;
}

char punctuation(std::string_view text, const TextToken& token) {
  return token.kind == TextToken::Kind::Punct ? text[token.begin] : '\0';
}

std::vector<std::string_view> words_of(std::string_view keyword) {
  std::vector<std::string_view> words;
  while (!keyword.empty()) {
    const std::size_t end = std::min(keyword.find(' '), keyword.size());
    if (end > 0) words.push_back(keyword.substr(0, end));
    keyword.remove_prefix(std::min(end + 1, keyword.size()));
  }
  return words;
}

/// Indentation of the line that contains `at`.
std::string indentation(std::string_view text, std::size_t at) {
  const std::size_t line = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
  std::size_t end = line;
  while (end < at && (text[end] == ' ' || text[end] == '\t')) ++end;
  return std::string(text.substr(line, end - line));
}

}  // namespace

bool TextToken::is(std::string_view text, std::string_view name) const {
  const std::string_view raw = text.substr(begin, end - begin);
  if (kind == Kind::Word) return raw == name;
  return kind == Kind::String && raw.size() >= 2 && raw.substr(1, raw.size() - 2) == name;
}

void TextScanner::skip_blanks() {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
    } else if (text_[at_] == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
    } else {
      return;
    }
  }
}

TextToken TextScanner::next() {
  skip_blanks();
  TextToken token;
  token.begin = token.end = at_;
  if (at_ >= text_.size()) return token;
  if (text_[at_] == '"') {
    token.kind = TextToken::Kind::String;
    ++at_;
    while (at_ < text_.size() && text_[at_] != '"')
      at_ += text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] == '"' ? 2 : 1;
    at_ = std::min(at_ + 1, text_.size());
  } else if (is_punctuation(text_[at_])) {
    token.kind = TextToken::Kind::Punct;
    ++at_;
  } else {
    token.kind = TextToken::Kind::Word;
    while (at_ < text_.size() && !is_blank(text_[at_]) && !is_punctuation(text_[at_]) &&
           text_[at_] != '"' && text_[at_] != '#')
      ++at_;
  }
  token.end = at_;
  return token;
}

std::size_t text_offset(std::string_view text, std::size_t line, std::size_t column) {
  std::size_t at = 0;
  for (std::size_t i = 1; i < line; ++i) {
    at = text.find('\n', at);
    if (at == std::string_view::npos) return text.size();
    ++at;
  }
  return std::min(at + column - 1, text.size());
}

std::optional<TextPatch> parameter_value(std::string_view text, std::size_t at,
                                         std::string_view name) {
  TextScanner scanner(text, at);
  if (!scanner.next().is(text, name)) return std::nullopt;
  TextPatch patch;
  int depth = 0;
  for (;;) {
    const TextToken token = scanner.next();
    if (token.kind == TextToken::Kind::End) return std::nullopt;
    const char c = punctuation(text, token);
    if (depth == 0 && (c == ',' || c == ')' || c == '}')) break;
    if (c == '(' || c == '{' || c == '[') ++depth;
    if (c == ')' || c == '}' || c == ']') --depth;
    if (patch.end == 0) patch.begin = token.begin;
    patch.end = token.end;
  }
  return patch.end > 0 ? std::optional(patch) : std::nullopt;
}

std::optional<TextPatch> parameter_insertion(std::string_view text, std::size_t at,
                                             const std::string& written) {
  TextScanner scanner(text, at);
  for (int i = 0; i < 4; ++i) {
    const TextToken token = scanner.next();
    if (token.kind == TextToken::Kind::End) return std::nullopt;
    if (punctuation(text, token) != '(') continue;
    const bool is_empty = punctuation(text, scanner.next()) == ')';
    return TextPatch{token.end, token.end, is_empty ? written : written + ", "};
  }
  return std::nullopt;
}

std::optional<TextPatch> statement_value(std::string_view text, std::size_t at,
                                         const StatementPlace& place, const std::string& value) {
  const std::vector<std::string_view> words =
      place.quoted ? std::vector{place.keyword} : words_of(place.keyword);
  TextScanner scanner(text, at);
  std::optional<TextPatch> found;
  std::size_t matched = 0, missing = 0;
  int depth = 0;
  for (;;) {
    const TextToken token = scanner.next();
    if (token.kind == TextToken::Kind::End) return std::nullopt;
    if (missing > 0) {
      if (found->end == 0) found->begin = token.begin;
      found->end = token.end;
      --missing;
      continue;
    }
    const char c = punctuation(text, token);
    if (c == '(' || c == '{' || c == '[') ++depth;
    if (c == ')' || c == '}' || c == ']') --depth;
    if (depth != 0 || c != '\0') {
      matched = 0;
      continue;
    }
    if (token.kind == TextToken::Kind::Word && token.is(text, "end")) {
      TextScanner ahead = scanner;
      if (ahead.next().is(text, place.kind)) {
        if (found) return found;
        const std::string indent = indentation(text, token.begin) + "    ";
        std::string keyword(place.keyword);
        if (place.quoted) keyword = "\"" + keyword + "\"";
        const std::size_t line = token.begin - indentation(text, token.begin).size();
        return TextPatch{line, line, indent + keyword + " " + value + "\n"};
      }
    }
    const bool right_kind = (token.kind == TextToken::Kind::String) == place.quoted;
    if (!right_kind || !token.is(text, words[matched])) {
      matched = 0;
      continue;
    }
    if (++matched < words.size()) continue;
    matched = 0;
    missing = std::max<std::size_t>(place.values, 1);
    found = TextPatch{0, 0, value};
  }
}

std::optional<TextPatch> texture_file(std::string_view text, std::size_t at) {
  TextScanner scanner(text, at);
  for (int i = 0; i < 8; ++i) {
    const TextToken token = scanner.next();
    if (token.kind == TextToken::Kind::End) return std::nullopt;
    if (!token.is(text, "texture")) continue;
    scanner.next();  // the name
    const TextToken file = scanner.next();
    if (file.kind != TextToken::Kind::String) return std::nullopt;
    return TextPatch{file.begin, file.end, {}};
  }
  return std::nullopt;
}

std::string patched(std::string_view text, std::vector<TextPatch> patches) {
  std::stable_sort(patches.begin(), patches.end(),
                   [](const TextPatch& a, const TextPatch& b) { return a.begin < b.begin; });
  std::string result;
  std::size_t at = 0;
  for (const TextPatch& patch : patches) {
    if (patch.begin < at) continue;
    result += text.substr(at, patch.begin - at);
    result += patch.text;
    at = patch.end;
  }
  result += text.substr(at);
  return result;
}

}  // namespace oriel::interactive
