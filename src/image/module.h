// SPDX-License-Identifier: Apache-2.0
// The border between oriel_image and the module that holds OpenImageIO, and how it is found.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "image/files.h"
#include "image/pixel_buffer.h"
#include "image/texture.h"
#include "image/texture_statistics.h"

namespace oriel {

/// What the module offers. Both sides are built together; the version catches a stray old file.
class FilesModule {
 public:
  virtual ~FilesModule() = default;

  /// Throw std::runtime_error with the bare reason.
  virtual Image read(const std::string& path) = 0;
  virtual void write(const std::string& path, const Image& image, const FileOptions& options) = 0;
  virtual std::unique_ptr<Texture> open_texture(const std::string& path, float gamma) = 0;

  virtual void set_cache_megabytes(float megabytes) = 0;
  virtual TextureStatistics texture_statistics() = 0;
};

inline constexpr int kFilesModuleVersion = 2;
/// The one symbol the module exports; null when the version differs. The object lives for ever.
using FilesModuleEntry = FilesModule* (*)(int version);
inline constexpr char kFilesModuleSymbol[] = "oriel_image_files_module";

/// Opens the module once and keeps it.
///
/// Model:   looked for in each folder of ORIEL_MODULE_PATH (colon-separated), in the folder of the
///          object this code is linked into, in ../lib from there, the same two for the program,
///          and in the folder of the build. Never in a place a scene names.
/// Errors:  std::runtime_error that names every place tried.
/// Checked: ImageModule.*
FilesModule& files_module();

/// The places files_module looks at, in order.
std::vector<std::string> module_candidates();

}  // namespace oriel
