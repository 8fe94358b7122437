// SPDX-License-Identifier: Apache-2.0
// Any image file in and out; EXR and PNG directly, everything else through the files module.
#pragma once

#include <string>

#include "image/pixel_buffer.h"

namespace oriel {

// Conventions
//   Raw values: integers are divided by their largest value, floats stay; no colour conversion, no
//   change of alpha. Row 0 is the top.
//   The files module (liboriel_image_files.so) holds OpenImageIO. It is opened at the first use of
//   a format that needs it, or of a file texture, and never before: it costs every start 0.1 s.

enum class SampleFormat { U8, U16, Half, Float };

struct FileOptions {
  SampleFormat format = SampleFormat::U8;  ///< the nearest one the file type has is taken
  int jpeg_quality = 95;                   ///< 1 ... 100
  bool dither = false;                     ///< of 8-bit pictures
};

/// Reads up to four channels of the first picture in the file.
///
/// Errors:  std::runtime_error with path and reason: missing, broken, past 65536 a side or 4 GiB.
/// Checked: Files.*
Image read_image(const std::string& path);

/// Writes by the extension of `path`: .exr (half or float), .png (8 or 16 bit), and what the module
/// knows: .tif, .jpg, .hdr, .tga, .bmp, .iff, .pic, ... Atomic. Integer formats clip to 0...1; a
/// file type without alpha loses it.
///
/// Errors:  std::runtime_error with path and reason.
/// Checked: Files.*
void write_image(const std::string& path, const Image& image, const FileOptions& options = {});

/// True when the files module has been opened in this process.
bool image_module_is_open();

}  // namespace oriel
