// SPDX-License-Identifier: Apache-2.0
#include "lights/light_sampler.h"

#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "lights/emission.h"
#include "lights/light_bounds.h"
#include "runtime/world.h"
#include "sampling/triangle.h"

namespace oriel {
namespace {

/// Lights are weighed as if each had at least this share of the mean: shaders may shine where they
/// were not evaluated.
constexpr float kMinShare = 0.02f;

/// Portals know the openings through which the environment shines, so a vertex after a diffuse
/// bounce samples other directions less often: most of them are blocked. A guess.
constexpr float kEnvironmentBesidePortals = 0.25f;
/// Largest share of the samples that ignore openings, for an environment of small lamps: these may
/// be visible through gaps that are no openings. An environment with at most half of its light
/// above the mean has none.
constexpr float kPlainShareBesideOpenings = 0.1f;
/// Share of light above the mean from which on each vertex takes one sample of the environment.
constexpr float kUnevennessOfOneSample = 0.2f;
/// Below it, samples are so rare that they would only add noise.
constexpr float kMinEnvironmentRate = 0.1f;

/// Whether light from behind the surface counts.
bool is_lit_through(const Closure& closure) {
  return closure.any(
      [](const Lobe& lobe) { return lobe.kind == LobeKind::Translucency || transmits(lobe.kind); });
}

/// Raises the strengths of lights to their least share of the mean.
void raise_to_least(std::span<LightBounds> bounds, const auto& is_skipped) {
  const auto least = [&](float LightBounds::*part) {
    double sum = 0;  // double: many lights
    for (const LightBounds& b : bounds) sum += static_cast<double>(b.*part);
    return kMinShare * static_cast<float>(sum / static_cast<double>(bounds.size()));
  };
  const float even = least(&LightBounds::even), falling = least(&LightBounds::falling);
  const bool none = even + falling == 0;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (is_skipped(i)) continue;
    bounds[i].even = std::max(bounds[i].even, even);
    bounds[i].falling = std::max(bounds[i].falling, none ? 1.0f : falling);
  }
}

}  // namespace

LitVertex::LitVertex(const World& world, const ShadingPoint& point, const Closure& closure)
    : lit_{point.position, is_lit_through(closure) ? Vec3(0) : point.geometric_normal},
      instance_(point.instance < 0 ? nullptr
                                   : &world.instances[static_cast<std::size_t>(point.instance)]),
      listed_(closure.lights),
      placed_(true),
      has_elements_(!world.lights.empty()) {
  const int mode = closure.light_mode;
  by_material_ = mode == 1 || mode == 2 || (mode == 0 && listed_.size > 0);
  const bool linked = !by_material_ && instance_ && instance_->linked;
  excluded_ = by_material_ ? mode == 2 : linked && instance_->lights_exclusive;
  if (by_material_ && !excluded_) count_ = listed_.size;
  if (linked && !excluded_) count_ = static_cast<int>(instance_->lights.size());
  if (!by_material_ && !linked) instance_ = nullptr;
}

int LitVertex::listed_light(int i) const {
  return by_material_ ? listed_.begin()[i].index : instance_->lights[static_cast<std::size_t>(i)];
}

bool LitVertex::is_listed(int light) const {
  if (by_material_)
    return std::any_of(listed_.begin(), listed_.end(),
                       [&](LightRef l) { return l.index == light; });
  const std::vector<int>& linked = instance_->lights;
  return std::find(linked.begin(), linked.end(), light) != linked.end();
}

LightSampler::LightSampler(const World& world, EnvironmentLight environment, MeshLights mesh_lights,
                           Openings openings)
    : world_(world),
      environment_(std::move(environment)),
      mesh_lights_(std::move(mesh_lights)),
      openings_(std::move(openings)) {
  const geom::Box3 box = world.accel->bounds();
  const float reach = box.isEmpty() ? 1 : std::max(length(box.size()) / 2, 1e-6f);
  sets_[kPortals].sample_all = kSampleAllPortals;
  for (std::size_t i = 0; i < world.lights.size(); ++i)
    sets_[set_of(world.lights[i])].lights.push_back(static_cast<int>(i));
  for (const std::size_t k : {kFinite, kPortals}) {
    Set& set = sets_[k];
    if (set.lights.empty()) continue;
    const auto light = [&](std::size_t i) -> const Light& {
      return world.lights[static_cast<std::size_t>(set.lights[i])];
    };
    std::vector<LightBounds> bounds;
    for (std::size_t i = 0; i < set.lights.size(); ++i)
      bounds.push_back(bounds_of(light(i), world, reach, environment_.mean_luminance()));
    raise_to_least(bounds, [&](std::size_t i) { return !gives_direct_light(light(i)); });
    set.tree = LightTree(bounds, set.lights);
  }
}

std::size_t LightSampler::set_of(const Light& light) {
  if (light.shape == LightShape::Directional) return kInfinite;
  return light.portal ? kPortals : kFinite;
}

bool LightSampler::needs_random(const LitVertex& at) const {
  if (at.empty()) return false;
  return at.count_ >= 0 ? at.count_ > kSampleAll : chooses();
}

float LightSampler::Set::expected_samples(const LitPoint& lit, const LightChances& chances,
                                          int light) const {
  if (size() <= sample_all) return 1;
  if (chances) return chances.mixed(place_of(light), tree.probability(lit, light));
  return tree.empty() ? 1 / static_cast<float>(size()) : tree.probability(lit, light);
}

float LightSampler::expected_samples(const LitVertex& at, int light) const {
  if (at.empty() || !is_lit_by(at, light)) return 0;
  if (at.count_ >= 0) return at.count_ > kSampleAll ? 1 / static_cast<float>(at.count_) : 1.0f;
  const std::size_t set = set_of(world_.lights[static_cast<std::size_t>(light)]);
  return sets_[set].expected_samples(at.lit_, chances_of(at, set), light);
}

float LightSampler::plain_samples(bool after_diffuse) const {
  const float rate = std::min(1.0f, environment_.unevenness() / kUnevennessOfOneSample);
  if (rate < kMinEnvironmentRate) return 0;
  return after_diffuse && !portals().empty() ? kEnvironmentBesidePortals * rate : rate;
}

EnvironmentChances LightSampler::environment_chances(const LitVertex& at, bool after_diffuse,
                                                     bool alone) const {
  EnvironmentChances chances;
  if (!environment_.lights()) return chances;
  if (at.placed_) chances.openings = openings_.total(at.lit_);
  if (chances.openings > 0)
    chances.plain = kPlainShareBesideOpenings * std::max(0.0f, 2 * environment_.unevenness() - 1);
  chances.samples = alone || chances.openings > 0 ? 1 : plain_samples(after_diffuse);
  return chances;
}

LightSampler::EnvironmentFound LightSampler::find_environment(const LitVertex* sampled,
                                                              const EnvironmentRay& ray) const {
  if (!sampled) return {environment_radiance(ray), 0};
  const std::size_t cell = environment_.table().cell_of(ray.direction);
  const auto& [samples, plain, openings] = sampled->environment;
  float pdf = 0;
  if (plain > 0) pdf += plain * environment_.pdf(sampled->lit_.normal, ray.direction, cell);
  if (plain < 1) pdf += (1 - plain) * openings_.pdf(sampled->lit_, openings, ray.direction);
  return {environment_.table().radiance(world_, ray, cell), pdf * samples};
}

std::optional<EnvironmentDirection> LightSampler::sample_environment(const LitVertex& at, Vec2 u,
                                                                     bool alone) const {
  const auto& [expected, plain, openings] = at.environment;
  if (u.x >= expected) return std::nullopt;
  u.x = std::min(u.x / expected, 0x1.fffffep-1f);
  constexpr float kFar = std::numeric_limits<float>::infinity();
  if (alone) {
    const auto s = environment_.sample_alone(u);
    return EnvironmentDirection{{s.wi, kFar, s.pdf * expected}, s.cell};
  }
  EnvironmentDirection found{{Vec3(0), kFar, 0}, 0};
  if (u.x < plain) {
    const auto s =
        environment_.sample(at.lit_.normal, Vec2(std::min(u.x / plain, 0x1.fffffep-1f), u.y));
    found.wi = s.wi;
    found.cell = s.cell;
    found.pdf = plain * s.pdf;
    if (plain < 1) found.pdf += (1 - plain) * openings_.pdf(at.lit_, openings, s.wi);
  } else {
    const auto s = openings_.sample(
        at.lit_, openings, Vec2(std::min((u.x - plain) / (1 - plain), 0x1.fffffep-1f), u.y));
    if (!s) return std::nullopt;
    found.wi = s->wi;
    found.cell = environment_.table().cell_of(s->wi);
    found.pdf = (1 - plain) * s->pdf;
    if (plain > 0) found.pdf += plain * environment_.pdf(at.lit_.normal, s->wi, found.cell);
  }
  found.pdf *= expected;
  return found;
}

std::optional<TriangleSample> LightSampler::sample_triangle(const LitPoint& at,
                                                            const LightChances& chances, float time,
                                                            Vec2 u_choice, Vec2 u_place) const {
  return place_on(mesh_lights_.choose(at, chances, u_choice), at, time, u_place);
}

std::optional<TriangleSample> LightSampler::sample_part(std::size_t part, const LitPoint& at,
                                                        float time, Vec2 u_choice,
                                                        Vec2 u_place) const {
  return place_on(mesh_lights_.choose_of(part, at, u_choice), at, time, u_place);
}

std::optional<TriangleSample> LightSampler::place_on(
    const std::optional<MeshLights::Choice>& chosen, const LitPoint& at, float time, Vec2 u) const {
  if (!chosen) return std::nullopt;
  const TriangleCorners corners = corners_of(world_, chosen->instance, chosen->primitive, time);
  const sampling::SphericalTriangle triangle(at.position, corners.a, corners.b, corners.c);
  const auto placed = triangle.sample(u);
  if (!(placed.pdf > 0)) return std::nullopt;
  TriangleSample sample;
  sample.wi = placed.wi;
  sample.distance = placed.distance;
  sample.pdf = chosen->probability * placed.pdf;
  sample.instance = chosen->instance;
  sample.primitive = chosen->primitive;
  return sample;
}

float LightSampler::triangle_pdf(const LitPoint& at, const LightChances& chances, float time,
                                 std::uint32_t instance, std::uint32_t primitive, const Vec3& found,
                                 const Vec3& direction) const {
  // Emissive hair has no triangles.
  const geom::Mesh& mesh = world_.accel->mesh(world_.accel->instance(instance).mesh);
  if (primitive >= mesh.triangles.size()) return 0;
  const float chosen = mesh_lights_.probability(at, chances, instance, primitive);
  if (!(chosen > 0)) return 0;
  const TriangleCorners corners = corners_of(world_, instance, primitive, time);
  const sampling::SphericalTriangle triangle(at.position, corners.a, corners.b, corners.c);
  return chosen * triangle.pdf(direction, length(found - at.position));
}

}  // namespace oriel
