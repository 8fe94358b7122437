// SPDX-License-Identifier: Apache-2.0
#include "farm/pack_layout.h"

#include <algorithm>
#include <cctype>

namespace oriel::farm {
namespace {

namespace fs = std::filesystem;

std::string in_small_letters(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The absolute path without "." and "..", which names the same file.
fs::path normal_path(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  fs::path normal = absolute.lexically_normal();
  // ".." behind a symbolic link leads elsewhere.
  if (!fs::equivalent(normal, absolute, error)) normal = fs::weakly_canonical(absolute, error);
  return normal;
}

/// Whether a scene can name it in quotes and after $include.
bool is_writable_name(const std::string& name) {
  return std::all_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 32 && c != '"' && c != '\\';
  });
}

}  // namespace

std::string plain_name(const std::string& name) {
  std::string plain = name;
  for (char& c : plain) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && std::isalnum(byte) == 0 &&
        std::string_view("._-+ ").find(c) == std::string_view::npos)
      c = '_';
  }
  if (plain.empty() || plain.find_first_not_of(". ") == std::string::npos) return "files";
  return plain;
}

PackLayout::PackLayout(const fs::path& scene)
    : scene_(normal_path(scene)), folder_(scene_.parent_path()) {
  for (const char* name : {kPackManifest, kPackedShaders, kPackedExternal}) used_.insert(name);
  place(scene_);
}

std::string PackLayout::free_name(const std::string& wanted) {
  const fs::path path(wanted);
  std::string name = wanted;
  for (int i = 2; !used_.insert(in_small_letters(name)).second; ++i)
    name = (path.parent_path() /
            (path.stem().string() + "-" + std::to_string(i) + path.extension().string()))
               .generic_string();
  return name;
}

std::string PackLayout::external_folder(const fs::path& folder) {
  std::string& known = folders_[folder];
  if (known.empty())
    known = free_name(std::string(kPackedExternal) + "/" + plain_name(folder.filename().string()));
  return known;
}

std::string PackLayout::place(const fs::path& file) {
  const fs::path source = normal_path(file);
  if (const auto known = places_.find(source); known != places_.end()) return known->second;
  const fs::path inside = source.lexically_relative(folder_);
  const std::string first = inside.empty() ? ".." : in_small_letters(inside.begin()->string());
  std::string& place = places_[source];
  if (first != ".." && !used_.contains(in_small_letters(inside.generic_string())) &&
      first != kPackedExternal && first != kPackedShaders &&
      is_writable_name(inside.generic_string())) {
    place = inside.generic_string();
    used_.insert(in_small_letters(place));
  } else {
    place = free_name(external_folder(source.parent_path()) + "/" +
                      plain_name(source.filename().string()));
  }
  return place;
}

std::string PackLayout::place_library(const fs::path& file) {
  const fs::path source = normal_path(file);
  std::string& place = places_[source];
  // The scene names libraries without their folder, so the name must not change.
  if (place.empty()) place = std::string(kPackedShaders) + "/" + source.filename().string();
  return place;
}

}  // namespace oriel::farm
