// SPDX-License-Identifier: Apache-2.0
// Image file input and output: EXR and PNG directly, other formats through the files module.
#pragma once

#include <string>

#include "image/pixel_buffer.h"

namespace oriel {

// Conventions
//   Values are not converted: integers are divided by their maximum, floats are unchanged; alpha is
//   unchanged. Row 0 is the top.
//   The files module (liboriel_image_files.so) contains OpenImageIO. It is loaded at the first use
//   of a format or file texture that requires it, because loading takes 0.1 s.

enum class SampleFormat { U8, U16, Half, Float };

struct FileOptions {
  /// formats that the file type lacks are replaced by the nearest one
  SampleFormat format = SampleFormat::U8;
  int jpeg_quality = 95;  ///< 1 ... 100
  bool dither = false;    ///< for 8-bit pictures
  bool srgb = false;      ///< PNG: records that values are colours encoded for sRGB displays
  std::string type = {};  ///< file type as an extension ("png"); empty: from the path
};

/// Reads up to four channels of the first picture in the file, in a reader process after
/// isolate_readers().
///
/// Errors:  std::runtime_error with path and reason if the file is missing, invalid, wider or
///          higher than 65536, or larger than 4 GiB.
/// Checked: Files.*
Image read_image(const std::string& path);

/// read_image() in this process, even if readers are isolated.
Image read_image_here(const std::string& path);

/// Selects the format by FileOptions::type or the extension of `path`: .exr (half or float), .png
/// (8 or 16 bit), and the formats of the files module: .tif, .jpg, .hdr, .tga, .bmp, .iff, .pic,
/// ... The file is replaced as a whole (DurableFile), and only if it is a picture
/// (picture_fault()). Integer formats clip to 0...1; file types without alpha drop it.
///
/// Errors:  std::runtime_error with path and reason.
/// Checked: Files.*
void write_image(const std::string& path, const Image& image, const FileOptions& options = {});

/// A transform of OpenColorIO. Empty names are the defaults of the configuration.
struct OcioTransform {
  std::string config;  ///< path of a configuration; empty = the environment variable OCIO
  std::string display, view;
  std::string space;  ///< of the input; empty = linear Rec. 709 if it has a known name there,
                      ///< otherwise the role scene_linear
  std::string lut;    ///< a file (.cube, .clf, ...) instead of display and view
};

/// Applies the transform to the colour channels, unassociated from alpha.
///
/// Errors:  std::runtime_error with the reason: no configuration, unknown display, view or space
///          (with the known names), unreadable file.
/// Checked: Tonemap.OpenColorIoAppliesViewsOfAConfiguration, Tonemap.LookUpTablesAreApplied
void apply_ocio(Image& image, const OcioTransform& transform);

/// Whether the files module is loaded in this process.
bool image_module_is_open();

}  // namespace oriel
