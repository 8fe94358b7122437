// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_tex_vector.h"

namespace oriel {
namespace {

struct TexVector {
  Vec3 vector;
};

constexpr ParamSpec kOrielTexVectorRows[] = {
    {ORIEL_PARAM(TexVector, vector), .fallback = {0, 0, 0},
     .doc = "Vector in world space, any length; null = unchanged."},
};

void leave_vector(const Call& call) {
  const Vec3& v = call.as<TexVector>().vector;
  if (v != Vec3(0)) call.point.tex_vector = v;
}

}  // namespace

const ShaderSpec kOrielTexVector = {
    .name = "oriel_tex_vector",
    .library = "oriel",
    .apply = kApplyTexture | kApplyMaterial,
    .doc = "Vector stored for the next material of the list.",
    .params = kOrielTexVectorRows,
    .params_size = sizeof(TexVector),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value =
        [](const Call& call, void* result) {
          leave_vector(call);
          *static_cast<Vec3*>(result) = call.as<TexVector>().vector;
        },
    .material = {.fill = [](const Call& call, Closure&) { leave_vector(call); },
                 .max_lobes = [](const ShaderNode&) { return 0; }},
};

}  // namespace oriel
