// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/sharp_caustics.h"

#include <ImathBoxAlgo.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "geom/accel.h"
#include "lights/sample_light.h"
#include "transport/lobes.h"
#include "transport/surface.h"

namespace oriel {
namespace {

/// Weight of a mirror or glass lobe from which on an instance casts caustics. Varnish and polished
/// stone are below it: their caustics are weak, and with them everything in a room would cast some.
constexpr float kLeastMirror = 0.1f;
/// The same of glossy lobes. That of varnish is above it: paths find its reflections of the sun as
/// rare bright samples. With photons an interior with a varnished floor has 1/24 of the squared
/// error.
constexpr float kLeastGloss = 0.02f;
/// Alpha up to which a glossy lobe is narrow: light samples on wider ones have little noise. A
/// guess.
constexpr float kNarrowAlpha = 0.3f;
/// Own depth of reflections from which on it does not matter.
constexpr int kDeepReflections = 4;
/// Cosine of the view for which lobes are evaluated.
constexpr float kCosine = 0.7f;
/// Places of an instance at which its surface is evaluated.
constexpr std::size_t kPlaces = 16;
/// A light is small if its area covers less than this share of the directions at a quarter of the
/// scene's diagonal.
constexpr float kSmallShare = 0.01f;

bool is_small(const Light& light, float scene_diagonal) {
  const float distance = scene_diagonal / 4;
  return light.area < kSmallShare * 4 * kPi * distance * distance;
}

/// Whether rays that leave mirrors can hit the light.
bool is_met_by_mirrors(const Light& light) { return has_extent(light.shape) && light.visible; }

/// Whether samples of the light at a surface have the light of its photons: it casts shadows, and
/// has no factors for lobes.
bool agrees_with_samples(const World& world, const Light& light) {
  if (!light.shader || light.shader->runs_code_of_users() || light.placed_by_shader) return false;
  const geom::Box3 box = world.accel->bounds();
  ShadingPoint point;
  point.world = &world;
  point.position = has_extent(light.shape) || light.has_direction
                       ? light.position + light.direction * (length(box.size()) / 10)
                       : Vec3(box.center());
  point.normal = point.geometric_normal = -light.direction;
  const auto sample = sample_light(light, point, Vec2(0.5f));
  return sample && sample->shadow && sample->shadow_factor == 0 && sample->affects_specular == 1 &&
         !sample->force_specular;
}

std::uint8_t ways_of_light(const World& world, const Light& light, CausticLights which) {
  if (light.portal || light.photons.none || !gives_direct_light(light)) return 0;
  const bool small = is_small(light, length(world.accel->bounds().size()));
  const bool met = is_met_by_mirrors(light);
  const bool missed = !met || (world.options.caustic.on && small);
  if (which == CausticLights::Missed) return missed ? kByMirror : 0;
  std::uint8_t ways = missed ? 0 : kByMirror;
  if (small && agrees_with_samples(world, light)) ways |= kByGloss;
  return ways;
}

/// The middle of a triangle, seen at a slant from its front; false for a triangle without area.
bool look_at(const World& world, std::uint32_t instance, std::uint32_t primitive, geom::Ray& ray,
             geom::Hit& hit) {
  const geom::InstanceDesc& desc = world.accel->instance(instance);
  const geom::Mesh& mesh = world.accel->mesh(desc.mesh);
  const geom::Triangle& triangle = mesh.triangles[primitive];
  Mat4 to_world, to_object;
  world.accel->placement_at(instance, 0, to_world, to_object);
  Vec3 corners[3];
  int k = 0;
  for (const std::uint32_t vertex : {triangle.a, triangle.b, triangle.c}) {
    corners[k] = mesh.positions[vertex];
    if (!world.accel->is_baked(desc.mesh)) corners[k] = transform_point(corners[k], to_world);
    ++k;
  }
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const float area = length(normal);
  if (!(area > 0)) return false;
  const Vec3 view =
      Frame(normal / area).to_world(Vec3(std::sqrt(1 - kCosine * kCosine), 0, kCosine));
  hit.instance = instance;
  hit.primitive = primitive;
  hit.u = hit.v = 1.0f / 3;
  hit.ng = normal;
  hit.t = std::sqrt(area);
  ray.org = (corners[0] + corners[1] + corners[2]) / 3 + view * hit.t;
  ray.dir = -view;
  ray.mask = geom::RayMask::FinalGather;
  return true;
}

/// Whether rays find lights by way of the lobe just as light samples do.
bool is_unlimited(const Lobe& lobe) {
  const LobeControls& controls = lobe.controls;
  return !controls.highlights_only && !(controls.falloff_distance > 0) &&
         !controls.single_environment &&
         (controls.depth == 0 || controls.depth >= kDeepReflections);
}

/// How the surface scatters light at the middle of a triangle.
unsigned ways_at(const World& world, std::uint32_t instance, std::uint32_t primitive) {
  geom::Ray ray;
  geom::Hit hit;
  if (!look_at(world, instance, primitive, ray, hit)) return 0;
  const Material& material = material_of(world, hit);
  if (!material.photon.empty()) return 0;
  ShadingPoint point;
  fill_point(world, ray, hit, {}, RayKind::PhotonLight, point);
  Closure closure;
  shade_for_photons(material, point, closure);
  float mirror = 0, gloss = 0;
  const int mode = closure.light_mode;
  bool follows_samples = mode != 1 && mode != 2 && closure.lights.size == 0;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    const float weight = max_component(lobe.weight) * closure.opacity;
    if (is_delta(lobe.kind) && !lobe.controls.highlights_only) mirror += weight;
    if (group_of(lobe.kind) != LobeGroup::Reflection || is_delta(lobe.kind)) continue;
    follows_samples &= is_unlimited(lobe);
    if (lobe.kind == LobeKind::GlossyReflection &&
        std::max(lobe.alpha_x, lobe.alpha_y) <= kNarrowAlpha)
      gloss += weight;
  }
  unsigned ways = 0;
  if (mirror >= kLeastMirror) ways |= kByMirror;
  if (gloss >= kLeastGloss && follows_samples) ways |= kByGloss;
  return ways;
}

/// Of the wanted ways, those of an instance.
unsigned ways_by_instance(const World& world, std::uint32_t instance, unsigned wanted) {
  const InstanceData& data = world.instances[instance];
  const unsigned flags = photon_bits(data.visibility, true);
  constexpr unsigned kNeeded = kMeetsCaustics | kCastsCaustics;
  if ((flags & kNeeded) != kNeeded) return 0;
  const geom::InstanceDesc& desc = world.accel->instance(instance);
  if (!(desc.mask & geom::RayMask::FinalGather)) return 0;
  const std::size_t count = world.accel->mesh(desc.mesh).triangles.size();
  const std::size_t places = std::min(count, kPlaces);
  const bool sends = (data.visibility & kSendsReflections) != 0;
  if (data.linked || !data.receives_shadow || !sends) wanted &= ~unsigned{kByGloss};
  unsigned ways = 0;
  for (std::size_t i = 0; i < places && ways != wanted; ++i)
    ways |= wanted & ways_at(world, instance,
                             static_cast<std::uint32_t>((2 * i + 1) * count / (2 * places)));
  return ways;
}

/// Whether all objects stop photons just as they cast shadows.
bool all_cast_shadows(const World& world) {
  if (world.options.shadow == scene::ShadowMode::Off) return false;
  constexpr std::uint32_t kShadows = geom::RayMask::Shadow | geom::RayMask::ShadowTransparent;
  for (std::uint32_t i = 0; i < world.accel->instance_count(); ++i) {
    const std::uint32_t mask = world.accel->instance(i).mask;
    if (((mask & kShadows) != 0) != ((mask & geom::RayMask::FinalGather) != 0)) return false;
  }
  return true;
}

SharpCaustics::Sphere bounding_sphere(const geom::Accel& accel, std::uint32_t instance) {
  const geom::InstanceDesc& desc = accel.instance(instance);
  const geom::Mesh& mesh = accel.mesh(desc.mesh);
  geom::Box3 local = mesh.bounds();
  for (const auto& key : mesh.keys)
    for (std::size_t i = 0; i + 1 < key.size(); ++i) local.extendBy(key[i]);
  if (accel.is_baked(desc.mesh)) return {local.center(), length(local.size()) / 2};
  geom::Box3 box;
  constexpr int kTimes = 8;
  for (int i = 0; i <= kTimes; ++i) {
    Mat4 to_world, to_object;
    accel.placement_at(instance, static_cast<float>(i) / kTimes, to_world, to_object);
    box.extendBy(Imath::transform(local, to_world));
  }
  return {box.center(), length(box.size()) / 2};
}

}  // namespace

SharpCaustics::SharpCaustics(const World& world, CausticLights which)
    : lights_(world.lights.size(), 0), casters_(world.instances.size(), 0) {
  unsigned wanted = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i)
    wanted |= lights_[i] = ways_of_light(world, world.lights[i], which);
  if (!all_cast_shadows(world)) wanted &= ~unsigned{kByGloss};
  if (wanted == 0) {
    lights_.assign(lights_.size(), 0);
    return;
  }
  parallel_for(world.accel->instance_count(), [&](std::size_t i) {
    casters_[i] =
        static_cast<std::uint8_t>(ways_by_instance(world, static_cast<std::uint32_t>(i), wanted));
  });
  unsigned found = 0;
  for (std::uint32_t i = 0; i < world.accel->instance_count(); ++i) {
    if (casters_[i] == 0) continue;
    found |= casters_[i];
    bounds_.push_back({bounding_sphere(*world.accel, i), casters_[i]});
  }
  for (std::uint8_t& ways : lights_) {
    ways = static_cast<std::uint8_t>(ways & found);
    light_count_ += ways != 0 ? 1 : 0;
  }
}

std::vector<SharpCaustics::Sphere> SharpCaustics::spheres(int light) const {
  std::vector<Sphere> spheres;
  for (const Caster& caster : bounds_)
    if ((caster.ways & ways_of(light)) != 0) spheres.push_back(caster.bounds);
  return spheres;
}

}  // namespace oriel
