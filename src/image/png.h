// SPDX-License-Identifier: Apache-2.0
// PNG input and output through libpng: 8- or 16-bit pictures for display.
#pragma once

#include <string>

#include "image/pixel_buffer.h"

namespace oriel {

// Conventions
//   Values are display-encoded in 0...1 and are not converted. PNG supports only unassociated
//   alpha, so other programs interpret written alpha as unassociated.

/// Encoding recorded in the header. It never changes the values.
enum class PngEncoding { Unsaid, Srgb, Gamma };

struct PngOptions {
  int bits = 8;  ///< 8 or 16
  PngEncoding encoding = PngEncoding::Unsaid;
  float gamma = 2.2f;   ///< display exponent, for PngEncoding::Gamma
  bool dither = false;  ///< adds a fixed pattern of at most half a step before rounding
};

/// Writes 1 to 4 channels (grey, grey + alpha, RGB, RGBA) atomically. Values are clipped to 0...1;
/// NaN becomes 0.
///
/// Errors:  std::runtime_error with the path.
/// Checked: Png.*
void write_png(const std::string& path, const Image& image, const PngOptions& options = {});

/// Reads any PNG as 1 to 4 channels of value / maximum value. Palettes are expanded, a transparent
/// colour becomes alpha; gamma is not applied.
///
/// Errors:  std::runtime_error with path and reason, also for pictures wider or higher than 65536
///          or larger than 1 GiB decoded.
Image read_png(const std::string& path);

}  // namespace oriel
