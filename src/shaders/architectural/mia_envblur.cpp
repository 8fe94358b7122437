// SPDX-License-Identifier: Apache-2.0
#include "shaders/architectural/mia_envblur.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/math.h"
#include "bsdf/gloss.h"
#include "bsdf/glossy_reflection.h"
#include "image/sphere_blur.h"
#include "runtime/shader_node.h"
#include "runtime/world.h"

namespace oriel {
namespace {

struct MiaEnvblurParams {
  ShaderRef environment;
  float blur;
  bool mia_material_blur;
  int resolution;
};

constexpr ParamSpec kMiaEnvblurRows[] = {
    {ORIEL_PARAM(MiaEnvblurParams, environment),
     .doc = "Environment to blur; null = the camera's environment."},
    {ORIEL_PARAM(MiaEnvblurParams, blur), .min = 0, .max = 1,
     .doc = "Blur amount, equal to a reflection of glossiness 1 - blur; 0 = no blur."},
    {ORIEL_PARAM(MiaEnvblurParams, mia_material_blur), .fallback = {1},
     .doc = "Whether the blur follows the glossiness of the reflection that looks it up."},
    {ORIEL_PARAM(MiaEnvblurParams, resolution), .fallback = {200}, .min = 16, .max = 4096,
     .doc = "Resolution of the blurred map in each direction."},
};

/// The blurred levels, and the mixture weights of lobes.
struct BlurState final : ShaderState {
  BlurState(NodeList shaders, int resolution, const World& world)
      : source(std::move(shaders)),
        map(resolution * resolution,
            [&](const Vec3& d) {
              return environment_radiance(source, world, Vec3(0), d, RayKind::Reflect, true);
            }),
        // A lobe and a kernel of the map have equal half widths if 1.29 alpha is 1.18 kernel
        // widths.
        least(0.91f * map.width(0)) {
    for (std::size_t i = 0; i < kMixtures; ++i) {
      const float alpha =
          least * math::pow(bsdf::kMaxAlpha / least, static_cast<float>(i) / kSteps);
      const Vec3 up(0, 0, 1);
      const bsdf::GlossyReflection lobe(alpha, alpha, up);
      mixtures[i] = map.weights_of(
          [&](float angle) { return lobe.eval(up, Vec3(math::sin(angle), 0, math::cos(angle))); });
    }
  }

  Rgba blurred(const Vec3& direction, float alpha) const {
    const float at = clamp(math::log(alpha / least) / math::log(bsdf::kMaxAlpha / least), 0, 1);
    const float step = at * kSteps;
    const auto i = std::min(static_cast<std::size_t>(step), kMixtures - 2);
    const float t = step - static_cast<float>(i);
    image::SphereBlur::Weights weights;
    for (std::size_t j = 0; j < weights.size(); ++j)
      weights[j] = lerp(mixtures[i][j], mixtures[i + 1][j], t);
    return map.lookup(direction, weights);
  }

  static constexpr std::size_t kMixtures = 25;
  static constexpr float kSteps = kMixtures - 1;
  NodeList source;
  image::SphereBlur map;
  float least;  // the smallest roughness that the map resolves
  std::array<image::SphereBlur::Weights, kMixtures> mixtures;
};

Rgba sharp(const BlurState& state, ShadingPoint& point) {
  // A nested blur shader must not apply the same roughness again.
  const float roughness = std::exchange(point.roughness, 0.0f);
  Rgba c(0);
  for (const ShaderNode* node : state.source)
    if (node->spec().value) c = node->color(point);
  point.roughness = roughness;
  return c;
}

void blur(const Call& call, void* result) {
  const auto& p = call.as<MiaEnvblurParams>();
  auto& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  if (!call.state) return;
  const auto& state = *static_cast<const BlurState*>(call.state);
  ShadingPoint& point = call.point;
  const bool light = point.ray_kind == RayKind::FinalGather || point.ray_kind == RayKind::Light;
  const float own = p.blur > 0 ? bsdf::gloss_to_alpha(1 - p.blur) : 0.0f;
  const float lobe = p.mia_material_blur ? point.roughness : 0.0f;
  const float alpha = light ? 0.0f : math::hypot(own, lobe);
  const float share = clamp01(alpha / state.least);
  if (share < 1) out = sharp(state, point) * (1 - share);
  if (share > 0) out += state.blurred(normalize(point.ray_direction), alpha) * share;
}

std::unique_ptr<ShaderState> prepare(const void* params, const World& world) {
  const MiaEnvblurParams& p = *static_cast<const MiaEnvblurParams*>(params);
  NodeList source = p.environment.node ? NodeList{p.environment.node} : world.environment;
  if (source.empty()) return nullptr;
  const int resolution = world.coarse_tables ? 16 : std::clamp(p.resolution, 16, 4096);
  return std::make_unique<BlurState>(std::move(source), resolution, world);
}

}  // namespace

const ShaderSpec kMiaEnvBlur = {
    .name = "mia_envblur",
    .library = "architectural",
    .version = 1,
    .apply = kApplyEnvironment | kApplyTexture,
    .doc = "Blurred environment, for noise-free glossy reflections.",
    .params = kMiaEnvblurRows,
    .params_size = sizeof(MiaEnvblurParams),
    .value = blur,
    .binding = {.prepare = prepare},
};

}  // namespace oriel
