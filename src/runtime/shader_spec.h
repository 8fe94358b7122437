// SPDX-License-Identifier: Apache-2.0
// The specification of a built-in shader: its parameter table and its functions.
// shaders/registry.cpp lists one ShaderSpec per shader.
#pragma once

#include <functional>
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
struct World;
struct Light;
struct PortalTraits;
struct LightPhotons;

/// The contexts of a shader as bits, named as in `apply`.
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

/// Precomputed data of a shader that depend on constant parameters only (tables of a sky, a tone
/// curve).
struct ShaderState {
  virtual ~ShaderState() = default;
};

/// A call of a shader: its evaluated parameters, its state and the point.
struct Call {
  const void* params;
  const ShaderState* state;
  ShadingPoint& point;
  const ShaderNode* node = nullptr;  ///< the called node; null if there are only parameters
  template <class P>
  const P& as() const {
    return *static_cast<const P*>(params);
  }
};

/// One sample of a light, as input of its shader.
struct LightCall {
  const Light& light;
  Vec3 position;      ///< of the sample on the light, world; undefined for directional lights
  Vec3 direction;     ///< unit, from the light to the point
  float distance;     ///< infinity for directional lights
  float emitter_cos;  ///< cosine between direction and the emitter's normal; 1 without normal
};

/// The result of a light shader. `colour` follows mental ray: a Lambert surface of albedo rho
/// facing the light has the colour rho * colour (the factor pi is explained in runtime/light.h).
struct LightValue {
  Rgb colour{0};
  bool shadow = true;       ///< false: no shadow rays
  float shadow_factor = 0;  ///< fraction of light that passes an opaque blocker
  /// Factors of the light on diffuse lobes, and on glossy reflections and highlights.
  float affects_diffuse = 1, affects_specular = 1;
  bool force_specular = false;  ///< a highlight even if the light itself is visible
  bool is_sun = false;          ///< the light is the physical sun
  /// Position of the sample in world space, for lights whose shader places their samples.
  std::optional<Vec3> origin = {};
};

/// Further input of a colour-mapping lens shader.
struct LensCall {
  float cos_to_film = 1;  ///< cosine of the ray to the optical axis
  bool orthographic = false;
};

/// Properties of an exposure besides the colour mapping.
struct LensTraits {
  const TextureNode* preview = nullptr;  ///< displayed instead of a rendering; null = none
  int side_channel_mode = 0;             ///< see map_output() in runtime/color_mapping.h
  std::string_view side_channel = {};
  float luminance = 0;  ///< cd/m2 of one pixel unit; 0 = no physical unit
  float gamma = 1;
};

/// The continuation of a lens shader that traces rays: the next lens shader, finally the scene.
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
  /// Two independent numbers in [0,1), stratified over the samples of a pixel.
  virtual Vec2 next() = 0;
};

/// Actions of a photon shader on the photon that hit its surface.
class PhotonNext {
 public:
  virtual ~PhotonNext() = default;
  /// Stores it in the map with that energy.
  virtual void store(const Rgb& energy) = 0;
  /// Continues it; one of several calls is selected. False if a photon of this kind ends here.
  virtual bool send(RayKind kind, const Rgb& energy, const Vec3& direction) = 0;
  /// Two independent numbers in [0,1), different for each photon and call.
  virtual Vec2 next() = 0;
};

/// The output of a photon emitter.
class PhotonEmission {
 public:
  virtual ~PhotonEmission() = default;
  /// Energy of all photons of the light, as in the statement `energy`.
  virtual Rgb energy() const = 0;
  /// World space, direction unit; the last of several calls counts.
  virtual void send(const Rgb& energy, const Vec3& origin, const Vec3& direction) = 0;
  virtual Vec2 next() = 0;
};

/// A camera sample, for state shaders, which are called before and after it.
struct EyeSample {
  enum class Moment : std::uint8_t { StateInit, SampleInit, SampleExit, StateExit };
  Moment moment;
  Rgba& colour;             ///< of the sample; black before its ray was traced
  bool answer;              ///< the ray hit something
  std::span<Rgba> buffers;  ///< the values it writes to World::user_buffers
};

/// The finished picture, for output shaders.
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

/// Light that passes a surface straight, as shadow rays see it.
struct StraightLight {
  Rgb all{0};                  ///< weight of the lobes that transmit
  Rgb clear{0};                ///< the same of those that do not blur
  float opacity = 1;           ///< the rest passes holes
  bool bounds_medium = false;  ///< whether light fades on one side of the surface
};

// Roles
//   A shader has a role where the role's functions are set; null functions and default structs
//   mean that it lacks the role. `const void* params` are constant parameters.

/// Shades surfaces, in the slots of materials.
struct MaterialRole {
  /// Fills the closure.
  void (*fill)(const Call&, Closure&) = nullptr;
  /// In a material's slot `shadow`: returns the light that passes the blocker at call.point. The
  /// input starts as white at the lit point. call.point.light is the light; -1 for the environment
  /// and for rays that replace shadow rays of unknown lights.
  Rgb (*shadow)(const Call&, const Rgb& light) = nullptr;
  /// False if constant parameters exclude transmission (cut-out, transparency).
  bool (*may_transmit)(const ShaderNode&) = nullptr;
  /// Whether the light that passes straight depends on the angle alone, so that shadow rays get it
  /// from `straight` without the closure. Null: it does not.
  bool (*straight_by_angle)(const ShaderNode&) = nullptr;
  /// Inputs:  instance: index in the world; cosine: to the shading normal.
  StraightLight (*straight)(const ShaderNode&, const World&, int instance, float cosine) = nullptr;
  /// False if it emits nothing anywhere. Null: unknown.
  bool (*may_emit)(const ShaderNode&) = nullptr;
  /// The emission if that is the same everywhere, in all directions, and the surface is opaque;
  /// else nothing. Samples of the surface need no closure then. Null: nothing.
  std::optional<Rgb> (*even_emission)(const ShaderNode&) = nullptr;
  /// Upper bound on the number of lobes it adds itself, by constant parameters. Null: one.
  int (*max_lobes)(const ShaderNode&) = nullptr;
  /// At each point it evaluates only one of its connected materials.
  bool one_material = false;
  /// False if constant parameters leave the result as the only output. Null: it has all.
  bool (*has_outputs)(const ShaderNode&) = nullptr;
  /// Bit mask of the densities of its interpolation grids. Null: none.
  unsigned (*grids)(const ShaderNode&) = nullptr;
};

/// Evaluates lights.
struct LightRole {
  /// Colour of one light sample.
  LightValue (*evaluate)(const Call&, const LightCall&) = nullptr;
  /// Built once for each light that uses the shader.
  std::unique_ptr<ShaderState> (*prepare)(const void* params, const Light&) = nullptr;
  /// The profile of the light's distribution, without its intensity, by constant parameters; null =
  /// none. The light's own element may name one: light.profile_placement.
  const photometry::LightProfile* (*profile)(const void* params, const Light& light) = nullptr;
  /// For lights in windows (runtime/portal.h), instead of `evaluate`. False: the portal is off.
  bool (*portal)(const void* params, PortalTraits&) = nullptr;
  /// Half-angle (radians) of the cone of directions of a directional light; 0 = parallel.
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
  /// Passes the numeric parameters of an exposure to `set`, for the metadata of files.
  void (*settings)(const ShaderNode&,
                   const std::function<void(const char* name, float value)>& set) = nullptr;
  /// Refracts a camera ray through a lens; u is uniform in [0,1)^2. Returns the weight of
  /// the radiance along the ray.
  Rgb (*bend_ray)(const Call&, const Camera&, const Vec2& u, Camera::Ray&) = nullptr;
  /// Number of rays that replace each camera ray, by constant parameters; 0 = the lens is off.
  int (*ray_count)(const ShaderNode&) = nullptr;
  /// Returns the colour of a camera ray, from any number of rays that it traces.
  Rgba (*trace)(const Call&, LensNext&) = nullptr;
};

/// Scatters or emits photons.
struct PhotonRole {
  /// In a material's slot `photon`: scatters a photon of that energy.
  void (*scatter)(const Call&, const Rgb& energy, PhotonNext&) = nullptr;
  /// In a light's list `emitter`: emits one photon.
  void (*emit)(const Call&, const Light&, PhotonEmission&) = nullptr;
};

/// Acts as a volume.
struct VolumeRole {
  /// Between call.point's ray origin and the surface at its ray_length. Rays of kind Light end at
  /// the lit point and begin at the light, or infinitely far away: only `transmittance` counts.
  /// Rays of photons are passed in the direction of eye rays; `added` is ignored for them.
  VolumeValue (*evaluate)(const Call&) = nullptr;
  /// Whether it is evaluated for rays of kind Light, by constant parameters. Null: no.
  bool (*dims_light)(const ShaderNode&) = nullptr;
  /// It also acts on rays that hit nothing, whose ray_length is infinite.
  bool acts_on_endless_rays = false;
};

/// Binding and cost of a call.
struct BindingTraits {
  /// Built once from the constant parameters.
  std::unique_ptr<ShaderState> (*prepare)(const void* params, const World&) = nullptr;
  /// Built once per call, from its node and constant parameters, without a point. For shaders with
  /// state per call.
  std::unique_ptr<ShaderState> (*prepare_call)(const Call&, const World&) = nullptr;
  /// It evaluates connected parameters itself (ShaderNode::connections).
  bool deferred = false;
  /// Number of evaluations of its inputs per evaluation.
  float evaluations = 1;
};

/// A shader of another program, implemented from its public description:
/// runtime/binder_fallbacks.cpp.
struct FallbackTraits {
  bool is_fallback = false;
  /// Other names of the shader, separated by spaces.
  const char* aliases = "";
  /// It returns its material input unchanged. A connection to a material binds to that input,
  /// regardless of the parameter's name.
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
  /// Called before and after a camera sample, as one of the options' `state` shaders.
  void (*around_sample)(const Call&, EyeSample&) = nullptr;
  /// Processes the finished picture.
  void (*output)(const Call&, OutputPicture&) = nullptr;

  BindingTraits binding{};
  FallbackTraits fallback{};
};

/// Whether two names are equal, ignoring the case of ASCII letters.
bool same_but_for_case(std::string_view a, std::string_view b);

/// The built-in shaders by name; an explicit list without static registration.
class Registry {
 public:
  explicit Registry(std::vector<const ShaderSpec*> specs) : specs_(std::move(specs)) {}
  /// Names of fallback shaders are case-insensitive. `adskMayaX`, as written by Maya 2012 to 2017,
  /// equals `maya_x`.
  const ShaderSpec* find(std::string_view name) const;
  const std::vector<const ShaderSpec*>& all() const { return specs_; }
  void add(const ShaderSpec* spec) { specs_.push_back(spec); }

 private:
  std::vector<const ShaderSpec*> specs_;
};

}  // namespace oriel
