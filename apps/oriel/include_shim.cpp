// SPDX-License-Identifier: Apache-2.0
#include "include_shim.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// What a line includes, or nothing.
std::optional<std::string> included(const std::string& line) {
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return {};
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return {};
  at = line.find_first_of("\"<", at);
  if (at == std::string::npos) return {};
  const std::size_t end = line.find(line[at] == '<' ? '>' : '"', at + 1);
  if (end == std::string::npos) return {};
  return line.substr(at + 1, end - at - 1);
}

/// Headers by their name in small letters.
std::set<std::string> headers_of(const fs::path& sdk) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(sdk))
    if (entry.path().extension() == ".h") names.insert(entry.path().filename().string());
  return names;
}

/// Whether a relative path stays below where it starts `depth` folders down.
bool stays_within(const fs::path& path, int depth) {
  for (const fs::path& part : path) {
    depth += part == ".." ? -1 : 1;
    if (depth <= 0) return false;
  }
  return true;
}

}  // namespace

std::string write_include_shim(const std::vector<std::string>& files, const std::string& sdk,
                               const std::string& folder, std::vector<StrayInclude>& stray) {
  // So deep that "../../.." stays below the folder.
  constexpr int kDepth = 10;
  fs::path base = folder;
  for (int i = 0; i < kDepth; ++i) base /= "d";
  const std::set<std::string> headers = headers_of(sdk);
  bool wrote = false;
  for (const std::string& file : files) {
    std::ifstream stream(file);
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
      const std::optional<std::string> name = included(line);
      if (!name || headers.count(*name) > 0) continue;
      const std::string header = lower(name->substr(name->find_last_of("/\\") + 1));
      std::error_code error;
      if (headers.count(header) == 0 || fs::exists(fs::path(file).parent_path() / *name, error))
        continue;
      const fs::path path(*name);
      if (path.is_absolute() || !stays_within(path, kDepth)) {
        stray.push_back({file, number, *name});
        continue;
      }
      const fs::path target = (base / path).lexically_normal();
      fs::create_directories(base);
      fs::create_directories(target.parent_path());
      std::ofstream(target) << "#include <" << header << ">\n";
      wrote = true;
    }
  }
  return wrote ? base.string() : std::string();
}

}  // namespace oriel::app
