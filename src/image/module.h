// SPDX-License-Identifier: Apache-2.0
// Interface of the module that contains OpenImageIO, and the search for the module file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "image/files.h"
#include "image/pixel_buffer.h"
#include "image/pixel_source.h"
#include "image/texture.h"
#include "image/texture_statistics.h"

namespace oriel {

/// Functions of the module. Host and module are built together; the version detects an outdated
/// file.
class FilesModule {
 public:
  virtual ~FilesModule() = default;

  /// The functions throw std::runtime_error with the reason only, without the path.
  virtual Image read(const std::string& path) = 0;
  /// The content of a file of the type options.type, which must not be empty. In memory, because
  /// the writers ignore some errors of the disk.
  virtual std::string encode(const Image& image, const FileOptions& options) = 0;
  /// most_tile_bytes: of a tile or strip of the file, decoded to floats.
  virtual std::unique_ptr<Texture> open_texture(const std::string& path, float gamma,
                                                std::uint64_t most_tile_bytes) = 0;

  /// Opens the files of textures from now on; null = open_source.
  virtual void set_source_opener(PixelSourceOpener opener) = 0;
  /// The pixels of a file, decoded in this process.
  virtual std::unique_ptr<PixelSource> open_source(const std::string& path) = 0;
  /// Reads configuration files, which a confined process cannot do later.
  virtual void prepare_reading() = 0;

  virtual void apply_ocio(Image& image, const OcioTransform& transform) = 0;

  /// Memory of whole pictures, which the next frame finds again, and of the tile cache.
  virtual void set_cache_megabytes(float pictures, float tiles) = 0;
  virtual TextureStatistics texture_statistics() = 0;
};

inline constexpr int kFilesModuleVersion = 8;
/// The only exported symbol of the module. It returns null when the version differs. The object is
/// never destroyed.
using FilesModuleEntry = FilesModule* (*)(int version);
inline constexpr char kFilesModuleSymbol[] = "oriel_image_files_module";

/// Loads the module at the first call and keeps it loaded.
///
/// Model:   searches each folder of ORIEL_MODULE_PATH (colon-separated), the folder of the object
///          that this code is linked into and ../lib from there, the same two for the program, and
///          the build folder. A path from the scene is never searched.
/// Errors:  std::runtime_error that lists every path that was tried.
/// Checked: ImageModule.*
FilesModule& files_module();

/// The paths that files_module tries, in order.
std::vector<std::string> module_candidates();

}  // namespace oriel
