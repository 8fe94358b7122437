// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/frame.h"
#include "base/math.h"
#include "runtime/tracer.h"
#include "runtime/world.h"
#include "sampling/warp.h"

namespace oriel {
namespace {

struct Amb {
  int samples;
  Rgba bright, dark;
  float spread, max_distance;
  bool reflective;
  int output_mode;
  bool occlusion_in_alpha;
  float falloff;
  int id_inclexcl, id_nonself;
};
struct Fast {
  int samples;
  Rgba bright, dark;
  float spread, spread_exp, max_distance;
  bool reflective;
  int output_mode;
  bool occlusion_in_alpha;
  int cache_points;
};
struct Fg {
  Rgba result_when_fg_is_off;
};
struct BentEnv {
  Rgba bent_normals;
  bool occlusion_in_alpha;
  Rgba occlusion;
  float strength;
  ShaderRef environment;
  int coordinate_space, env_samples;
  float samples_spread;
  Mat4 matrix;
};

constexpr const char* kSamplesDoc = "Number of rays per pixel.";
constexpr const char* kBright = "Colour without occlusion.";
constexpr const char* kDark = "Colour at full occlusion.";
constexpr const char* kDistanceDoc = "Maximum ray length; 0 = unlimited.";
constexpr const char* kReflective =
    "Whether rays are centred on the mirror direction, instead of the normal.";
constexpr const char* kModeDoc =
    "Output: 0 occlusion, 1 environment, 2 3 4 bent normal in world, camera, "
    "object space.";
constexpr const char* kInAlpha = "Whether alpha is the unoccluded fraction, in modes above 0.";
constexpr const char* kLabels = "Object labels to include; all objects are included.";

constexpr ParamSpec kAmbRows[] = {
    {ORIEL_PARAM(Amb, samples), .fallback = {16}, .min = 0, .doc = kSamplesDoc},
    {ORIEL_PARAM(Amb, bright), .fallback = {1, 1, 1, 1}, .doc = kBright},
    {ORIEL_PARAM(Amb, dark), .fallback = {0, 0, 0, 0}, .doc = kDark},
    {ORIEL_PARAM(Amb, spread), .fallback = {.8f}, .min = 0, .max = 1,
     .doc = "Cone width: 1 = the hemisphere."},
    {ORIEL_PARAM(Amb, max_distance), .min = 0, .unit = "scene units", .doc = kDistanceDoc},
    {ORIEL_PARAM(Amb, reflective), .doc = kReflective},
    {ORIEL_PARAM(Amb, output_mode), .min = 0, .max = 4, .doc = kModeDoc},
    {ORIEL_PARAM(Amb, occlusion_in_alpha), .doc = kInAlpha},
    {ORIEL_PARAM(Amb, falloff), .fallback = {1}, .min = 0,
     .doc = "Exponent of the fade towards max_distance.", .support = Support::Approximated},
    {ORIEL_PARAM(Amb, id_inclexcl), .doc = kLabels, .support = Support::Ignored},
    {ORIEL_PARAM(Amb, id_nonself), .doc = kLabels, .support = Support::Ignored},
};
constexpr ParamSpec kFastRows[] = {
    {ORIEL_PARAM(Fast, samples), .min = 0, .doc = kSamplesDoc, .declared_default = false},
    {ORIEL_PARAM(Fast, bright), .doc = kBright, .declared_default = false},
    {ORIEL_PARAM(Fast, dark), .doc = kDark, .declared_default = false},
    {ORIEL_PARAM(Fast, spread), .min = 0, .max = 1,
     .doc = "Cosine of the cone's half angle: 0 = the hemisphere.", .declared_default = false},
    {ORIEL_PARAM(Fast, spread_exp), .fallback = {1}, .min = 0,
     .doc = "Exponent that concentrates rays within the cone.", .support = Support::Approximated},
    {ORIEL_PARAM(Fast, max_distance), .min = 0, .unit = "scene units", .doc = kDistanceDoc,
     .declared_default = false},
    {ORIEL_PARAM(Fast, reflective), .doc = kReflective, .declared_default = false},
    {ORIEL_PARAM(Fast, output_mode), .min = 0, .max = 4, .doc = kModeDoc,
     .declared_default = false},
    {ORIEL_PARAM(Fast, occlusion_in_alpha), .doc = kInAlpha, .declared_default = false},
    {ORIEL_PARAM(Fast, cache_points), .doc = "Number of cache points; no cache is used.",
     .support = Support::Ignored, .declared_default = false},
};
constexpr ParamSpec kFgRows[] = {
    {ORIEL_PARAM(Fg, result_when_fg_is_off), .fallback = {1, 1, 1, 1},
     .doc = "Result without final gathering."},
};
constexpr ParamSpec kBentEnvRows[] = {
    {ORIEL_PARAM(BentEnv, bent_normals), .fallback = {0, 0, 0, 1},
     .doc = "Bent normal as a colour: 0..1 for -1..1 of each axis."},
    {ORIEL_PARAM(BentEnv, occlusion_in_alpha), .fallback = {1},
     .doc = "Whether the alpha of bent_normals is the occlusion."},
    {ORIEL_PARAM(BentEnv, occlusion), .fallback = {1, 1, 1, 1},
     .doc = "Occlusion, if not taken from bent_normals."},
    {ORIEL_PARAM(BentEnv, strength), .fallback = {.2f}, .doc = "Factor of the result."},
    {ORIEL_PARAM(BentEnv, environment), .doc = "Environment; null = that of the scene.",
     .declared_default = false},
    {ORIEL_PARAM(BentEnv, coordinate_space), .fallback = {2}, .min = 0, .max = 4,
     .doc = "Space of bent_normals: 2 world, 3 camera, 4 object, 0 by the matrix."},
    {ORIEL_PARAM(BentEnv, env_samples), .fallback = {1}, .min = 1,
     .doc = "Look-ups per pixel; at most four per evaluation.", .support = Support::Approximated},
    {ORIEL_PARAM(BentEnv, samples_spread), .min = 0, .max = 1,
     .doc = "Cone width of the look-ups."},
    {ORIEL_PARAM(BentEnv, matrix), .doc = "Matrix from the space of bent_normals to world space."},
};

/// Rays or lookups per evaluation; the samples of the pixel provide the rest.
constexpr int kMaxAtOnce = 4;

/// Common settings of the occlusion shaders.
struct Cone {
  int samples;
  float one_minus_cos;  ///< 1 - cosine of the half angle
  float exponent;       ///< additional exponent of the cosine distribution of rays
  float reach;
  float falloff;
  bool reflective;
};
struct Around {
  float open = 1;
  Vec3 direction{0};  ///< mean unoccluded direction, not normalised
};

/// A ray in the cone; a higher exponent concentrates rays at the axis.
Vec3 sample(const Cone& cone, const Vec2& u) {
  const float least = 1 - cone.one_minus_cos, n = cone.exponent + 2;
  // Density proportional to cosine^(n - 1) from `least` to 1.
  const float c = math::pow(lerp(math::pow(least, n), 1, u.x), 1 / n);
  const float s = std::sqrt(std::max(0.0f, 1 - c * c));
  return Vec3(s * math::cos(kTwoPi * u.y), s * math::sin(kTwoPi * u.y), c);
}

Vec3 axis_of(const Cone& cone, const ShadingPoint& point) {
  if (!cone.reflective) return point.normal;
  const Vec3 wo = point.wo();
  return point.normal * (2 * dot(point.normal, wo)) - wo;
}

Around look_around(const Cone& cone, ShadingPoint& point) {
  Around out;
  const Vec3 axis = axis_of(cone, point);
  if (!point.tracer || cone.samples <= 0) return {1, axis};
  const int rays = std::min(cone.samples, kMaxAtOnce);
  const Frame frame(axis);
  const float reach = cone.reach > 0 ? cone.reach : std::numeric_limits<float>::infinity();
  out.open = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 way = frame.to_world(sample(cone, point.tracer->next()));
    float open = 1;
    if (dot(way, point.geometric_normal) <= 0) {
      open = 0;  // below the surface
    } else if (const auto met = point.tracer->probe_from(point, way, reach)) {
      open = 0;
      if (cone.reach > 0)
        open = 1 - math::pow(clamp01(1 - met->distance / cone.reach), cone.falloff);
    }
    out.open += open / static_cast<float>(rays);
    out.direction += way * open;
  }
  return out;
}

Rgb environment(const ShaderNode* shader, const Vec3& direction, const ShadingPoint& point) {
  if (!point.world) return Rgb(0);
  const NodeList own{shader};
  return rgb(environment_radiance(shader ? own : point.world->environment, *point.world,
                                  point.position, direction, RayKind::FinalGather));
}

/// A unit direction as a colour, in the space of output modes 2..4.
Rgb encoded(const Vec3& direction, int mode, const ShadingPoint& point) {
  Vec3 d = normalize(direction);
  if (mode == 3 && point.world) d = transform_vector(d, point.world->camera.to_camera);
  if (mode == 4 && point.to_object) d = transform_vector(d, *point.to_object);
  d = normalize(d);
  return Rgb(d.x * 0.5f + 0.5f, d.y * 0.5f + 0.5f, d.z * 0.5f + 0.5f);
}

template <class P>
Rgba answer(const P& p, const Around& around, const ShadingPoint& point) {
  if (p.output_mode <= 0) return p.dark + (p.bright - p.dark) * around.open;
  const Rgb c = p.output_mode == 1
                    ? environment(nullptr, normalize(around.direction), point) * around.open
                    : encoded(around.direction, p.output_mode, point);
  return Rgba(c.x, c.y, c.z, p.occlusion_in_alpha ? around.open : 1.0f);
}

void amb(const Call& call, void* result) {
  const auto& p = call.as<Amb>();
  // The half angle of the cone, as a share of a right angle.
  const float half = clamp01(p.spread) * kPi / 2;
  const Cone cone{p.samples, 1 - math::cos(half), 0, p.max_distance, p.falloff, p.reflective};
  *static_cast<Rgba*>(result) = answer(p, look_around(cone, call.point), call.point);
}

void fast(const Call& call, void* result) {
  const auto& p = call.as<Fast>();
  const Cone cone{
      p.samples, 1 - clamp01(p.spread), std::max(0.0f, p.spread_exp - 1), p.max_distance,
      1,         p.reflective};
  *static_cast<Rgba*>(result) = answer(p, look_around(cone, call.point), call.point);
}

void fg(const Call& call, void* result) {
  const auto& p = call.as<Fg>();
  auto& out = *static_cast<Rgba*>(result);
  out = p.result_when_fg_is_off;
  if (!call.point.world || !call.point.world->options.finalgather.on) return;
  out = Rgba(look_around({16, 1, 0, 0, 1, false}, call.point).open);
}

void bent_env(const Call& call, void* result) {
  const auto& p = call.as<BentEnv>();
  ShadingPoint& point = call.point;
  Vec3 d = Vec3(p.bent_normals.r, p.bent_normals.g, p.bent_normals.b) * 2.0f - Vec3(1);
  if (p.coordinate_space == 0) d = transform_vector(d, p.matrix);
  // World-to-camera and world-to-object matrices are inverted by their transpose, up to scale.
  if (p.coordinate_space == 3 && point.world)
    d = transform_normal(d, point.world->camera.to_camera);
  if (p.coordinate_space == 4 && point.to_world) d = transform_vector(d, *point.to_world);
  const Vec3 axis = normalize(d);
  const bool spreads = point.tracer && p.samples_spread > 0 && axis != Vec3(0);
  const int samples = spreads ? std::clamp(p.env_samples, 1, kMaxAtOnce) : 1;
  Rgb seen(0);
  for (int i = 0; i < samples; ++i) {
    Vec3 way = axis;
    if (spreads)
      way = Frame(axis).to_world(
          sampling::sample_cone(point.tracer->next(), 1 - math::cos(p.samples_spread * kPi / 2)));
    seen += environment(p.environment.node, way, point);
  }
  const Rgb open = p.occlusion_in_alpha ? Rgb(p.bent_normals.a) : rgb(p.occlusion);
  const Rgb c = seen * open * (p.strength / static_cast<float>(samples));
  *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, 1);
}

}  // namespace

const ShaderSpec kMibAmbOcclusion = {
    .name = "mib_amb_occlusion",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture | kApplyLight,
    .doc = "Ambient occlusion.",
    .params = kAmbRows,
    .params_size = sizeof(Amb),
    .value = amb,
};

const ShaderSpec kMibFastOcclusion = {
    .name = "mib_fast_occlusion",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Ambient occlusion.",
    .params = kFastRows,
    .params_size = sizeof(Fast),
    .value = fast,
};

const ShaderSpec kMibFgOcclusion = {
    .name = "mib_fg_occlusion",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Ambient occlusion with final gathering.",
    .params = kFgRows,
    .params_size = sizeof(Fg),
    .value = fg,
};

const ShaderSpec kMibBentNormalEnv = {
    .name = "mib_bent_normal_env",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Environment light from a baked bent normal.",
    .params = kBentEnvRows,
    .params_size = sizeof(BentEnv),
    .value = bent_env,
};

}  // namespace oriel
