// SPDX-License-Identifier: Apache-2.0
// Where a shader is asked: the point, its bases, the ray that found it.
#pragma once

#include <cstdint>

#include "base/vec.h"
#include "runtime/placed_matrix.h"

namespace oriel {

struct World;
struct CameraSpace;
struct Material;
class Tracer;

/// What a shader is asked for, in the order and with the values of mental ray's miRay_type, so that
/// shaders in scenes can tell them apart and the C interface needs no table.
///
/// Which kind is met where:
///   surfaces      the kind of the ray that met them; photons: of their last scattering
///   textures      as the shader they are connected to
///   lights        Light; the kind of the ray where it sees the shape of a visible light;
///   PhotonEmit*
///                 in the list `emitter` of a light
///   shadow slot   Shadow
///   environment   the kind of the ray that met nothing, FinalGather after a diffuse bounce and
///   where
///                 it stands for all diffuse light; Environment where no ray was traced
///   volumes       the kind of the ray on its way, Light between a light and what it lights
///   cut-outs      Probe, for rays that ask only what is there
/// Absorb, None, LightMap* and the hulls are only names: nothing is asked by them.
/// Checked: RayKinds.* in tests/analytic.
enum class RayKind : std::uint8_t {
  Eye,
  Transparent,  ///< straight through what does not bend it
  Reflect,
  Refract,
  Light,
  Shadow,
  Environment,
  None,
  PhotonAbsorb,
  PhotonLight,  ///< straight from its light
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
  FinalGather,        ///< diffuse bounces of paths as well
  LightMapVertex,
  LightMapMesh,
  PhotonEmitGlobillum,
  PhotonEmitCaustic,
  Probe,
  Hull,
  PhotonHull
};
static_assert(static_cast<int>(RayKind::Displace) == 16 && static_cast<int>(RayKind::Probe) == 25);

/// As mental ray's class tests: rays that other rays caused, and all that belongs to photons.
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
  bool environment = false;     ///< no surface: asked for what lies in ray_direction
  bool blurred = false;         ///< the ray is one of a glossy bundle, not a mirror's
  float roughness = 0;          ///< of the part of a lobe that a look-up stands for; 0: a direction
  bool nearest_texels = false;  ///< textures give single texels, neither filtered nor interpolated
  std::uint8_t texture_spaces = 0;

  Vec3 ray_origin{0};
  Vec3 ray_direction{0, 0, -1};
  float ray_length = 0;

  bool other_spaces_cleared = false;  ///< tex of the spaces that the object lacks is null
  // Only the first texture_spaces of these are set.
  Vec3 tex[kMaxTextureSpaces];     ///< texture coordinates of each space
  Vec3 bump_u[kMaxTextureSpaces];  ///< bump basis, world space; null when absent
  Vec3 bump_v[kMaxTextureSpaces];
  Vec3 dpdu{0}, dpdv{0};  ///< of texture space 0, world units per texture unit
  Vec3 tex_vector{0};     ///< a vector a shader list may leave for the material

  /// Half axes of the ray's footprint on the surface, world units; null when unknown.
  Vec3 dpdx{0}, dpdy{0};

  float ray_offset = 0;         ///< rays may start this far along the geometric normal
  int instance = -1;            ///< index into World::instances
  std::uint32_t primitive = 0;  ///< triangle of the instance's mesh
  Vec2 on_primitive{0};         ///< weights of its corners b and c
  int light = -1;          ///< for shadow shaders, index into World::lights; -1 = none of these
  PlacedMatrix to_object;  ///< world to object space, null means identity
  PlacedMatrix to_world;
  float time = 0;  ///< of the ray, 0 to 1; World::shutter tells when that is
  Vec3 speed{0};   ///< way per unit of ray time; null where nothing moves
  Vec2 raster{0};  ///< pixels, origin lower left, pixel centres at half steps
  const World* world = nullptr;
  const Material* material = nullptr;  ///< whose surface shaders are running
  Tracer* tracer = nullptr;            ///< see runtime/tracer.h
  // For light shaders, of the surface that is lit.
  float glossiness = -1;  ///< of its reflections as the material writes it, 1 = a mirror; below 0:
                          ///< the material does not tell
  float importance = 1;   ///< share of the pixel that light there decides, at most 1

  Vec3 wo() const { return -ray_direction; }
};

/// Length on the surface, across the view, that one pixel covers; world units.
inline float pixel_width(const ShadingPoint& point) { return 2 * length(point.dpdy); }

}  // namespace oriel
