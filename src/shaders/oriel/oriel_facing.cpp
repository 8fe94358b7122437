// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_facing.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "bsdf/fresnel.h"
#include "runtime/shading_point.h"

namespace oriel {
namespace {

struct Facing {
  int mode;
  float ior, blend;
};

constexpr ParamSpec kFacingRows[] = {
    {ORIEL_PARAM(Facing, mode), .min = 0, .max = 4,
     .doc =
         "0 cosine between normal and view, 1 reflectance of a dielectric, 2 edge weight, 3 fifth "
         "power of 1 - cosine, 4 whether the back side is seen."},
    {ORIEL_PARAM(Facing, ior), .fallback = {1.5f}, .min = 0,
     .doc = "Index of refraction of mode 1."},
    {ORIEL_PARAM(Facing, blend), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Narrowness of the edge of mode 2; near 0 it is narrow."},
};

float edge_weight(float cosine, float blend) {
  const float b = clamp(blend, 0, 1 - 1e-5f);
  const float exponent = b < 0.5f ? 2 * b : 0.5f / (1 - b);
  return 1 - math::pow(cosine, exponent);
}

void give_facing(const Call& call, void* result) {
  const auto& p = call.as<Facing>();
  const ShadingPoint& point = call.point;
  const float cosine = clamp01(std::abs(dot(point.normal, point.wo())));
  float& out = *static_cast<float*>(result);
  switch (p.mode) {
    case 1: {
      const float ior = std::max(p.ior, 1e-3f);
      out = bsdf::fresnel_dielectric(cosine, point.back_side ? 1 / ior : ior);
      break;
    }
    case 2:
      out = edge_weight(cosine, p.blend);
      break;
    case 3:
      out = math::pow(1 - cosine, 5);
      break;
    case 4:
      out = point.back_side ? 1 : 0;
      break;
    default:
      out = cosine;
  }
}

}  // namespace

const ShaderSpec kOrielFacing = {
    .name = "oriel_facing",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Weight by the angle between normal and view.",
    .params = kFacingRows,
    .params_size = sizeof(Facing),
    .result = ParamType::Scalar,
    .result_size = sizeof(float),
    .value = give_facing,
};

}  // namespace oriel
