// SPDX-License-Identifier: Apache-2.0
// Emission of photons by lights and the environment; their power agrees with direct light.
#pragma once

#include "lights/sample_light.h"
#include "runtime/world.h"
#include "sampling/sampler.h"

namespace oriel {

class MovedLight;

// Conventions
//   World space. The mean of the power of photons is the flux of the source in the unit whose
//   density on a surface is the irradiance of sample_light. Power is computed by sample_light
//   and intersect_light, so only these convert the colour of a light shader to light. Infinitely
//   distant sources emit through the silhouette of the box that they aim at; without a box, and if
//   they move, through a disc that covers the box or the scene. Photons of a moving light are
//   expressed at its written placement; their rays are not.

/// An emitted photon; its power is determined at its first hit.
struct EmittedPhoton {
  Vec3 origin{0};
  Vec3 direction{0, 0, -1};  ///< unit
  float weight = 0;          ///< power for each unit of intensity, irradiance or radiance
  Vec2 u{0};                 ///< random numbers of the direction
  RayKind kind = RayKind::PhotonEmitGlobillum;  ///< for shaders of the list `emitter`
  Rgb sent{0};                                  ///< power, if such a shader sets it
  float time = kAsWritten;  ///< of a photon of a moving light, set by first_ray()
};

/// Emits the photons of one light, or of the environment as diffuse surfaces see it.
///
/// Model:   point and spot lights uniform in solid angle, shapes uniform in area and by the cosine
///          (uniform in solid angle if the shader of a flat light omits the cosine), directional
///          lights uniform over a disc, the environment by its table, portals by their table and
///          offset from the opening by the extension of shadow rays; lights with a profile in
///          proportion to it, from the projected shape. A light with unphysical decay has no flux:
///          its photons have the power of direct light at their first hit, so both agree there. A
///          shader of the list `emitter` that emits photons gets the energy of the element, or the
///          flux of the light's shader, and determines the power. Photons are blocked by objects
///          even if the light casts no shadows.
/// Checked: PhotonEmission.* in tests/analytic/photons/photon_test.cpp.
class PhotonSource {
 public:
  PhotonSource(const World& world, const Light& light, const EmissionRequest& request = {});
  /// The environment.
  explicit PhotonSource(const World& world, const EmissionRequest& request = {});

  /// Inputs: two independent samples, each uniform in [0,1)^2.
  EmittedPhoton emit(Vec2 u_place, Vec2 u_direction,
                     RayKind kind = RayKind::PhotonEmitGlobillum) const;
  /// The ray of a photon, at a random time of the shutter interval, which is stored in the photon.
  /// The ray starts at the placement of the light at that time.
  geom::Ray first_ray(EmittedPhoton& photon, const sampling::Sampler& sampler) const;
  /// Power of a photon after a straight distance from the origin of its ray; black if the light
  /// does not reach the point.
  Rgb power(const EmittedPhoton& photon, float distance) const;
  /// Power of a photon that hits nothing: at the radius of the scene.
  Rgb power_unmet(const EmittedPhoton& photon) const { return power(photon, scene_radius_); }
  float scene_radius() const { return scene_radius_; }
  /// Whether first hits are stored because direct light does not include this source.
  bool direct() const { return light_ && light_->portal && light_->portal->photons_only; }
  bool is_environment() const { return !light_; }
  /// Whether emit() maps its two squares to places and directions that do not depend on each other
  /// more than by the extent of the light, so that photons can be aimed by one of them.
  bool can_be_aimed() const {
    return light_ && light_->path.empty() && !by_emitter_ && !aim_ && !light_->portal &&
           light_->shape != LightShape::Sphere && light_->shape != LightShape::Cylinder;
  }
  bool is_endless() const { return !light_ || light_->shape == LightShape::Directional; }
  /// Mean of power_unmet over `samples` photons.
  Rgb estimate_flux(int samples) const;

 private:
  void aim_at(const std::optional<AimBox>& box);
  EmittedPhoton emit_by_light(Vec2 u_place, Vec2 u_direction) const;
  EmittedPhoton emit_by_shader(Vec2 u_place, Vec2 u_direction, RayKind kind) const;
  EmittedPhoton emit_by_profile(Vec2 u_place, Vec2 u_direction) const;
  EmittedPhoton emit_from_afar(const Vec3& direction, Vec2 u) const;
  EmittedPhoton emit_through_silhouette(const AimBox& box, const Vec3& direction, Vec2 u) const;
  Vec3 outside(const Vec3& place, const Vec3& direction) const;
  Rgb power_by_shader(const EmittedPhoton& photon, float distance) const;
  Rgb power_at_rest(const EmittedPhoton& photon, float distance, const MovedLight* moved) const;

  const World* world_;
  const Light* light_ = nullptr;  // null: the environment
  Vec3 scene_centre_{0}, aim_centre_{0};
  float scene_radius_ = 0, aim_radius_ = 0;
  std::optional<AimBox> aim_;  // of static sources
  bool by_cosine_ = true;
  bool by_emitter_ = false;          // a shader emits the photons
  std::optional<Rgb> power_of_all_;  // set by the energy statement
  float mean_luminance_ = 0;         // of the shader's power, for the energy statement
};

}  // namespace oriel
