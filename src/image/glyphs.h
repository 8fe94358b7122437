// SPDX-License-Identifier: Apache-2.0
// Numbers and units written into pictures, in a tiny fixed font of their own.
#pragma once

#include <string_view>

#include "base/vec.h"
#include "image/pixel_buffer.h"

namespace oriel {

/// A cell of the font without the gap to the next, in its own dots.
inline constexpr int kGlyphWidth = 5, kGlyphHeight = 7, kGlyphStep = 6;

/// Whether there is a glyph: digits, . - + / and the letters of lx, cd/m2, k, M, e.
bool has_glyph(char c);

inline int text_width(std::string_view text, int scale) {
  return text.empty() ? 0 : (static_cast<int>(text.size()) * kGlyphStep - 1) * scale;
}

/// Draws text whose upper left corner is at (x, y); what lies outside of the picture is cut off.
/// The 2 of "m2" is raised. Characters without a glyph are blanks.
///
/// Inputs:  scale: pixels of a dot; color: of the first three channels.
/// Checked: Glyphs.* in false_color_test.cpp
void draw_text(Image& image, int x, int y, std::string_view text, int scale, const Rgb& color);

}  // namespace oriel
