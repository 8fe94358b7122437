// SPDX-License-Identifier: Apache-2.0
// The input of a shader: the point, its bases, the ray that hit it.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "runtime/placed_matrix.h"

namespace oriel {

struct World;
struct CameraSpace;
struct Material;
class Tracer;

/// The purpose of a shader call, with the order and values of mental ray's miRay_type, so that
/// shaders of scenes can test it and the C interface needs no conversion.
///
/// Kind by context:
///   surfaces      kind of the ray that hit them; photons: of their last scattering
///   textures      kind of the shader that they are connected to
///   lights        Light; for a visible light's shape, kind of the ray that hit it;
///                 PhotonEmit* in the list `emitter`
///   shadow slot   Shadow
///   environment   kind of the ray that hit nothing; FinalGather after a diffuse bounce and where
///                 it replaces all diffuse light; Environment without a ray
///   volumes       kind of the ray; Light between a light and the lit point
///   cut-outs      Probe, for rays that only test for surfaces
/// Absorb, None, LightMap* and the hulls exist only as names.
/// Checked: RayKinds.* in tests/analytic.
enum class RayKind : std::uint8_t {
  Eye,
  Transparent,  ///< straight through a surface without refraction
  Reflect,
  Refract,
  Light,
  Shadow,
  Environment,
  None,
  PhotonAbsorb,
  PhotonLight,  ///< directly from its light
  PhotonReflectSpecular,
  PhotonReflectGlossy,
  PhotonReflectDiffuse,
  PhotonTransmitSpecular,
  PhotonTransmitGlossy,
  PhotonTransmitDiffuse,
  Displace,
  Output,
  PhotonScatterVolume,
  PhotonTransparent,  ///< passed a surface straight
  FinalGather,        ///< also diffuse bounces of paths
  LightMapVertex,
  LightMapMesh,
  PhotonEmitGlobillum,
  PhotonEmitCaustic,
  Probe,
  Hull,
  PhotonHull
};
static_assert(static_cast<int>(RayKind::Displace) == 16 && static_cast<int>(RayKind::Probe) == 25);

/// As mental ray's class tests: rays caused by other rays, and all kinds of photons.
inline constexpr bool is_secondary(RayKind kind) {
  return (kind > RayKind::Eye && kind < RayKind::PhotonAbsorb) || kind == RayKind::FinalGather ||
         kind == RayKind::Hull;
}
inline constexpr bool is_photon(RayKind kind) {
  return (kind >= RayKind::PhotonAbsorb && kind <= RayKind::PhotonTransmitDiffuse) ||
         kind == RayKind::PhotonScatterVolume || kind == RayKind::PhotonTransparent ||
         kind == RayKind::PhotonEmitGlobillum || kind == RayKind::PhotonEmitCaustic ||
         kind == RayKind::PhotonHull;
}

/// How pictures are looked up.
enum class LookUp : std::uint8_t {
  Filtered,      ///< over the footprint of the ray
  Interpolated,  ///< between texels, without footprint
  Nearest        ///< single texels
};

inline constexpr int kMaxTextureSpaces = 8;

// Conventions
//   World space. `ray_direction` points from the ray's origin to the point (mental ray's sense);
//   `wo` = -ray_direction points to the viewer. `normal` and `geometric_normal` face the viewer:
//   dot(geometric_normal, wo) >= 0; `back_side` says that they were turned over for it.
struct ShadingPoint {
  Vec3 position{0};
  Vec3 normal{0, 0, 1};            ///< unit shading normal, facing the viewer; bump moves it
  Vec3 geometric_normal{0, 0, 1};  ///< unit, of the flat triangle, facing the viewer
  bool back_side = false;          ///< seen from behind (the front is counter-clockwise)
  RayKind ray_kind = RayKind::Eye;
  bool environment = false;  ///< no surface: the call is for the environment in ray_direction
  bool blurred = false;      ///< the ray belongs to a glossy lobe
  /// Rays pass transparency without refraction: shadow rays, rays behind a diffuse bounce, photons;
  /// except where the surface makes refractive caustics.
  bool unbent = false;
  /// of the part of a lobe that a look-up represents; 0 = one direction
  float roughness = 0;
  LookUp look_up = LookUp::Filtered;
  std::uint8_t texture_spaces = 0;

  Vec3 ray_origin{0};
  Vec3 ray_direction{0, 0, -1};
  float ray_length = 0;

  bool other_spaces_cleared = false;  ///< tex is null for spaces that the object lacks
  // Only the first texture_spaces of these are set.
  Vec3 tex[kMaxTextureSpaces];     ///< texture coordinates of each space
  Vec3 bump_u[kMaxTextureSpaces];  ///< bump basis, world space; null when absent
  Vec3 bump_v[kMaxTextureSpaces];
  Vec3 dpdu{0}, dpdv{0};  ///< of texture space 0, world units per texture unit
  Vec3 tex_vector{0};     ///< a vector for the material, set by a shader list

  /// Half axes of the ray's footprint on the surface, world units; null when unknown.
  Vec3 dpdx{0}, dpdy{0};

  float ray_offset = 0;         ///< offset of ray origins along the geometric normal
  int instance = -1;            ///< index into World::instances
  std::uint32_t primitive = 0;  ///< triangle of the instance's mesh
  Vec2 on_primitive{0};         ///< weights of its corners b and c
  int light = -1;          ///< for shadow shaders, index into World::lights; -1 = none of these
  PlacedMatrix to_object;  ///< world to object space, null means identity
  PlacedMatrix to_world;
  float time = 0;  ///< of the ray, 0 to 1; see World::shutter
  Vec3 speed{0};   ///< displacement per unit of ray time; null if static
  Vec2 raster{0};  ///< pixels, origin lower left, pixel centres at half steps
  const World* world = nullptr;
  const Material* material = nullptr;  ///< the material whose surface shaders are running
  Tracer* tracer = nullptr;            ///< see runtime/tracer.h
  // For light shaders: properties of the lit surface.
  float glossiness = -1;  ///< of reflections, 1 = mirror, below 0 = unknown
  float importance = 1;   ///< share of the pixel that light there contributes, at most 1

  Vec3 wo() const { return -ray_direction; }
};

/// Length on the surface, perpendicular to the view, that one pixel covers; world units.
inline float pixel_width(const ShadingPoint& point) { return 2 * length(point.dpdy); }

}  // namespace oriel
