// SPDX-License-Identifier: Apache-2.0
// Maya's texture placement, shared by the place node and the file node.
#pragma once

#include "shaders/maya/host_rows.h"

namespace oriel {

struct MayaPlace {
  Vec3 uvCoord, coverage, translateFrame;
  float rotateFrame;
  bool mirrorU, mirrorV, stagger, wrapU, wrapV;
  Vec3 repeatUV, offset;
  float rotateUV;
  Vec3 noiseUV;
};

inline constexpr auto kMayaPlaceRows = about({
    {ORIEL_PARAM(MayaPlace, uvCoord), .doc = "Texture coordinate, used if connected."},
    {ORIEL_PARAM(MayaPlace, coverage), .fallback = {1, 1, 0},
     .doc = "Coverage: size of the frame."},
    {ORIEL_PARAM(MayaPlace, translateFrame), .doc = "Translation of the frame."},
    {ORIEL_PARAM(MayaPlace, rotateFrame), .unit = "radians",
     .doc = "Rotation of the frame about its centre."},
    {ORIEL_PARAM(MayaPlace, mirrorU), .doc = "Whether every other tile is mirrored."},
    {ORIEL_PARAM(MayaPlace, mirrorV), .doc = "Whether every other tile is mirrored."},
    {ORIEL_PARAM(MayaPlace, stagger), .doc = "Whether every other row is shifted by half a tile."},
    {ORIEL_PARAM(MayaPlace, wrapU), .fallback = {1}, .doc = "Whether the frame repeats."},
    {ORIEL_PARAM(MayaPlace, wrapV), .fallback = {1}, .doc = "Whether the frame repeats."},
    {ORIEL_PARAM(MayaPlace, repeatUV), .fallback = {1, 1, 0},
     .doc = "Number of tiles in the frame."},
    {ORIEL_PARAM(MayaPlace, offset), .doc = "Offset of the tiles."},
    {ORIEL_PARAM(MayaPlace, rotateUV), .unit = "radians", .doc = "Rotation of the tiles."},
    {ORIEL_PARAM(MayaPlace, noiseUV), .doc = "Strength of the coordinate noise."},
});

/// A coordinate outside of every frame.
inline const Vec3 kMayaNowhere(-1e6f, -1e6f, 0);
inline bool is_nowhere(const Vec3& uv) { return uv.x < -1e5f; }

/// uv in the placed texture; kMayaNowhere outside of the frame. Checked: MayaTextures.*
Vec3 placed(const MayaPlace& p, const Vec3& uv);

/// Scale factors of uv by the placement, along u and v.
inline Vec2 tiles_of(const MayaPlace& p) {
  const auto ratio = [](float repeat, float coverage) {
    return coverage > 0 ? std::abs(repeat) / coverage : 1;
  };
  return {ratio(p.repeatUV.x, p.coverage.x), ratio(p.repeatUV.y, p.coverage.y)};
}

}  // namespace oriel
