// SPDX-License-Identifier: Apache-2.0
#include "image/glyphs.h"

#include <algorithm>

namespace oriel {
namespace {

struct Glyph {
  char character;
  const char* dots;  ///< rows from the top, five dots each
};

constexpr Glyph kGlyphs[] = {
    {'0', ".###.#...##..###.#.###..##...#.###."}, {'1', "..#...##....#....#....#....#...###."},
    {'2', ".###.#...#....#...#...#...#...#####"}, {'3', "#####...#...#.....#....##...#.###.."},
    {'4', "...#...##..#.#.#..#.#####...#....#."}, {'5', "######....####.....#....##...#.###."},
    {'6', "..##..#...#....####.#...##...#.###."}, {'7', "#####....#...#...#...#....#....#..."},
    {'8', ".###.#...##...#.###.#...##...#.###."}, {'9', ".###.#...##...#.####....#...#..##.."},
    {'.', "..........................##...##.."}, {'-', "...............#####..............."},
    {'+', "............#....#..#####..#....#.."}, {'/', ".........#...#...#...#...#........."},
    {'k', "#....#....#..#.#.#..##...#.#..#..#."}, {'l', ".#....#....#....#....#....#.....##."},
    {'x', "..........#...#.#.#...#...#.#.#...#"}, {'c', "...........###.#....#....#...#.###."},
    {'d', "....#....#.##.##..###...##...#.####"}, {'m', "..........##.#.#.#.##.#.##...##...#"},
    {'M', "#...###.###.#.##.#.##...##...##...#"}, {'e', "...........###.#...#######.....###."},
};
/// The superscript 2 of a unit.
constexpr const char* kSquare = ".##..#..#...#...#...####...........";

const char* dots_of(char c) {
  const auto found = std::find_if(std::begin(kGlyphs), std::end(kGlyphs),
                                  [c](const Glyph& g) { return g.character == c; });
  return found == std::end(kGlyphs) ? nullptr : found->dots;
}

void draw_glyph(Image& image, int left, int top, const char* dots, int scale, const Rgb& color) {
  for (int y = 0; y < kGlyphHeight * scale; ++y)
    for (int x = 0; x < kGlyphWidth * scale; ++x) {
      const int to_x = left + x, to_y = top + y;
      if (dots[y / scale * kGlyphWidth + x / scale] != '#' || to_x < 0 || to_y < 0 ||
          to_x >= image.width || to_y >= image.height)
        continue;
      for (int k = 0; k < std::min(image.channels, 3); ++k) image.at(to_x, to_y)[k] = color[k];
    }
}

}  // namespace

bool has_glyph(char c) { return dots_of(c) != nullptr; }

void draw_text(Image& image, int x, int y, std::string_view text, int scale, const Rgb& color) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool square = text[i] == '2' && i > 0 && text[i - 1] == 'm';
    if (const char* dots = square ? kSquare : dots_of(text[i]))
      draw_glyph(image, x + static_cast<int>(i) * kGlyphStep * scale, y, dots, scale, color);
  }
}

}  // namespace oriel
