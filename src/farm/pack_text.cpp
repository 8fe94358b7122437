// SPDX-License-Identifier: Apache-2.0
#include "farm/pack_text.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "interactive/text_patch.h"

namespace oriel::farm {
namespace {

using interactive::TextPatch;
using interactive::TextScanner;
using interactive::TextToken;

/// Number of tokens between a statement and the name of its file.
constexpr int kMaxTokens = 4096;  // `finalgather file` has a list

std::string unescaped_string(std::string_view token) {
  std::string text;
  for (std::size_t i = 1; i + 1 < token.size(); ++i) {
    if (token[i] == '\\' && token[i + 1] == '"') continue;
    text += token[i];
  }
  return text;
}

/// Offsets of the lines of a text.
class LineOffsets {
 public:
  LineOffsets(std::string_view text, char newline) : size_(text.size()) {
    for (std::size_t at = text.find(newline); at != std::string_view::npos;
         at = text.find(newline, at + 1))
      starts_.push_back(at + 1);
  }
  std::size_t offset(SourceLocation where) const {
    if (where.line == 0 || where.line > starts_.size()) return size_;
    return std::min(starts_[where.line - 1] + where.column - 1, size_);
  }

 private:
  std::size_t size_;
  std::vector<std::size_t> starts_ = {0};
};

std::optional<TextPatch> include_patch(std::string_view text, std::size_t at, const NewName& n) {
  constexpr std::string_view kWord = "$include";
  if (text.substr(at, kWord.size()) != kWord) return std::nullopt;
  const std::size_t begin = text.find_first_of("\"<", at + kWord.size());
  if (begin == std::string_view::npos) return std::nullopt;
  const std::size_t end = text.find(text[begin] == '<' ? '>' : '"', begin + 1);
  if (end == std::string_view::npos) return std::nullopt;
  if (text.substr(begin + 1, end - begin - 1) != n.reference->written) return std::nullopt;
  return TextPatch{begin, end + 1, "\"" + n.name + "\""};
}

std::optional<TextPatch> string_patch(std::string_view text, std::size_t at, const NewName& n) {
  TextScanner scanner(text, at);
  int strings = 0;
  for (int i = 0; i < kMaxTokens; ++i) {
    const TextToken token = scanner.next();
    if (token.kind == TextToken::Kind::End) break;
    const std::string_view raw = text.substr(token.begin, token.end - token.begin);
    const bool is_string = token.kind == TextToken::Kind::String;
    if (is_string && strings++ < n.reference->strings_before) continue;
    // Names may be written without quotes.
    if (is_string ? unescaped_string(raw) == n.reference->written : raw == n.reference->written)
      return TextPatch{token.begin, token.end, "\"" + n.name + "\""};
  }
  return std::nullopt;
}

}  // namespace

std::string with_names(std::string_view text, char newline, const std::vector<NewName>& names) {
  const LineOffsets lines(text, newline);
  std::vector<TextPatch> patches;
  for (const NewName& n : names) {
    const std::size_t at = lines.offset(n.reference->where);
    const bool include = n.reference->kind == FileReference::Kind::Include;
    const std::optional<TextPatch> patch =
        include ? include_patch(text, at, n) : string_patch(text, at, n);
    if (patch)
      patches.push_back(*patch);
    else if (!include)  // that of a placeholder has no $include
      throw std::runtime_error(fmt::format("the name of the {} \"{}\" was not found in line {}",
                                           kind_name(n.reference->kind), n.reference->written,
                                           n.reference->where.line));
  }
  return interactive::patched(text, std::move(patches));
}

}  // namespace oriel::farm
