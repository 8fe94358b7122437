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

}  // namespace

std::string with_slashes(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

bool lies_below(std::string_view path, std::string_view folder) {
  if (folder.empty() || !path.starts_with(folder)) return false;
  return folder.back() == '/' || path.size() == folder.size() || path[folder.size()] == '/';
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

std::string find_asset(const std::string& written, const std::string& folder) {
  for (const std::string& spelling : spellings_of(written)) {
    const std::string path = in_folder(spelling, folder);
    std::error_code error;
    if (fs::is_regular_file(path, error)) return path;
  }
  return in_folder(written, folder);
}

}  // namespace oriel::scene
