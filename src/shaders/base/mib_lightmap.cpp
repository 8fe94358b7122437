// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_lightmap.h"

#include <cmath>

#include "runtime/tracer.h"
#include "runtime/world.h"

namespace oriel {
namespace {

struct Sample {
  bool indirect;
  int flip;
  ArrayView<LightRef> lights;
};
struct Write {
  ColorTextureRef texture;
  ShaderRef coord, input;
  int fg_mode;
};
struct Written {
  Vec3 point, normal, tex;
};

constexpr ParamSpec kSampleRows[] = {
    {ORIEL_PARAM(Sample, indirect), .doc = "Whether light of surfaces and environment is included.",
     .declared_default = false},
    {ORIEL_PARAM(Sample, flip), .min = 0, .max = 2,
     .doc = "Lit side: 0 front, 1 back, 2 both added.", .declared_default = false},
    {ORIEL_PARAM(Sample, lights), .doc = "Light list; empty = all lights.",
     .declared_default = false},
};
constexpr const char* kNotMade = "Unsupported; light maps are not written.";
constexpr ParamSpec kWriteRows[] = {
    {ORIEL_PARAM(Write, texture), .doc = kNotMade, .support = Support::Ignored,
     .declared_default = false},
    {ORIEL_PARAM(Write, coord), .doc = kNotMade, .support = Support::Ignored,
     .declared_default = false},
    {ORIEL_PARAM(Write, input), .doc = kNotMade, .support = Support::Ignored,
     .declared_default = false},
    {ORIEL_PARAM(Write, fg_mode), .fallback = {3}, .doc = kNotMade, .support = Support::Ignored},
};
constexpr ParamSpec kWritten[] = {
    {ORIEL_PARAM(Written, point)}, {ORIEL_PARAM(Written, normal)}, {ORIEL_PARAM(Written, tex)}};

void sample(const Call& call, void* result) {
  const auto& p = call.as<Sample>();
  ShadingPoint& point = call.point;
  auto& out = *static_cast<Rgba*>(result);
  out = Rgba(0, 0, 0, 1);
  if (!point.tracer || !point.world) return;
  const Vec3 front = point.back_side ? -point.normal : point.normal;
  const bool on_front = p.flip != 1, on_back = p.flip == 1 || p.flip == 2;
  Rgb sum(0);
  const auto add = [&](int index) {
    const auto arriving = point.tracer->light(index, point);
    if (!arriving) return;
    const float cosine = dot(arriving->wi, front);
    if (cosine > 0 ? on_front : on_back) sum += arriving->colour * std::abs(cosine);
  };
  if (p.lights.size > 0) {
    for (const LightRef light : p.lights)
      if (light.index >= 0) add(light.index);
  } else {
    for (std::size_t i = 0; i < point.world->lights.size(); ++i) add(static_cast<int>(i));
  }
  if (p.indirect && on_front) sum += point.tracer->irradiance(point, front) * kInvPi;
  if (p.indirect && on_back) sum += point.tracer->irradiance(point, -front) * kInvPi;
  out = Rgba(sum.x, sum.y, sum.z, 1);
}

}  // namespace

const ShaderSpec kMibLightmapSample = {
    .name = "mib_lightmap_sample",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Irradiance on the surface.",
    .params = kSampleRows,
    .params_size = sizeof(Sample),
    .value = sample,
};

const ShaderSpec kMibLightmapWrite = {
    .name = "mib_lightmap_write",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture,
    .doc = "Accepted and ignored; light maps are not written.",
    .params = kWriteRows,
    .params_size = sizeof(Write),
    .result = ParamType::Struct,
    .results = kWritten,
    .result_size = sizeof(Written),
    .value =
        [](const Call& call, void* result) {
          *static_cast<Written*>(result) = {
              call.point.position, call.point.normal,
              call.point.texture_spaces > 0 ? call.point.tex[0] : Vec3(0)};
        },
};

}  // namespace oriel
