// SPDX-License-Identifier: Apache-2.0
// What a built-in shader is: its table and its functions. One ShaderSpec per shader, listed
// explicitly in shaders/registry.cpp.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/camera.h"
#include "runtime/param.h"
#include "runtime/shading_point.h"

namespace oriel {

namespace scene {
class Scene;
}
struct Closure;
struct Light;
struct PortalTraits;
struct LightPhotons;

/// Where a shader may stand; bits, in the words of `apply`.
enum Apply : unsigned {
  kApplyMaterial = 1u << 0,
  kApplyTexture = 1u << 1,
  kApplyLight = 1u << 2,
  kApplyEnvironment = 1u << 3,
  kApplyLens = 1u << 4,
  kApplyOutput = 1u << 5,
  kApplyShadow = 1u << 6,
  kApplyPhoton = 1u << 7,
  kApplyVolume = 1u << 8,
  kApplyEmitter = 1u << 9,
  kApplyState = 1u << 10
};

/// What a shader works out once from its constant parameters (a sky's tables, a tone curve).
struct ShaderState {
  virtual ~ShaderState() = default;
};

/// A shader in the act: its evaluated parameters, its state and the point.
struct Call {
  const void* params;
  const ShaderState* state;
  ShadingPoint& point;
  const ShaderNode* node = nullptr;  ///< whose call it is; null where parameters stand alone
  template <class P>
  const P& as() const {
    return *static_cast<const P*>(params);
  }
};

/// One sample of a light as its shader sees it.
struct LightCall {
  const Light& light;
  Vec3 position;      ///< of the sample on the light, world; undefined for directional lights
  Vec3 direction;     ///< unit, from the light to the point
  float distance;     ///< infinity for directional lights
  float emitter_cos;  ///< cosine between direction and the emitter's normal; 1 where it has none
};

/// Answer of a light shader. `colour` follows mental ray: a Lambert surface of albedo rho facing
/// the light shows rho * colour (see runtime/light.h, where pi enters).
struct LightValue {
  Rgb colour{0};
  bool shadow = true;       ///< whether blockers matter
  float shadow_factor = 0;  ///< share that passes an opaque blocker
  /// Shares of the light that diffuse lobes take, and glossy reflections and highlights.
  float affects_diffuse = 1, affects_specular = 1;
  bool force_specular = false;  ///< a highlight even though the light itself is seen
  bool is_sun = false;          ///< the physical sun's, for shaders that treat it apart
  /// Where the shader put the sample, world; for lights whose shader places their samples.
  std::optional<Vec3> origin = {};
};

/// What a lens shader that maps colours knows beside the colour.
struct LensCall {
  float cos_to_film = 1;  ///< cosine of the ray to the optical axis
  bool orthographic = false;
};

/// What an exposure asks for beside mapping colours.
struct LensTraits {
  const TextureNode* preview = nullptr;  ///< shown in place of a rendering; null = none
  int side_channel_mode = 0;             ///< see map_output() in runtime/color_mapping.h
  std::string_view side_channel = {};
  float luminance = 0;  ///< cd/m2 that it takes one unit of a pixel for; 0 = no physical unit
  float gamma = 1;
};

/// What lies behind a lens shader that asks for rays itself: the next one, at last the scene.
class LensNext {
 public:
  virtual ~LensNext() = default;
  struct Seen {
    Rgba colour{0, 0, 0, 0};
    float distance = 0;  ///< to the first surface; 0 = none
    Vec3 normal{0};      ///< of that surface
  };
  /// World space, direction unit.
  virtual Seen trace(const Vec3& origin, const Vec3& direction) = 0;
  /// Two independent numbers in [0,1), evenly spread over the samples of a pixel.
  virtual Vec2 next() = 0;
};

/// What a photon shader may do with the photon that met its surface.
class PhotonNext {
 public:
  virtual ~PhotonNext() = default;
  /// Leaves it in the map with that energy.
  virtual void store(const Rgb& energy) = 0;
  /// Sends it on; of several calls one is followed. False where its kind goes no further.
  virtual bool send(RayKind kind, const Rgb& energy, const Vec3& direction) = 0;
  /// Two independent numbers in [0,1), another pair for each photon and call.
  virtual Vec2 next() = 0;
};

/// Where a photon emitter sends the photons of its light.
class PhotonEmission {
 public:
  virtual ~PhotonEmission() = default;
  /// What the photon carries as `energy` of a light writes it: of all photons together.
  virtual Rgb energy() const = 0;
  /// World space, direction unit; of several calls the last counts.
  virtual void send(const Rgb& energy, const Vec3& origin, const Vec3& direction) = 0;
  virtual Vec2 next() = 0;
};

/// An eye sample, to the state shaders that are called around it.
struct EyeSample {
  enum class Moment : std::uint8_t { StateInit, SampleInit, SampleExit, StateExit };
  Moment moment;
  Rgba& colour;             ///< of the sample; black before its ray was traced
  bool answer;              ///< the ray met something
  std::span<Rgba> buffers;  ///< what it leaves in World::user_buffers
};

/// The finished picture in the hands of an output shader.
class OutputPicture;

/// Effect of a volume on the light of one path segment.
///
/// Model:   radiance = transmittance x radiance of the far end + `added` + `scattered` x radiance
///          that arrives at `place` from direction `onward` (unit). `place` is one random sample on
///          the segment; `scattered` is black if there is none, and is not included in `added`.
struct VolumeValue {
  Rgb transmittance{1}, added{0}, scattered{0};
  Vec3 place{0}, onward{0};
};

// Roles
//   A shader has a role where the role's functions are set; null functions and default structs
//   mean that it lacks the role. `const void* params` are constant parameters.

/// Shades surfaces, in the slots of materials.
struct MaterialRole {
  /// Fills the closure.
  void (*fill)(const Call&, Closure&) = nullptr;
  /// In a material's slot `shadow`: what is left of the light so far, which starts as white at the
  /// lit point, behind the blocker at call.point. call.point.light is the light; -1 for the
  /// environment and for rays that replace shadow rays and do not know it.
  Rgb (*shadow)(const Call&, const Rgb& light) = nullptr;
  /// False when constant parameters rule out that light passes (cut-out, transparency).
  bool (*may_transmit)(const ShaderNode&) = nullptr;
  /// False where it emits nothing anywhere. Null: unknown.
  bool (*may_emit)(const ShaderNode&) = nullptr;
  /// Upper bound on the number of lobes it adds itself, by constant parameters. Null: one.
  int (*max_lobes)(const ShaderNode&) = nullptr;
  /// At a point it evaluates only one of the materials it is connected to.
  bool one_material = false;
  /// False when constant parameters leave the result as the only output. Null: it has all.
  bool (*has_outputs)(const ShaderNode&) = nullptr;
  /// Densities of the grids it interpolates over, a bit each. Null: none.
  unsigned (*grids)(const ShaderNode&) = nullptr;
};

/// Says what a light sends.
struct LightRole {
  /// Colour of one light sample.
  LightValue (*evaluate)(const Call&, const LightCall&) = nullptr;
  /// Built once for each light that uses the shader.
  std::unique_ptr<ShaderState> (*prepare)(const void* params, const Light&) = nullptr;
  /// The profile by which a light of constant parameters distributes its light, its strength
  /// apart; null: none. The light's own element may name one: light.luminaire.
  const photometry::LightProfile* (*profile)(const void* params, const Light& light) = nullptr;
  /// For lights in windows (runtime/portal.h), instead of `evaluate`. False: the portal is off.
  bool (*portal)(const void* params, PortalTraits&) = nullptr;
  /// Half-angle (radians) of the cone a directional light comes from; 0 = sharp.
  float (*cone)(const void* params) = nullptr;
  /// Overrides the photon settings of the light's element.
  void (*photons)(const void* params, const Light&, LightPhotons&) = nullptr;
};

/// Acts between camera and film.
struct LensRole {
  /// Maps a colour on its way to the film.
  Rgb (*map_color)(const Call&, const LensCall&, const Rgb&) = nullptr;
  /// Further requests of `map_color`. Null: none.
  LensTraits (*traits)(const ShaderNode&) = nullptr;
  /// Bends an eye ray of the camera through a lens; u is uniform in [0,1)^2. Returns the weight of
  /// the radiance along the ray.
  Rgb (*bend_ray)(const Call&, const Camera&, const Vec2& u, Camera::Ray&) = nullptr;
  /// Number of rays that replace each eye ray, by constant parameters; 0 = the lens is off.
  int (*ray_count)(const ShaderNode&) = nullptr;
  /// Returns the colour of an eye ray, from any number of rays that it traces behind itself.
  Rgba (*trace)(const Call&, LensNext&) = nullptr;
};

/// Sends photons on, or out.
struct PhotonRole {
  /// In a material's slot `photon`: decides what happens to a photon of that energy.
  void (*scatter)(const Call&, const Rgb& energy, PhotonNext&) = nullptr;
  /// In a light's list `emitter`: sends one photon.
  void (*emit)(const Call&, const Light&, PhotonEmission&) = nullptr;
};

/// Acts as a volume.
struct VolumeRole {
  /// Between call.point's ray origin and the surface at its ray_length. Rays of kind Light end at
  /// the lit point and begin at the light, or infinitely far away: only `transmittance` counts.
  /// Rays of photons are passed in the direction of eye rays; `added` is ignored for them.
  VolumeValue (*evaluate)(const Call&) = nullptr;
  /// Whether it is evaluated for rays of kind Light, by constant parameters. Null: it is not.
  bool (*dims_light)(const ShaderNode&) = nullptr;
  /// It also acts on rays that hit nothing, whose ray_length is infinite.
  bool acts_on_endless_rays = false;
};

/// How a call is bound and what it costs.
struct BindingTraits {
  /// Built once from the constant parameters.
  std::unique_ptr<ShaderState> (*prepare)(const void* params, const World&) = nullptr;
  /// Built once from the call: its node and constant parameters, no point. For shaders that keep
  /// state of their own for each call.
  std::unique_ptr<ShaderState> (*prepare_call)(const Call&, const World&) = nullptr;
  /// It evaluates connected parameters itself, one by one (ShaderNode::connections).
  bool deferred = false;
  /// How often one evaluation evaluates its inputs.
  float evaluations = 1;
};

/// A shader of another program that Oriel replaces from its public description:
/// runtime/binder_fallbacks.cpp.
struct FallbackTraits {
  bool is_fallback = false;
  /// Further names of the shader, separated by blanks.
  const char* aliases = "";
  /// It shows its material input unchanged. A connection to a material binds to that input,
  /// whatever the parameter is called.
  bool passes_through = false;
};

/// A built-in shader: its declaration and its roles.
struct ShaderSpec {
  const char* name;
  const char* library;  ///< "architectural", "base", "physics"
  int version = 1;
  unsigned apply = 0;
  const char* doc = "";
  std::span<const ParamSpec> params{};
  std::size_t params_size = 0;
  ParamType result = ParamType::Color;   ///< Struct: see results
  std::span<const ParamSpec> results{};  ///< members of a struct result
  std::size_t result_size = sizeof(Rgba);

  /// Writes the result (Rgba, float, Vec3, bool, int or the result struct).
  void (*value)(const Call&, void* result) = nullptr;
  MaterialRole material{};
  LightRole light{};
  LensRole lens{};
  PhotonRole photon{};
  VolumeRole volume{};
  /// Adds elements to the scene and returns the name of the object or group; empty: none.
  std::string (*geometry)(const Call&, scene::Scene&) = nullptr;
  /// Runs before and after an eye sample, as one of the options' `state` shaders.
  void (*around_sample)(const Call&, EyeSample&) = nullptr;
  /// Works on the finished picture.
  void (*output)(const Call&, OutputPicture&) = nullptr;

  BindingTraits binding{};
  FallbackTraits fallback{};
};

/// Whether two names are the same but for upper and lower case of ASCII letters.
bool same_but_for_case(std::string_view a, std::string_view b);

/// The built-in shaders by name; a plain list, no registration by side effect.
class Registry {
 public:
  explicit Registry(std::vector<const ShaderSpec*> specs) : specs_(std::move(specs)) {}
  /// Names of fallback shaders match whatever their case. `adskMayaX`, as Maya 2012 to 2017 write
  /// it, is `maya_x`.
  const ShaderSpec* find(std::string_view name) const;
  const std::vector<const ShaderSpec*>& all() const { return specs_; }
  void add(const ShaderSpec* spec) { specs_.push_back(spec); }

 private:
  std::vector<const ShaderSpec*> specs_;
};

}  // namespace oriel
