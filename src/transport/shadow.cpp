// SPDX-License-Identifier: Apache-2.0
#include "transport/shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/math.h"
#include "lights/sample_light.h"
#include "runtime/bump.h"
#include "transport/lobes.h"
#include "transport/medium.h"
#include "transport/surface.h"

namespace oriel {
namespace {

/// Maximum number of transparent blockers on a shadow ray; beyond it the light is lost.
constexpr int kMaxShadowBlockers = 128;
/// Shadow rays end at this share of the distance, so that a light's housing at the sample does not
/// block it.
constexpr float kShortOfLight = 1 - 1e-4f;

Transmittance straight_transmission(const StraightLight& light) {
  const Rgb hole(1 - light.opacity);
  return {hole + light.all * light.opacity, hole + light.clear * light.opacity, hole};
}

constexpr Transmittance kClosed{Rgb(0), Rgb(0), Rgb(0)}, kOpen{};

float short_of_light(float distance) {
  return std::isinf(distance) ? distance : distance * kShortOfLight;
}

/// Multiplies by the transmittance of a blocker.
void pass(const Material& material, const Closure& closure, ShadingPoint& blocker,
          const scene::RenderOptions& options, Transmittance& open) {
  if (!material.shadow.empty()) {
    const Rgb before = open.all;
    open.all = filter_light(material, blocker, before);
    for (int k = 0; k < 3; ++k) open.clear[k] *= before[k] > 0 ? open.all[k] / before[k] : 0;
  }
  if (!material.filters_shadows() || !material.shadow_surface.empty())
    open *= straight_transmission(closure, options);
  // Rays that see the surface ignore its shadow replacement.
  if (material.filters_shadows()) open.cut_outs = Rgb(0);
}

/// Shades a blocker of a shadow ray from the point. Returns its material.
const Material& shade_hit(const World& world, const ShadingPoint& point, const geom::Ray& ray,
                          const geom::Hit& hit, int light, ShadingPoint& blocker,
                          Closure& closure) {
  fill_point(world, ray, hit, {}, RayKind::Shadow, blocker);
  blocker.raster = point.raster;
  blocker.light = light;
  const Material& material = material_of(world, hit);
  shade_blocker(material, blocker, closure);
  return material;
}

/// Collects the transparent blockers of a shadow ray in one traversal of the scene. Light that
/// passes several is the same in any order, unless shadow shaders filter it or the segments between
/// them absorb it. Blockers of constant transmission are evaluated after the traversal, since light
/// that an opaque surface blocks does not need them.
class BlockersInAnyOrder final : public geom::BlockTest {
 public:
  BlockersInAnyOrder(const World& world, const ShadingPoint& point, const geom::Ray& ray, int light)
      : world_(world), point_(point), ray_(ray), light_(light) {}

  bool blocks(const geom::Hit& hit) override {
    const Material& material = material_of(world_, hit);
    in_order_ |= material.filters_shadows();
    if (in_order_) return false;
    if (!material.straight_by_angle || waiting_count_ == kMaxShadowBlockers) return !pass(hit);
    waiting_[static_cast<std::size_t>(waiting_count_++)] = hit;
    return false;
  }

  /// Of all blockers; nothing if they have to be shaded in their order.
  std::optional<Transmittance> transmittance() {
    for (int i = 0; i < waiting_count_ && !in_order_; ++i)
      if (!pass(waiting_[static_cast<std::size_t>(i)])) return kClosed;
    if (in_order_) return std::nullopt;
    // In one order, so that sums round alike.
    const auto end = passed_.begin() + count_;
    std::sort(passed_.begin(), end, [](const Passed& a, const Passed& b) {
      return a.t != b.t ? a.t < b.t : a.id < b.id;
    });
    Transmittance open;
    float from = 0;
    for (auto p = passed_.begin(); p != end; ++p) {
      if (p->t < from) continue;
      from = p->next;
      open *= {p->all, p->clear, p->cut_outs};
    }
    return max_component(open.all) > 0 ? open : kClosed;
  }

 private:
  static constexpr float kMinCosine = 1e-3f;
  struct Passed {
    float t, next;  ///< next: from which on further surfaces are met
    std::uint64_t id;
    Rgb all, clear, cut_outs;  // not a Transmittance, whose constructor sets it
  };

  struct Blocker {
    Transmittance here;
    float offset, cosine;  ///< offset of rays that leave it; of the ray to the geometric normal
    bool bounds_medium;    ///< whether light fades on one side of it
  };
  /// Records a blocker. False: no light passes.
  bool pass(geom::Hit hit) {
    world_.accel->refine(ray_, hit);
    const ShaderNode* by_angle = material_of(world_, hit).straight_by_angle;
    const Blocker at = by_angle ? unshaded(*by_angle, hit) : shaded(hit);
    in_order_ |= at.bounds_medium && straight_rays_fade(world_.options);
    const Transmittance& here = at.here;
    if (max_component(here.all) <= 0 || count_ == kMaxShadowBlockers) return false;
    if (here.all == Rgb(1) && here.cut_outs == Rgb(1)) return true;
    // A ray that leaves the surface starts at an offset.
    passed_[static_cast<std::size_t>(count_++)] = {
        hit.t,
        hit.t + at.offset / std::max(std::abs(at.cosine), kMinCosine),
        std::uint64_t{hit.instance} << 32 | hit.primitive,
        here.all,
        here.clear,
        here.cut_outs};
    return true;
  }
  Blocker shaded(const geom::Hit& hit) const {
    ShadingPoint at;
    Closure closure;
    shade_hit(world_, point_, ray_, hit, light_, at, closure);
    return {straight_transmission(closure, world_.options), at.ray_offset,
            dot(at.geometric_normal, ray_.dir), !closure.thin_walled && !closure.inside.clear()};
  }
  Blocker unshaded(const ShaderNode& shader, const geom::Hit& hit) const {
    geom::SurfacePoint at;
    world_.accel->interpolate(hit, at);
    const float cosine = dot(at.ng, ray_.dir);
    const Vec3 wo = -ray_.dir;
    const float seen = dot(facing_viewer(cosine > 0 ? -at.ns : at.ns, wo), wo);
    const StraightLight light =
        shader.spec().material.straight(shader, world_, static_cast<int>(at.user), seen);
    return {straight_transmission(light), at.offset, cosine, light.bounds_medium};
  }

  const World& world_;
  const ShadingPoint& point_;
  const geom::Ray& ray_;
  int light_;
  bool in_order_ = false;
  int waiting_count_ = 0, count_ = 0;
  // Not initialised before they are needed.
  union {
    std::array<geom::Hit, kMaxShadowBlockers> waiting_;
  };
  std::array<Passed, kMaxShadowBlockers> passed_;
};

}  // namespace

Rgb transmittance(const Medium& medium, float distance) {
  Rgb t(math::exp(-medium.absorption.x * distance), math::exp(-medium.absorption.y * distance),
        math::exp(-medium.absorption.z * distance));
  if (medium.black_distance > 0) t *= clamp01(1 - distance / medium.black_distance);
  return t;
}

Transmittance straight_transmission(const Closure& closure, const scene::RenderOptions& options) {
  StraightLight light{.opacity = closure.opacity};
  if (!bends_light(closure, options))
    for (int i = 0; i < closure.count; ++i) {
      const Lobe& lobe = closure.lobes[i];
      if (!transmits(lobe.kind)) continue;
      light.all += lobe.weight;
      if (is_delta(lobe.kind)) light.clear += lobe.weight;
    }
  return straight_transmission(light);
}

bool hidden_from_rays(const World& world, const ShadingPoint& point, const Vec3& wi, float distance,
                      std::uint32_t lobes, RayCounts& counts) {
  if (!(world.shadowless & lobes)) return false;
  ++counts.shadow;
  return world.accel->occluded(leave(point, wi, distance * kShortOfLight, lobes));
}

bool shadowed_by_unseen(const World& world, const ShadingPoint& point, const Vec3& wi,
                        float distance, RayCounts& counts) {
  if (!world.has_unseen_blockers) return false;
  ++counts.shadow;
  return world.accel->occluded(leave(point, wi, distance * kShortOfLight, geom::RayMask::Shadow));
}

Rgb straight_through(const Material& material, ShadingPoint& point,
                     const scene::RenderOptions& options, Closure& by) {
  point.light = -1;
  shade_blocker(material, point, by);
  Transmittance open;
  pass(material, by, point, options, open);
  return open.all;
}

Transmittance shadow_transmittance(const World& world, const ShadingPoint& point, const Vec3& wi,
                                   float distance, RayCounts& counts, int light) {
  geom::Ray ray = leave(point, wi, short_of_light(distance), geom::RayMask::Shadow);
  ++counts.shadow;
  if (!world.has_transparent_blockers) return world.accel->occluded(ray) ? kClosed : kOpen;
  if (!world.has_object_volumes) {
    ray.mask |= geom::RayMask::ShadowTransparent;
    BlockersInAnyOrder blockers(world, point, ray, light);
    if (world.accel->occluded(ray, geom::RayMask::ShadowTransparent, blockers)) return kClosed;
    if (const auto open = blockers.transmittance()) return *open;
  } else if (world.accel->occluded(ray)) {
    return kClosed;
  }
  return transparent_transmittance(world, point, wi, distance, counts, light);
}

Transmittance transparent_transmittance(const World& world, const ShadingPoint& point,
                                        const Vec3& wi, float distance, RayCounts& counts,
                                        int light) {
  if (!world.has_transparent_blockers) return {};
  geom::Ray ray = leave(point, wi, short_of_light(distance), geom::RayMask::ShadowTransparent);
  const bool segments = world.options.shadow == scene::ShadowMode::Segments;
  Transmittance open;
  const auto dim = [&](const Rgb& t) { open *= {t, t, t}; };
  MediumOnWay way;
  way.begin_in(volume_around(world, ray));
  Vec3 left = point.position;
  for (int i = 0; i < kMaxShadowBlockers; ++i) {
    geom::Hit hit;
    ++counts.shadow;
    if (!world.accel->intersect(ray, hit)) {
      // The light is inside glass.
      if (segments && !way.medium.clear() && !std::isinf(ray.tfar))
        dim(transmittance(way.medium, ray.tfar));
      if (way.volume && !std::isinf(ray.tfar))
        dim(volume_transmittance(world, *way.volume, left, wi, ray.tfar));
      return open;
    }
    ShadingPoint blocker;
    Closure closure;
    const Material& material = shade_hit(world, point, ray, hit, light, blocker, closure);
    way.meet_surface(closure, blocker);
    if (way.volume)
      dim(volume_transmittance(world, *way.volume, left, wi, length(blocker.position - left)));
    if (segments) {
      // Measured from the surface, not from the offset origin, since glass may be thin.
      dim(transmittance(way.medium, length(blocker.position - left)));
    }
    pass(material, closure, blocker, world.options, open);
    if (max_component(open.all) <= 0) return kClosed;
    way.leave(closure, blocker, wi);
    const float rest = ray.tfar - hit.t;
    if (!(rest > 0)) return open;
    ray = leave(blocker, wi, rest, geom::RayMask::ShadowTransparent);
    left = blocker.position;
  }
  return kClosed;
}

}  // namespace oriel
