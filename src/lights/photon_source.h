// SPDX-License-Identifier: Apache-2.0
// What leaves a light or the environment: photons whose power agrees with direct light.
#pragma once

#include "lights/sample_light.h"
#include "runtime/world.h"
#include "sampling/sampler.h"

namespace oriel {

class MovedLight;

// Conventions
//   World space. The mean of the power of photons is the flux of the source in the unit whose
//   density on a surface is the irradiance of sample_light. Power is asked from sample_light and
//   intersect_light, so that there is one place that knows how a light shader's colour becomes
//   light. Sources infinitely far away send photons through the silhouette of the box that they
//   aim at; without one, and where they move, through a disc that covers it or the scene.
//   Photons of a light that moves are known where it stands as written; their rays are not.

/// A photon on its way; what it carries is known where it lands.
struct EmittedPhoton {
  Vec3 origin{0};
  Vec3 direction{0, 0, -1};  ///< unit
  float weight = 0;          ///< power for each unit of intensity, irradiance or radiance
  Vec2 u{0};                 ///< that chose the direction
  RayKind kind = RayKind::PhotonEmitGlobillum;  ///< for shaders of the list `emitter`
  Rgb sent{0};                                  ///< power, where such a shader sends it itself
  float time = kAsWritten;                      ///< of a light that moves, once it has set out
};

/// Emits the photons of one light, or of the environment as diffuse surfaces see it.
///
/// Model:   point and spot lights uniform in solid angle, shapes uniform in area and by the cosine
///          (uniform in solid angle where the shader of a flat light leaves the cosine out),
///          directional lights uniform over a disc, the environment by its table, portals by
///          theirs, which shadow rays' extension moves off the opening; whatever shines by a
///          profile in proportion to it, from the shape as the direction sees it. A light whose
///          decay is not that of physics has no flux: its photons carry what direct light is where
///          they land, so that both agree at every first hit. A shader of the list `emitter` that
///          sends photons itself is given the energy of the element, or the flux that the light's
///          shader has; what it sends is what lands. Whether a light casts shadows does
///          not matter: photons are always stopped.
/// Checked: PhotonEmission.* in tests/analytic/photons/photon_test.cpp.
class PhotonSource {
 public:
  PhotonSource(const World& world, const Light& light, const EmissionRequest& request = {});
  /// The environment.
  explicit PhotonSource(const World& world, const EmissionRequest& request = {});

  /// Inputs: two independent draws, each uniform in [0,1)^2.
  EmittedPhoton emit(Vec2 u_place, Vec2 u_direction,
                     RayKind kind = RayKind::PhotonEmitGlobillum) const;
  /// The ray of a photon, at a time while the shutter is open, which the photon then has: photons
  /// are spread over it, and those of a light that moves go from where it is.
  geom::Ray first_ray(EmittedPhoton& photon, const sampling::Sampler& sampler) const;
  /// Power with which a photon lands after a straight way of that length from where its ray began;
  /// black where the light does not reach or send.
  Rgb power(const EmittedPhoton& photon, float distance) const;
  /// Power where nothing was met: at the radius of the scene.
  Rgb power_unmet(const EmittedPhoton& photon) const { return power(photon, scene_radius_); }
  float scene_radius() const { return scene_radius_; }
  /// Whether first hits are stored, for direct light does not bring them.
  bool direct() const { return light_ && light_->portal && light_->portal->photons_only; }
  bool is_environment() const { return !light_; }
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
  std::optional<AimBox> aim_;  // of sources that do not move
  bool by_cosine_ = true;
  bool by_emitter_ = false;          // a shader sends the photons
  std::optional<Rgb> power_of_all_;  // that energy asks for
  float mean_luminance_ = 0;         // of the shader's power, where energy asks
};

}  // namespace oriel
