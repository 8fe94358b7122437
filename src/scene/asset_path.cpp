// SPDX-License-Identifier: Apache-2.0
#include "scene/asset_path.h"

#include <algorithm>
#include <filesystem>

namespace oriel::scene {
namespace {

namespace fs = std::filesystem;

std::string in_folder(const std::string& file, const std::string& folder) {
  return folder.empty() || fs::path(file).is_absolute() ? file : (fs::path(folder) / file).string();
}

std::string small(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  return text;
}

/// The entry with this name in the folder, or the first one, in order, that differs only in case.
std::string entry_in_any_case(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return name;
  std::string found;
  const std::string wanted = small(name);
  for (fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error), end;
       !error && at != end; at.increment(error)) {
    std::string entry = at->path().filename().string();
    if (small(entry) == wanted && (found.empty() || entry < found)) found = std::move(entry);
  }
  return found;
}

/// A file below the folder that matches except for the case of ASCII letters; empty if none.
std::string find_in_any_case(const std::string& relative, const fs::path& folder) {
  fs::path path = folder;
  for (const fs::path& part : fs::path(relative)) {
    if (part == "..") return {};
    const std::string entry = entry_in_any_case(path, part.string());
    if (entry.empty()) return {};
    path /= entry;
  }
  std::error_code error;
  return fs::is_regular_file(path, error) ? path.string() : std::string();
}

}  // namespace

std::string with_slashes(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

std::vector<std::string> spellings_of(const std::string& written) {
  std::vector<std::string> spellings = {written};
  const std::string portable = with_slashes(written);
  if (portable != written) spellings.push_back(portable);
  const std::size_t above = portable.rfind("../");
  for (std::size_t slash = portable.find('/'); slash != portable.npos;
       slash = portable.find('/', slash + 1)) {
    if (above != portable.npos && slash < above + 2) continue;
    if (slash + 1 < portable.size() && portable[slash + 1] != '/')
      spellings.push_back(portable.substr(slash + 1));
  }
  return spellings;
}

std::string find_asset(const std::string& written, const std::string& folder,
                       const FileAccess& access) {
  for (const std::string& spelling : spellings_of(written)) {
    const std::string path = in_folder(spelling, folder);
    std::error_code error;
    if (access.permits(path, FileUse::Asset) && fs::is_regular_file(path, error)) return path;
  }
  // File names on Windows are not case-sensitive.
  for (const std::string& spelling : spellings_of(written))
    if (!fs::path(spelling).is_absolute())
      if (std::string path = find_in_any_case(spelling, folder);
          !path.empty() && access.permits(path, FileUse::Asset))
        return path;
  return in_folder(written, folder);
}

}  // namespace oriel::scene
