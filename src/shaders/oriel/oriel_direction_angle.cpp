// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_direction_angle.h"

#include "base/math.h"

namespace oriel {
namespace {

struct DirectionAngle {
  Rgba direction;
  float offset;
};

constexpr ParamSpec kOrielDirectionAngleRows[] = {
    {ORIEL_PARAM(DirectionAngle, direction), .fallback = {1, .5f, 0, 1},
     .doc = "Direction; red 0 to 1 is -1 to 1 along u, green the same along v."},
    {ORIEL_PARAM(DirectionAngle, offset), .unit = "turns", .doc = "Added to the angle."},
};

void give_angle(const Call& call, void* result) {
  const auto& p = call.as<DirectionAngle>();
  const float x = 2 * p.direction.r - 1, y = 2 * p.direction.g - 1;
  const float angle = x == 0 && y == 0 ? 0 : math::atan2(y, x) / kTwoPi;
  *static_cast<float*>(result) = angle + p.offset;
}

}  // namespace

const ShaderSpec kOrielDirectionAngle = {
    .name = "oriel_direction_angle",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Angle of a direction that a picture stores.",
    .params = kOrielDirectionAngleRows,
    .params_size = sizeof(DirectionAngle),
    .result = ParamType::Scalar,
    .result_size = sizeof(float),
    .value = give_angle,
};

}  // namespace oriel
