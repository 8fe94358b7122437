// SPDX-License-Identifier: Apache-2.0
#include "output/output_place.h"

#include <cctype>
#include <filesystem>
#include <stdexcept>

#include "base/durable_file.h"
#include "image/picture_target.h"
#include "output/output_request.h"
#include "scene/asset_path.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;

bool is_absolute(const std::string& portable) {
  const bool drive = portable.size() > 2 && portable[1] == ':' && portable[2] == '/' &&
                     std::isalpha(static_cast<unsigned char>(portable[0])) != 0;
  return drive || portable.starts_with('/');
}

}  // namespace

std::string allowed_path(const std::string& file, const OutputRoots& roots) {
  if (file.empty()) return {};
  std::error_code error;
  const fs::path base = fs::absolute(roots.base.empty() ? fs::path(".") : fs::path(roots.base));
  const fs::path target = fs::weakly_canonical(base / file, error);
  if (error || !target.has_filename()) return {};
  for (const std::string& root : roots.allowed) {
    const fs::path folder =
        fs::weakly_canonical(root.empty() ? fs::path(".") : fs::path(root), error);
    if (error) continue;
    const auto relative = target.lexically_relative(folder);
    if (!relative.empty() && *relative.begin() != ".." && relative != ".") return target.string();
  }
  return {};
}

OutputPlace output_place(const std::string& file, const OutputRoots& roots) {
  const std::string portable = scene::with_slashes(file);
  const bool absolute = is_absolute(portable);
  // A drive letter would be interpreted as a folder.
  if (!absolute || portable.starts_with('/'))
    if (std::string path = allowed_path(portable, roots); !path.empty())
      return {std::move(path), false};
  if (!absolute) return {};
  return {allowed_path(portable.substr(portable.rfind('/') + 1), roots), true};
}

std::string output_fault(const std::string& path, const OutputRoots& roots) {
  std::error_code error;
  const fs::path target(path), folder = target.parent_path();
  if (!has_picture_suffix(path)) return "its name has no suffix of a picture, such as .exr or .png";
  if (std::string fault = picture_fault(path); !fault.empty()) return fault;
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    if (allowed_path(path, roots).empty()) return "folder '" + folder.string() + "' does not exist";
    fs::create_directories(folder, error);
    if (error) return "its folder cannot be created: " + error.message();
  }
  try {
    const DurableFile probe(path);
    return {};
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

}  // namespace oriel
