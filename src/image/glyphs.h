// SPDX-License-Identifier: Apache-2.0
// Draws numbers and units into pictures with a small built-in bitmap font.
#pragma once

#include <string_view>

#include "base/vec.h"
#include "image/pixel_buffer.h"

namespace oriel {

/// Size of a glyph in font dots; kGlyphStep includes the gap to the next glyph.
inline constexpr int kGlyphWidth = 5, kGlyphHeight = 7, kGlyphStep = 6;

/// Whether the font has the character: digits, . - + / and the letters of lx, cd/m2, k, M, e.
bool has_glyph(char c);

inline int text_width(std::string_view text, int scale) {
  return text.empty() ? 0 : (static_cast<int>(text.size()) * kGlyphStep - 1) * scale;
}

/// Draws text with its upper left corner at (x, y), clipped to the picture. The 2 of "m2" is
/// raised. Characters without a glyph are blank.
///
/// Inputs:  scale: pixels per font dot; color: written to the first three channels.
/// Checked: Glyphs.* in false_color_test.cpp
void draw_text(Image& image, int x, int y, std::string_view text, int scale, const Rgb& color);

}  // namespace oriel
