// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_brick.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace oriel {
namespace {

struct BrickNode {
  Vec3 coord;
  Rgba color1, color2, mortar;
  float scale, mortar_size, mortar_smooth, bias, width, height, offset, squash;
  int offset_rows, squash_rows;
  bool factor;
};

/// A number in [0, 1) for each brick.
float tone_of_brick(std::uint32_t n) {
  n = (n + 1013) & 0x7fffffffu;
  n ^= n >> 13;
  const std::uint32_t mixed = n * (n * n * 60493u + 19990303u) + 1376312589u;
  return 0.5f * static_cast<float>(mixed & 0x7fffffffu) / 1073741824.0f;
}

std::int32_t whole_of(float x) {
  return std::isfinite(x) ? static_cast<std::int32_t>(std::clamp(std::floor(x), -1e9f, 1e9f)) : 0;
}

struct BrickAt {
  float tone;
  float mortar;  ///< 0 on a brick, 1 in mortar
};

BrickAt brick_at(const BrickNode& n) {
  const float x = n.coord.x * n.scale, y = n.coord.y * n.scale;
  const std::int32_t row = whole_of(y / n.height);
  float width = n.width, offset = 0;
  if (n.offset_rows > 0 && n.squash_rows > 0) {
    if (row % n.squash_rows == 0) width *= n.squash;
    if (row % n.offset_rows == 0) offset = width * n.offset;
  }
  const std::int32_t brick = whole_of((x + offset) / width);
  const float along = x + offset - width * static_cast<float>(brick);
  const float up = y - n.height * static_cast<float>(row);
  const auto key =
      (static_cast<std::uint32_t>(row) << 16) + (static_cast<std::uint32_t>(brick) & 0xffffu);
  const float tone = clamp01(tone_of_brick(key) + n.bias);
  const float edge = std::min({along, up, width - along, n.height - up});
  if (!(edge < n.mortar_size)) return {tone, 0};
  const float depth = 1 - edge / n.mortar_size;
  if (!(n.mortar_smooth > 0) || depth >= n.mortar_smooth) return {tone, 1};
  const float t = clamp01(depth / n.mortar_smooth);
  return {tone, t * t * (3 - 2 * t)};
}

void give_brick(const Call& call, void* result) {
  const auto& n = call.as<BrickNode>();
  const BrickAt at = brick_at(n);
  Rgba& out = *static_cast<Rgba*>(result);
  if (n.factor) {
    out = Rgba(at.mortar);
    return;
  }
  const Rgb brick = rgb(n.color1) * (1 - at.tone) + rgb(n.color2) * at.tone;
  const Rgb c = brick * (1 - at.mortar) + rgb(n.mortar) * at.mortar;
  out = {c.x, c.y, c.z, 1};
}

constexpr ParamSpec kBrickRows[] = {
    {ORIEL_PARAM(BrickNode, coord), .doc = "Texture coordinate."},
    {ORIEL_PARAM(BrickNode, color1), .fallback = {.8f, .8f, .8f, 1}, .doc = "First colour."},
    {ORIEL_PARAM(BrickNode, color2), .fallback = {.2f, .2f, .2f, 1}, .doc = "Second colour."},
    {ORIEL_PARAM(BrickNode, mortar), .fallback = {0, 0, 0, 1}, .doc = "Colour of the mortar."},
    {ORIEL_PARAM(BrickNode, scale), .fallback = {5}, .doc = "Factor of the coordinates."},
    {ORIEL_PARAM(BrickNode, mortar_size), .fallback = {.02f}, .min = 0,
     .doc = "Width of the mortar on each brick."},
    {ORIEL_PARAM(BrickNode, mortar_smooth), .fallback = {.1f}, .min = 0, .max = 1,
     .doc = "Part of the mortar that blends into the brick."},
    {ORIEL_PARAM(BrickNode, bias), .min = -1, .max = 1,
     .doc = "Shift of the mixture to the second colour."},
    {ORIEL_PARAM(BrickNode, width), .fallback = {.5f}, .doc = "Width of a brick with mortar."},
    {ORIEL_PARAM(BrickNode, height), .fallback = {.25f}, .doc = "Height of a row."},
    {ORIEL_PARAM(BrickNode, offset), .fallback = {.5f}, .doc = "Shift of rows, in widths."},
    {ORIEL_PARAM(BrickNode, squash), .fallback = {1}, .doc = "Factor of the width in some rows."},
    {ORIEL_PARAM(BrickNode, offset_rows), .fallback = {2}, .min = 0, .max = 99,
     .doc = "Every how many rows are shifted; 0 = none."},
    {ORIEL_PARAM(BrickNode, squash_rows), .fallback = {2}, .min = 0, .max = 99,
     .doc = "Every how many rows have another width; 0 = none."},
    {ORIEL_PARAM(BrickNode, factor),
     .doc = "Whether the result is the amount of mortar in place of the colour."},
};

}  // namespace

const ShaderSpec kOrielBrick = {
    .name = "oriel_brick",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Bricks of two colours with mortar.",
    .params = kBrickRows,
    .params_size = sizeof(BrickNode),
    .value = give_brick,
};

}  // namespace oriel
