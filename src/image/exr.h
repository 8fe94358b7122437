// SPDX-License-Identifier: Apache-2.0
// OpenEXR input and output: linear float pictures with named layers, the primary output format.
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
  /// 16-bit float for all channels except depth (Z) and ids (Crypto...), which are always 32-bit.
  bool half = false;
  int threads = 0;  ///< compression threads; 0 = compress on the calling thread
  std::map<std::string, std::string> metadata;  ///< string attributes of the header
};

/// Writes the layers into one single-part scan-line file, ZIP-compressed, atomically.
///
/// Inputs:  layers: all of one size; every channel name unique within the file.
/// Errors:  std::runtime_error with the path if sizes differ, names repeat or the file cannot be
///          written.
/// Checked: Exr.LayersAndMetadataRoundTripExactly
void write_exr(const std::string& path, const std::vector<Layer>& layers,
               const ExrOptions& options = {});

struct ExrFile {
  std::vector<Layer> layers;                    ///< beauty first, then in file order
  std::map<std::string, std::string> metadata;  ///< string attributes of the header
  bool has_chromaticities = false;
  float chromaticities[8] = {};  ///< xy of red, green, blue, white
};

struct ExrLimits {
  int largest_side = 1 << 16;
  std::size_t most_bytes = std::size_t(16) << 30;  ///< limit for the decoded pixels
};

/// Reads every flat part and channel as float. Channels are grouped into layers by the text before
/// the last dot, and by the name of the part if the file has several parts.
///
/// Model:   the pictures cover the display window. Pixels of the data window outside the display
///          window are dropped; pixels outside the data window are 0. Deep parts are skipped.
///          Subsampled channels (luminance-chroma files) are unsupported.
/// Errors:  std::runtime_error with path and reason if the file is not a valid EXR file or exceeds
///          the limits. A header may not request more than 4096 times the length of the file.
/// Checked: Exr.BrokenFilesThrowAndNeverCrash
ExrFile read_exr(const std::string& path, const ExrLimits& limits = {});

/// The default picture of a file: up to four channels of its first layer, which is the beauty (R,
/// G, B, A in this order) if the file has one.
Image read_exr_image(const std::string& path, const ExrLimits& limits = {});

}  // namespace oriel
