// SPDX-License-Identifier: Apache-2.0
#include "shader_manifest.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <fstream>
#include <optional>

#include "command.h"
#include "suggest.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

/// Words of a line; nothing where a quote is not closed.
std::optional<std::vector<std::string>> manifest_words(const std::string& line) {
  std::vector<std::string> words;
  bool inside = false;  // of a word
  char quote = 0;
  for (const char c : line) {
    if (quote == 0 && (c == ' ' || c == '\t' || c == '\r')) {
      inside = false;
      continue;
    }
    if (quote == 0 && !inside && c == '#') break;
    if (!inside) words.emplace_back();
    inside = true;
    if (quote == 0 && (c == '"' || c == '\''))
      quote = c;
    else if (c == quote)
      quote = 0;
    else
      words.back() += c;
  }
  if (quote != 0) return std::nullopt;
  return words;
}

}  // namespace

ShaderManifest::ShaderManifest(const fs::path& file)
    : folder_(fs::absolute(file).lexically_normal().parent_path()) {
  std::ifstream stream(file);
  if (!stream) throw UserError(fmt::format("cannot read the manifest '{}'", file.string()));
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string where = fmt::format("{}:{}", file.string(), number);
    const auto words = manifest_words(line);
    if (!words) throw UserError(where + ": a quote is not closed");
    if (!words->empty()) read(*words, where);
  }
}

void ShaderManifest::read(const std::vector<std::string>& words, const std::string& where) {
  const std::string& keyword = words[0];
  if (words.size() < (keyword == "flags" ? 3u : 2u))
    throw UserError(fmt::format("{}: '{}' requires {}", where, keyword,
                                keyword == "flags" ? "a pattern and words" : "a path or pattern"));
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (keyword == "flags") {
    Rule rule{rest[0], {rest.begin() + 1, rest.end()}};
    for (std::string& word : rule.words)
      if (word.starts_with("-I") && word.size() > 2) word = "-I" + placed(word.substr(2));
    flags_.push_back(std::move(rule));
  } else if (keyword == "skip") {
    skipped_.insert(skipped_.end(), rest.begin(), rest.end());
  } else if (keyword == "include" || keyword == "helper") {
    for (const std::string& path : rest)
      (keyword == "include" ? include_folders_ : helpers_).push_back(placed(path));
  } else {
    throw UserError(fmt::format("{}: unknown statement '{}': {}", where, keyword,
                                expected_one_of(keyword, {"flags", "skip", "include", "helper"})));
  }
}

std::string ShaderManifest::placed(const std::string& path) const {
  const fs::path placed = folder_ / path;
  if (!fs::exists(placed))
    throw UserError(fmt::format("{}: there is no '{}'", kManifestName, placed.string()));
  return placed.string();
}

bool ShaderManifest::matches(const std::string& pattern, const fs::path& source) const {
  const bool name_alone = pattern.find('/') == std::string::npos;
  const fs::path below = fs::absolute(source).lexically_normal().lexically_relative(folder_);
  if (below.empty() || *below.begin() == "..") return false;
  const std::string text = name_alone ? below.filename().string() : below.string();
  return fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

bool ShaderManifest::skips(const fs::path& source) const {
  for (const std::string& pattern : skipped_)
    if (matches(pattern, source)) return true;
  return false;
}

std::vector<std::string> ShaderManifest::flags_of(const fs::path& source) const {
  std::vector<std::string> flags;
  for (const Rule& rule : flags_)
    if (matches(rule.pattern, source))
      flags.insert(flags.end(), rule.words.begin(), rule.words.end());
  return flags;
}

}  // namespace oriel::app
