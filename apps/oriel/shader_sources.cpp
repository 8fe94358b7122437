// SPDX-License-Identifier: Apache-2.0
#include "shader_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/file_text.h"
#include "command.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

bool is_source(const fs::path& file) {
  const std::string extension = file.extension().string();
  return is_c_source(file) || extension == ".cpp" || extension == ".cc" || extension == ".cxx" ||
         extension == ".C";
}

bool is_header(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".h" || extension == ".hpp" || extension == ".hh" || extension == ".hxx";
}

/// The DllMain of a Windows library in a file of its own, as such folders often have one.
bool is_windows_entry(const fs::path& file) {
  std::string stem = file.stem().string();
  for (char& c : stem) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (stem.size() < 3 || stem.compare(stem.size() - 3, 3, "dll") != 0) return false;
  const std::string text = file_text(file);
  return text.find("windows.h") != std::string::npos && text.find("DllMain") != std::string::npos;
}

/// Links to folders are not followed: they may lead in circles.
void add_files(const fs::path& folder, bool (*wanted)(const fs::path&), bool recursive,
               std::vector<std::string>& files) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && wanted(entry.path())) files.push_back(entry.path().string());
    if (recursive && entry.is_directory() && !entry.is_symlink() &&
        !entry.path().filename().string().starts_with("."))
      add_files(entry.path(), wanted, true, files);
  }
}

std::vector<std::string> files_in(const fs::path& folder, bool (*wanted)(const fs::path&),
                                  bool recursive) {
  std::vector<std::string> files;
  add_files(folder, wanted, recursive, files);
  std::sort(files.begin(), files.end());
  return files;
}

[[noreturn]] void refuse_empty(const std::string& folder, bool recursive) {
  const bool deeper = !recursive && !files_in(folder, is_source, true).empty();
  throw UserError(fmt::format("'{}' has no sources (.c, .cpp, .cc, .cxx) in it{}", folder,
                              deeper ? "; those in its folders are built with -r" : ""));
}

}  // namespace

bool is_c_source(const fs::path& file) { return file.extension() == ".c"; }

std::vector<std::string> headers_in(const fs::path& folder) {
  return files_in(folder, is_header, false);
}

std::vector<std::string> find_shader_sources(const std::vector<std::string>& paths, bool recursive,
                                             const std::vector<ShaderManifest>& manifests) {
  std::vector<std::string> sources;
  for (const std::string& path : paths) {
    if (!fs::exists(path)) throw UserError(fmt::format("there is no '{}'", path));
    if (!fs::is_directory(path)) {
      if (!is_source(path))
        throw UserError(fmt::format("'{}' is not a source file (.c, .cpp, .cc, .cxx)", path));
      sources.push_back(path);
      continue;
    }
    const std::vector<std::string> found = files_in(path, is_source, recursive);
    if (found.empty()) refuse_empty(path, recursive);
    for (const std::string& file : found) {
      const bool skipped = std::any_of(manifests.begin(), manifests.end(),
                                       [&](const ShaderManifest& m) { return m.skips(file); });
      if (is_windows_entry(file))
        fmt::print(stderr, "oriel: {} is left out: the entry point of a Windows library\n", file);
      else if (!skipped)
        sources.push_back(file);
    }
  }
  if (sources.empty()) throw UserError("there are no sources to build");
  return sources;
}

}  // namespace oriel::app
