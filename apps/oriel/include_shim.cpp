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

/// The file of a folder whose name is the same but for case; empty where there is none.
fs::path entry_like(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (lower(entry.path().filename().string()) == lower(name)) return entry.path();
  return {};
}

/// Whether a name is that of a header of the system, as <string.h> beside somebody's own String.h.
bool is_system_header(const std::string& name) {
  std::error_code error;
  return name.find('.') == std::string::npos || fs::exists(fs::path("/usr/include") / name, error);
}

/// What an include by other slashes or another case means, seen from a folder.
fs::path file_like(fs::path folder, std::string name) {
  if (is_system_header(name)) return {};
  std::replace(name.begin(), name.end(), '\\', '/');
  if (fs::path(name).is_absolute()) return {};
  if (folder.empty()) folder = ".";
  for (const fs::path& part : fs::path(name)) {
    folder = part == ".." || part == "." ? folder / part : entry_like(folder, part.string());
    if (folder.empty()) return {};
  }
  std::error_code error;
  return fs::is_regular_file(folder, error) ? folder : fs::path();
}

/// Writes the headers of a shim, and keeps the list of files to read.
class ShimWriter {
 public:
  ShimWriter(const std::vector<std::string>& files, const std::string& sdk,
             const std::vector<std::string>& folders, const std::string& folder)
      : headers_(headers_of(sdk)), folders_(folders), base_(folder) {
    for (int i = 0; i < kDepth; ++i) base_ /= "d";
    for (const std::string& file : files) add(file);
  }

  std::string write(std::vector<StrayInclude>& stray) {
    for (std::size_t i = 0; i < files_.size(); ++i) read(std::string(files_[i]), stray);
    return wrote_ ? base_.string() : std::string();
  }

 private:
  // So deep that "../../.." stays below the folder.
  static constexpr int kDepth = 10;

  void add(const std::string& file) {
    std::error_code error;
    const fs::path whole = fs::weakly_canonical(file, error);
    if (seen_.insert(whole.string()).second) files_.push_back(file);
  }

  void read(const std::string& file, std::vector<StrayInclude>& stray) {
    std::ifstream stream(file);
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number)
      if (const auto name = included(line); name && headers_.count(*name) == 0)
        resolve(file, number, *name, stray);
  }

  void resolve(const std::string& file, int line, const std::string& name,
               std::vector<StrayInclude>& stray) {
    const fs::path beside = fs::path(file).parent_path();
    std::error_code error;
    if (fs::is_regular_file(beside / name, error)) return add((beside / name).string());
    const std::string header = lower(name.substr(name.find_last_of("/\\") + 1));
    if (headers_.count(header) > 0) {
      if (!put(name, "<" + header + ">")) stray.push_back({file, line, name});
      return;
    }
    for (const std::string& folder : folders_)
      if (fs::is_regular_file(fs::path(folder) / name, error)) return;
    fs::path own = file_like(beside, name);
    for (const std::string& folder : folders_)
      if (own.empty()) own = file_like(folder, name);
    if (own.empty()) return;
    add(own.string());
    put(name, '"' + fs::absolute(own).string() + '"');
  }

  /// False: no header can have that name.
  bool put(const fs::path& name, const std::string& includes) {
    if (name.is_absolute() || !stays_within(name, kDepth)) return false;
    const fs::path target = (base_ / name).lexically_normal();
    fs::create_directories(base_);
    fs::create_directories(target.parent_path());
    std::ofstream(target) << "#include " << includes << "\n";
    return wrote_ = true;
  }

  std::set<std::string> headers_, seen_;
  const std::vector<std::string>& folders_;
  fs::path base_;
  std::vector<std::string> files_;
  bool wrote_ = false;
};

}  // namespace

std::string write_include_shim(const std::vector<std::string>& files, const std::string& sdk,
                               const std::vector<std::string>& folders, const std::string& folder,
                               std::vector<StrayInclude>& stray) {
  return ShimWriter(files, sdk, folders, folder).write(stray);
}

}  // namespace oriel::app
