// SPDX-License-Identifier: Apache-2.0
// PNG in and out through libpng alone: the 8- or 16-bit view that goes with a render.
#pragma once

#include <string>

#include "image/pixel_buffer.h"

namespace oriel {

// Conventions
//   Values are display-encoded, 0...1; nothing is converted. PNG knows only unassociated alpha, so
//   what is written counts as such for other programs.

/// What the header says of the encoding. It never changes the values.
enum class PngEncoding { Unsaid, Srgb, Gamma };

struct PngOptions {
  int bits = 8;  ///< 8 or 16
  PngEncoding encoding = PngEncoding::Unsaid;
  float gamma = 2.2f;   ///< display exponent, for PngEncoding::Gamma
  bool dither = false;  ///< a fixed pattern of up to half a step each way instead of rounding
};

/// Writes 1 to 4 channels (grey, grey + alpha, RGB, RGBA), clipped to 0...1, atomically; not a
/// number becomes 0.
///
/// Errors:  std::runtime_error with the path.
/// Checked: Png.*
void write_png(const std::string& path, const Image& image, const PngOptions& options = {});

/// Reads any PNG as 1 to 4 channels of value / largest value: palettes are resolved, a transparent
/// colour becomes alpha, nothing is converted for gamma.
///
/// Errors:  std::runtime_error with path and reason; pictures past 65536 a side or 1 GiB decoded.
Image read_png(const std::string& path);

}  // namespace oriel
