// SPDX-License-Identifier: Apache-2.0
#include "shaders/physics/parti_volume.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/frame.h"
#include "base/math.h"
#include "runtime/shader_node.h"
#include "runtime/tracer.h"
#include "runtime/world.h"

namespace oriel {
namespace {

struct PartiVolumeParams {
  int mode;
  Rgba scatter;
  float extinction, r, g1, g2, nonuniform, height, min_step_len, max_step_len, light_dist;
  int min_level;
  bool no_globil_where_direct;
  ArrayView<LightRef> lights;
};

constexpr Support kNone = Support::Ignored;

constexpr ParamSpec kPartiVolumeRows[] = {
    {ORIEL_PARAM(PartiVolumeParams, mode), .min = 0, .max = 1,
     .doc = "Extent: 0 everywhere, 1 below height.", .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, scatter),
     .doc = "Scattering albedo: the fraction of the extinction that is scattered.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, extinction), .min = 0, .unit = "per scene unit",
     .doc = "Extinction coefficient.", .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, r), .min = 0, .max = 1, .doc = "Weight of the first lobe.",
     .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, g1), .min = -1, .max = 1,
     .doc = "Anisotropy of the first lobe; above 0 = forward.", .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, g2), .min = -1, .max = 1,
     .doc = "Anisotropy of the second lobe; above 0 = forward.", .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, nonuniform),
     .doc = "Non-uniformity of the medium; ignored, the medium is homogeneous.", .support = kNone,
     .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, height), .unit = "scene units",
     .doc = "Upper end of the medium, along y.", .support = Support::Approximated,
     .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, min_step_len),
     .doc = "Minimum step; ignored, positions are sampled randomly.", .support = kNone,
     .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, max_step_len),
     .doc = "Maximum step; ignored, positions are sampled randomly.", .support = kNone,
     .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, light_dist),
     .doc = "Step near lights; ignored, positions are sampled randomly.", .support = kNone,
     .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, min_level),
     .doc = "Depth from which photons are stored; ignored, none are stored.", .support = kNone,
     .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, no_globil_where_direct),
     .doc = "Whether photons are skipped where there is direct light.", .support = kNone,
     .declared_default = false},
    {ORIEL_PARAM(PartiVolumeParams, lights), .doc = "Lights to scatter; empty = all lights.",
     .declared_default = false},
};

constexpr auto kPhotonRows = [] {
  auto rows = std::to_array(kPartiVolumeRows);
  for (ParamSpec& row : rows) {
    row.doc = "Ignored; photons are scattered by the camera's volume shader.";
    row.support = kNone;
  }
  return rows;
}();

/// Up to so many listed lights are all sampled; of a longer list, one at random, as at surfaces.
constexpr int kListedLights = 4;

float lobe(float cosine, float g) {
  /// Narrower lobes cannot be sampled reliably.
  constexpr float kMax = 0.99f;
  const float a = clamp(g, -kMax, kMax);
  return (1 - a * a) / (4 * kPi * math::pow(1 + a * a - 2 * a * cosine, 1.5f));
}

/// The part of a ray inside the medium.
struct Stretch {
  float begin = 0, end = 0;
  float length() const { return std::max(0.0f, end - begin); }
};

Stretch within(const PartiVolumeParams& p, const Vec3& origin, const Vec3& way, float length) {
  Stretch s{0, length};
  if (std::isinf(length) && p.mode != 1) return {};  // an infinite medium would be opaque
  if (p.mode != 1) return s;
  const float below = p.height - origin.y;
  if (way.y == 0) return below > 0 ? s : Stretch{};
  const float crossing = below / way.y;
  if (way.y > 0)
    s.end = std::min(s.end, crossing);
  else
    s.begin = std::max(s.begin, crossing);
  return s;
}

/// Transmittance from a point to the light, if the medium is not a volume shader of light rays.
float dimmed(const PartiVolumeParams& p, float way, const Vec3& place, const Vec3& wi) {
  if (std::isfinite(way)) return math::exp(-p.extinction * within(p, place, wi, way).length());
  if (p.mode != 1) return 1;  // an infinite medium would be opaque
  if (!(wi.y > 0)) return 0;
  return math::exp(-p.extinction * std::max(0.0f, (p.height - place.y) / wi.y));
}

/// Light of one source scattered towards the viewer at a point, per unit of scattering.
Rgb scattered(const PartiVolumeParams& p, int index, bool dims, ShadingPoint& point) {
  const auto arriving = point.tracer->light(index, point);
  if (!arriving) return Rgb(0);
  // Forward scattering continues the direction of the light, so the cosine is 1 if the light is
  // behind the point.
  const float cosine = dot(arriving->wi, point.ray_direction);
  const float share = clamp01(p.r);
  const float phase = share * lobe(cosine, p.g1) + (1 - share) * lobe(cosine, p.g2);
  // Light colour is irradiance over pi.
  const Rgb irradiance = arriving->colour * kPi;
  if (!dims) return irradiance * phase;
  return irradiance * (phase * dimmed(p, arriving->distance, point.position, arriving->wi));
}

/// Samples the phase functions: a direction about `forward`.
Vec3 turned(const PartiVolumeParams& p, const Vec3& forward, const Vec2& u, float u_lobe) {
  constexpr float kMax = 0.99f;
  const float g = clamp(u_lobe < clamp01(p.r) ? p.g1 : p.g2, -kMax, kMax);
  float cosine = 1 - 2 * u.x;
  if (std::abs(g) > 1e-3f) {
    // Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed., eq. 15.13.
    const float a = (1 - g * g) / (1 - g + 2 * g * u.x);
    cosine = (1 + g * g - a * a) / (2 * g);
  }
  cosine = clamp(cosine, -1, 1);
  const float sine = std::sqrt(1 - cosine * cosine), phi = kTwoPi * u.y;
  return Frame(forward).to_world(Vec3(sine * math::cos(phi), sine * math::sin(phi), cosine));
}

/// The points of a stretch at which the light of light sources is sampled.
///
/// Model:   by transmittance, or in half of the samples such that angles seen from the light are
///          uniform (equiangular), with the balance heuristic. Transmittance alone misses lamps
///          near the ray, whose light grows with the inverse square of the distance. Lights without
///          a place, and stretches without an end, are sampled by transmittance alone.
/// Source:  Kulla, Fajardo, "Importance Sampling Techniques for Path Tracing in Participating
///          Media", Computer Graphics Forum 31(4), 2012, section 3.2.
/// Checked: ScatteringMedium.LampsNearTheRayHaveLittleNoise in tests/analytic
class LightPlaces {
 public:
  struct Place {
    float t;
    float weight;  ///< density by transmittance relative to that of all samples
  };

  /// Inputs:  taken: share of light that the stretch takes; t: a sample by transmittance; u: for
  ///          the other samples; by_angle: whether this is one.
  LightPlaces(const ShadingPoint& eye, const Stretch& s, float extinction, float taken, float t,
              float u, bool by_angle)
      : eye_(eye),
        s_(s),
        extinction_(extinction),
        taken_(taken),
        t_(t),
        u_(u),
        by_angle_(by_angle) {}

  Place of(const Light& light) const {
    if (light.shape == LightShape::Directional || !std::isfinite(s_.end)) return {t_, 1};
    const Vec3 to = light.position - eye_.ray_origin;
    const float nearest = dot(to, eye_.ray_direction);
    // A ray through the light itself has no angle.
    constexpr float kLeast = 1e-3f;
    const float distance = std::max(length(to - eye_.ray_direction * nearest),
                                    kLeast * std::max(s_.length(), length(to)));
    const float from = math::atan((s_.begin - nearest) / distance);
    const float angle = math::atan((s_.end - nearest) / distance) - from;
    if (!(angle > 0)) return {t_, 1};
    float t = t_;
    if (by_angle_) t = clamp(nearest + distance * math::tan(from + u_ * angle), s_.begin, s_.end);
    const float by_angle = distance / (angle * (sqr(distance) + sqr(t - nearest)));
    const float by_loss = extinction_ * math::exp(-extinction_ * (t - s_.begin)) / taken_;
    return {t, 2 * by_loss / (by_loss + by_angle)};
  }

 private:
  const ShadingPoint& eye_;
  const Stretch& s_;
  float extinction_, taken_, t_, u_;
  bool by_angle_;
};

/// The lights to sample at a place: all of a short list, one of a long one; without a list as the
/// tracer picks them.
Tracer::PickedLights lights_to_scatter(const PartiVolumeParams& p, const Vec3& place,
                                       Tracer& tracer) {
  if (p.lights.size == 0) return tracer.pick_lights(place);
  Tracer::PickedLights picked;
  const auto add = [&](int i, float expected_samples) {
    if (const int index = p.lights.begin()[i].index; index >= 0)
      picked.add(index, expected_samples);
  };
  const int count = static_cast<int>(p.lights.size);
  if (count > kListedLights)
    add(std::min(static_cast<int>(tracer.next().x * static_cast<float>(count)), count - 1),
        1 / static_cast<float>(count));
  else
    for (int i = 0; i < count; ++i) add(i, 1);
  return picked;
}

VolumeValue evaluate_medium(const Call& call) {
  const auto& p = call.as<PartiVolumeParams>();
  const ShadingPoint& eye = call.point;
  const bool light = eye.ray_kind == RayKind::Light;
  // Light rays of infinite lights have no origin, so start at the point.
  const Stretch s = light ? within(p, eye.position, -eye.ray_direction, eye.ray_length)
                          : within(p, eye.ray_origin, eye.ray_direction, eye.ray_length);
  const float depth = p.extinction * s.length();
  if (!(depth > 0)) return {};
  VolumeValue out;
  out.transmittance = Rgb(math::exp(-depth));
  if (light || !eye.tracer || !eye.world || is_black(rgb(p.scatter))) return out;
  // Samples a point in proportion to transmittance.
  const float taken = -math::expm1(-depth);
  const Vec2 u = eye.tracer->next();
  const float t = s.begin + std::min(-math::log1p(-u.x * taken) / p.extinction, s.length());
  const auto point_at = [&](float distance) {
    return eye.ray_origin + eye.ray_direction * distance;
  };
  const Vec2 choice = eye.tracer->next();
  out.scattered = rgb(p.scatter) * taken;
  out.place = point_at(t);
  out.onward = turned(p, eye.ray_direction, eye.tracer->next(), choice.x);
  if (is_photon(eye.ray_kind)) return out;
  const NodeList& dimming = eye.world->light_volume;
  const bool dims = std::find(dimming.begin(), dimming.end(), call.node) == dimming.end();
  const LightPlaces places(eye, s, p.extinction, taken, t, u.y, choice.y < 0.5f);
  ShadingPoint point = eye;
  for (const Tracer::PickedLights::Light& picked : lights_to_scatter(p, out.place, *eye.tracer)) {
    const auto place = places.of(eye.world->lights[static_cast<std::size_t>(picked.index)]);
    point.position = point_at(place.t);
    out.added += scattered(p, picked.index, dims, point) * (place.weight / picked.expected_samples);
  }
  out.added *= rgb(p.scatter) * taken;
  return out;
}

}  // namespace

const ShaderSpec kPartiVolume = {
    .name = "parti_volume",
    .library = "physics",
    .version = 3,
    .apply = kApplyVolume,
    .doc = "Absorbing and scattering medium.",
    .params = kPartiVolumeRows,
    .params_size = sizeof(PartiVolumeParams),
    .volume = {.evaluate = evaluate_medium,
               .dims_light = [](const ShaderNode&) { return true; },
               .acts_on_endless_rays = true},
};

const ShaderSpec kPartiVolumePhoton = {
    .name = "parti_volume_photon",
    .library = "physics",
    .version = 3,
    .apply = kApplyPhoton,
    .doc = "Accepted and ignored; photons are scattered by the camera's volume shader.",
    .params = kPhotonRows,
    .params_size = sizeof(PartiVolumeParams),
    .volume = {.evaluate = evaluate_medium},
};

}  // namespace oriel
