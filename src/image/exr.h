// SPDX-License-Identifier: Apache-2.0
// OpenEXR in and out: linear float pictures with named layers, the truth Oriel writes.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "image/pixel_buffer.h"

namespace oriel {

// Conventions
//   Channel names: the layer's name, a dot, the channel's name. The empty layer name (beauty) has
//   no prefix: R, G, B, A. A layer {"Z", {""}} is the bare channel Z. The chromaticities in the
//   header are those of Rec. 709 with white D65.

struct ExrOptions {
  /// 16-bit float for every channel but depth (Z) and ids (Crypto...), which stay 32.
  bool half = false;
  int threads = 0;                              ///< that compress; 0 = the calling thread alone
  std::map<std::string, std::string> metadata;  ///< string attributes of the header
};

/// Writes the layers into one single-part scan-line file, ZIP-compressed, atomically.
///
/// Inputs:  layers: all of one size; every channel name unique within the file.
/// Errors:  std::runtime_error with the path: sizes differ, names repeat, the file cannot be made.
/// Checked: Exr.LayersAndMetadataComeBackExact
void write_exr(const std::string& path, const std::vector<Layer>& layers,
               const ExrOptions& options = {});

struct ExrFile {
  std::vector<Layer> layers;                    ///< beauty first, then as the file lists them
  std::map<std::string, std::string> metadata;  ///< the string attributes
  bool has_chromaticities = false;
  float chromaticities[8] = {};  ///< xy of red, green, blue, white
};

struct ExrLimits {
  int largest_side = 1 << 16;
  std::size_t most_bytes = std::size_t(16) << 30;  ///< of decoded pixels
};

/// Reads every flat part and channel as float, layers grouped by the text before the last dot (and
/// by the part's name where a file has several parts).
///
/// Model:   the pictures cover the display window; pixels of the data window outside it are left
///          out, pixels outside the data window are 0. Deep parts are left out. Subsampled
///          channels (luminance-chroma files) are refused.
/// Errors:  std::runtime_error with path and reason, for anything that is no sound EXR file or goes
///          past the limits. A header may not ask for more than 4096 times the file's length.
/// Checked: Exr.BrokenFilesThrowAndNeverCrash
ExrFile read_exr(const std::string& path, const ExrLimits& limits = {});

/// The picture of a file where no layer is asked for: up to four channels of its first layer, which
/// is the beauty (R, G, B, A in this order) where there is one.
Image read_exr_image(const std::string& path, const ExrLimits& limits = {});

}  // namespace oriel
