// SPDX-License-Identifier: Apache-2.0
#include "transport/manifold/chain_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bsdf/fresnel.h"
#include "lights/light_shape.h"
#include "lights/sample_light.h"
#include "transport/lobes.h"
#include "transport/medium.h"
#include "transport/shadow.h"
#include "transport/surface.h"

namespace oriel {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
/// The last segment ends at this share of its length, so that a housing at the light does not block
/// it.
constexpr float kShortOfEnd = 1 - 1e-4f;
/// Differences of indices and of unit normals up to which two descriptions of a surface agree.
constexpr float kSameIndex = 1e-3f, kSameNormal = 1e-3f;

/// Weight of the lobes that do what the kind says of interface i; 0: there are none.
Rgb weight_of(const Closure& closure, const ChainKind& kind, int i, const Vec3& normal,
              const Vec3& wo) {
  Rgb weight(0);
  for (int k = 0; k < closure.count; ++k) {
    const Lobe& lobe = closure.lobes[k];
    if (lobe.controls.highlights_only) continue;
    const bool mirror = lobe.kind == LobeKind::Mirror;
    if (!mirror && lobe.kind != LobeKind::ClearRefraction) continue;
    if ((lobe.frame.n - normal).length2() > sqr(kSameNormal)) return Rgb(0);
    if (mirror) {
      if (!kind.refracts(i)) weight += lobe.weight;
      continue;
    }
    const bool total = !bsdf::refract(wo, normal, lobe.eta).has_value();
    if (total == kind.refracts(i)) continue;
    if (!total && std::abs(lobe.eta / kind.eta[i] - 1) > kSameIndex) return Rgb(0);
    weight += lobe.weight;
  }
  return weight;
}

ShadingPoint seen_from(const World& world, const SpecularChain& chain) {
  ShadingPoint point;
  point.position = chain.position;
  point.ray_direction = -chain.direction;
  point.normal = point.geometric_normal = chain.direction;
  point.world = &world;
  point.time = kAsWritten;
  return point;
}

}  // namespace

bool can_end_chains(const Light& light) {
  return light.path.empty() && !light.portal && !light.placed_by_shader &&
         !(light.emitter && light.emitter->spec().photon.emit);
}

ChainLight place_on_light(const Light& light, const Vec2& u) {
  ChainLight end;
  end.u = u;
  if (light.shape == LightShape::Directional) {
    end.target = {direction_to(light, u), true};
  } else if (light.shape == LightShape::Point) {
    end.target = {light.position, false};
  } else {
    const ShapePoint place = point_on_shape(light, u);
    end.target = {place.position, false};
    end.normal = place.normal;
    end.area = place.area;
  }
  return end;
}

Rgb light_of_chain(const World& world, const Light& light, const ChainLight& end,
                   const SpecularChain& chain) {
  ShadingPoint point = seen_from(world, chain);
  if (!has_extent(light.shape)) {
    const auto sample = sample_light(light, point, end.u, RayKind::PhotonEmitCaustic);
    if (!sample) return Rgb(0);
    const float spread = light.shape == LightShape::Point ? sqr(sample->distance) : 1.0f;
    return sample->irradiance * spread;
  }
  const Vec3 to_light = normalize(end.target.at - chain.position);
  const float cosine = -dot(end.normal, to_light);
  if (!(cosine > 0)) return Rgb(0);
  const auto hit = intersect_light(light, point, to_light, kFar, RayKind::PhotonEmitCaustic);
  return hit ? hit->radiance * (cosine * end.area) : Rgb(0);
}

std::optional<Rgb> passed_by_chain(const World& world, const ChainReceiver& from,
                                   const ChainKind& kind, const SpecularChain& chain,
                                   const ChainTarget& target, RayCounts& counts) {
  geom::Ray last = chain.last;
  last.mask = geom::RayMask::FinalGather | geom::RayMask::Shadow | geom::RayMask::ShadowTransparent;
  const float distance = target.endless ? kFar : length(target.at - chain.position);
  if (!target.endless) last.tfar = distance * kShortOfEnd;
  ++counts.shadow;
  if (world.accel->occluded(last)) return std::nullopt;

  Rgb passed(1);
  MediumOnWay way;
  Vec3 left = from.position;
  for (int i = 0; i < kind.count; ++i) {
    ShadingPoint point;
    fill_point(world, chain.ray[i], chain.hit[i], {},
               i == 0 ? RayKind::PhotonLight : RayKind::PhotonTransmitSpecular, point);
    point.unbent = true;
    const Material& material = material_of(world, chain.hit[i]);
    if (!material.photon.empty() || !material.volume.empty()) return std::nullopt;
    Closure closure;
    shade_for_photons(material, point, closure);
    if (closure.opacity < 1 || closure.volume) return std::nullopt;
    if (kind.refracts(i) && material.may_transmit &&
        (material.filters_shadows() || !bends_light(closure, world.options)))
      return std::nullopt;
    way.meet_surface(closure, point);
    passed *= transmittance(way.medium, length(point.position - left));
    passed *= weight_of(closure, kind, i, chain.normal[i], point.wo());
    if (max_component(passed) <= 0) return std::nullopt;
    way.leave(closure, point, i + 1 < kind.count ? chain.ray[i + 1].dir : chain.direction);
    left = point.position;
  }
  if (way.medium.clear()) return passed;
  if (target.endless) return std::nullopt;
  return passed * transmittance(way.medium, distance);
}

}  // namespace oriel
