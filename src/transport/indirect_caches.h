// SPDX-License-Identifier: Apache-2.0
// Indirect light worked out before the picture: what paths read in place of following diffuse rays.
#pragma once

#include "runtime/shading_point.h"
#include "transport/gather/gather_cache.h"
#include "transport/manifold/manifold_caustics.h"
#include "transport/photon/photon_map.h"
#include "transport/photon/sharp_caustics.h"
#include "transport/surface.h"

namespace oriel {

/// The irradiance of the side of a surface that `normal` points to, by a map of photons: PhotonMap
/// or PhotonDiscs.
template <class Map>
Rgb irradiance_at(const Map& map, const ShadingPoint& point, const Vec3& normal,
                  const PhotonLookup& lookup, Rgb* by_light = nullptr, std::size_t unknown = 0,
                  int* found = nullptr) {
  const MapPlace place = map_place(point, normal);
  return map.irradiance(place.position, place.normal, lookup, by_light, unknown, found);
}

/// The same by PhotonMap::coarse_irradiance.
inline Rgb coarse_irradiance_at(const PhotonMap& map, const ShadingPoint& point, const Vec3& normal,
                                const PhotonLookup& lookup) {
  const MapPlace place = map_place(point, normal);
  return map.coarse_irradiance(place.position, place.normal, lookup);
}

/// The query `how` made at a point of the picture: place, side, radii by the width of its pixel.
inline GatherQuery query_at(GatherQuery how, const ShadingPoint& point, const Vec3& normal) {
  const MapPlace place = map_place(point, normal);
  how.position = place.position;
  how.normal = place.normal;
  how.radii = how.radii.in_scene(pixel_width(point));
  return how;
}

/// Null maps are not there. Borrowed: whoever made them outlives the paths.
struct IndirectCaches {
  const GatherCache* gather = nullptr;  ///< read where the eye sees, mirrors and glass between
  GatherQuery query;                    ///< how; place and normal are the asker's
  Rgb gather_scale{1};
  /// Read behind gather rays: coarse records that hold so many further bounces, the sky included.
  const GatherCache* bounces = nullptr;
  GatherQuery bounces_query;
  int bounces_held = 0;
  /// Rays up to this length, times a random number, do not read them; scene units.
  float retrace = 0;
  const PhotonMap* global = nullptr;  ///< read behind gather rays, or by the eye without `gather`
  PhotonLookup global_lookup;
  const PhotonMap* caustic = nullptr;  ///< read everywhere
  /// The caustics that the map contains; null = all. Rays add the others.
  const SharpCaustics* sharp = nullptr;
  PhotonLookup caustic_lookup;
  /// Searched at what the camera sees, to correct the caustic map there; null = not.
  const ManifoldCaustics* chains = nullptr;
  /// Caustics of lights that rays find rarely, read everywhere; null = rays bring them.
  const SharpPhotons* rarely_found = nullptr;

  /// Whether a map that contains some caustics only has that of the light and the instance.
  bool have_sharp(int light, int instance, CausticWay way) const {
    return (sharp && sharp->bring(light, instance, way)) ||
           (rarely_found && rarely_found->of.bring(light, instance, way));
  }
};

}  // namespace oriel
