// SPDX-License-Identifier: Apache-2.0
// The state of a path that is being traced. Private to path*.cpp: the walk and surfaces in
// path.cpp, lights and environment in path_light.cpp, vertices and lobes in path_scatter.cpp,
// volumes in path_volume.cpp.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "runtime/tracer.h"
#include "transport/indirect_caches.h"
#include "transport/lobes.h"
#include "transport/path/direct.h"
#include "transport/path/path.h"
#include "transport/path/path_observer.h"
#include "transport/ray_walk.h"
#include "transport/shadow.h"

namespace oriel {

/// Cone spread after a diffuse bounce (radians). Large, since final gather rays need no texture
/// detail.
inline constexpr float kDiffuseSpread = 0.2f;
/// Number of diffuse and glossy vertices before Russian roulette.
inline constexpr int kRouletteDepth = 4;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

class Path;

/// Directional albedo of a diffuse or translucent lobe.
Rgb albedo_of(const Lobe& lobe, const Vec3& wo);

/// Handles surfaces in place of the estimate of their light: gather points, points of grids.
class SurfaceVisitor {
 public:
  virtual ~SurfaceVisitor() = default;
  /// Called at each surface that the ray does not pass straight. False: the path ends here.
  virtual bool on_surface(Path& path, Closure& closure, const Material& material,
                          ShadingPoint& point) = 0;
  /// Called where a shader evaluates irradiance. False: it is evaluated as without a visitor.
  virtual bool on_irradiance(const ShadingPoint& /*point*/, const Vec3& /*normal*/) {
    return false;
  }
  /// Whether rays that shaders trace are visited as well; otherwise they estimate light.
  virtual bool visits_rays_of_shaders() const { return false; }
};

/// One path, or one branch of it; a path that splits is copied. The structs below contain its
/// state. The functions are the steps of the integrator (walk, surfaces, media, lights, lobes,
/// caches). Each reads most of the state, so they are members, with one file per subject.
/// PathForShaders traces the rays of shaders; visitors use the steps for purposes other than light.
class Path {
  friend class PathForShaders;
  friend class GatherPointVisitor;
  friend class GridPointVisitor;

 public:
  Path(const World& world, Vec2 raster, const PathSettings& settings, PathRecord& record,
       sampling::Sampler& sampler, RayCounts& counts, SurfaceVisitor* visitor = nullptr)
      : world_(world),
        raster_(raster),
        settings_(settings),
        sampler_(sampler),
        counts_(counts),
        record_(&record),
        grid_(settings.grid),
        visitor_(visitor) {}

  void run(const Camera::Ray& eye);
  void gather_ray(const ShadingPoint& point, const Vec3& direction, float reach);
  /// Starts at the point, with a white Lambert surface seen along its normal instead of the actual
  /// material. `mapped`: indirect light comes from caches; otherwise it is traced.
  void receive(ShadingPoint& point, bool mapped);

 private:
  /// The vertex that the ray left, for the MIS weights of lights and environment that it hits.
  struct Vertex {
    bool weighed = false;  ///< a non-delta vertex that sampled lights
    /// Where lights were sampled, for lights with a shape that the ray hits; belongs to the caller
    /// of walk(), or to walk(). Null: nothing was sampled.
    ShadingPoint* point = nullptr;
    LitVertex lights;
    float pdf = 0;
    LobeGroup group = LobeGroup::Diffuse;
    LightInReflection invisible, visible, hidden_portal;  ///< how reflections show lights
    LightInReflection shown(const Light& light, const LightHit& hit) const {
      if (light.portal && !light.portal->visible) return hidden_portal;
      if (!light.visible) return invisible;
      if (!hit.force_specular) return visible;
      return {visible.as_reflection, invisible.as_highlight};
    }
    /// Factor of the light for this kind of lobe.
    float affected(const LightHit& hit) const {
      return group == LobeGroup::Diffuse ? hit.affects_diffuse : hit.affects_specular;
    }
    bool shadows = true;
    /// If the lobe is a mirror, glass or glossy: its instance, otherwise -1. See
    /// is_mapped_caustic().
    int caster = -1;
    CausticWay caster_way = kByMirror;
    // Surfaces were sampled as lights for diffuse lobes, and for glossy reflections.
    bool surfaces_on_diffuse = false, surfaces_in_reflections = false;
    /// Whether surfaces were sampled for the lobes of the ray.
    bool sampled_surfaces() const {
      if (!weighed) return false;
      return group == LobeGroup::Diffuse
                 ? surfaces_on_diffuse
                 : group == LobeGroup::Reflection && surfaces_in_reflections;
    }
    LitPoint lit;           ///< the point that emissive triangles were sampled for
    LightChances emitters;  ///< with which they were chosen
    float passed = 0;       ///< distance since then, through surfaces that did not bend the ray
  };
  /// The current ray, with its state since the last surface.
  struct RayWay : RayWalk {
    RayCone cone;
    bool blurred = false;
    float roughness = 0;  ///< of the part of a reflecting lobe that the ray represents
    const NodeList* environment = nullptr;  ///< of the last material; null = the scene's
    float volume_passed = 0;   ///< part of `from_.passed` that volumes have been applied to
    float reach = kInfinity;   ///< of a gather ray; beyond it only the environment is visible
    Medium veil;               ///< absorption behind a thin wall, up to the next surface
    bool to_far_side = false;  ///< only hits of back sides count: the far wall of the solid
  };
  /// The AOV of the first surface that light is recorded in. Light at that surface, and on the ray
  /// that leaves it, is recorded by its own kind; light behind it by the lobe that shows it.
  struct AovState {
    bool fixed = false;       ///< that surface has been hit
    bool at_surface = false;  ///< the path is at that surface
    bool leaving = false;     ///< the ray goes from it to the next surface
    Aov part = Aov::Other;
    LightPart at_vertex(Aov c) const { return {at_surface ? c : part, c}; }
    LightPart after_vertex(Aov c) const { return {leaving ? c : part, c}; }
    /// For light that does not come from a surface.
    LightPart on_way() const { return {part, part}; }
  };
  /// Values of the first surfaces that the record still lacks.
  struct EyeHit {
    Vec3 eye{0};
    bool pending = true;         ///< no surface has been hit yet
    bool features_seen = false;  ///< normal and albedo come from a surface that scatters
    bool alpha_open = false;     ///< alpha still depends on surfaces behind
    std::optional<Tracer::Met>* met = nullptr;  ///< receives the first surface, for a shader
  };
  struct PathDepth {
    int vertex = 0;
    int nested = 0;                        ///< number of shader paths that this one is nested in
    int reflections = 0, refractions = 0;  ///< since the last diffuse bounce
    int bounces = 0;                       ///< diffuse and glossy
    int diffuse_bounces = 0;
    bool after_diffuse = false;
    float importance = 1;  ///< product of lobe weights, not divided by probabilities
    Rgb expected{0};       ///< light of the diffuse bounces from the first guided vertex on
  };
  /// Factors of light that is found later.
  struct LightState {
    Rgb throughput{1};
    Rgb lights{1};            ///< the same for lights that the last vertex also sampled
    Rgb occlusion{1};         ///< of indirect light at this vertex
    Rgb near_dark{0};         ///< share of light lost from surfaces at distance 0
    float near_distance = 0;  ///< distance from which nothing is lost; 0 = not used
  };
  /// The last look-up of gathered light at this vertex. Reflections that are emulated by it look up
  /// the same point again.
  struct LookedUp {
    bool valid = false, directional = false;
    Vec3 position{0}, normal{0};
    std::optional<Gathered> found;
  };
  /// How a ray ends that its lobe limits.
  struct Fading {
    float distance = 0;  ///< 0 = not limited
    bool to_color = false;
    bool single_environment = false;
    bool of_grid = false;  ///< the colour comes from a grid of interpolated reflections
    Rgb color{0};
    Vec3 mirrored{0};                         ///< direction of the look-up for all rays of the lobe
    std::optional<Rgb>* looked_up = nullptr;  ///< result of that look-up, shared by the rays
    float kept(float t) const { return linear_fade(t, distance); }
  };

  // path.cpp
  void walk();
  bool shade_hit(const geom::Hit& hit, ShadingPoint& point);
  const Material& shade_surface(const geom::Hit& hit, ShadingPoint& point, Closure& closure);
  void record_first_hit(const Closure& closure, const ShadingPoint& point,
                        const Material& material);
  bool pass_straight(Closure& closure, const Material& material, ShadingPoint& point);
  bool pass_filter(Closure& closure, const Material& material, ShadingPoint& point);
  void dim(const Rgb& factor);
  std::uint32_t mask() const;
  void count_ray();
  void follow(const ShadingPoint& point, const Vec3& direction);
  void meet_first(const Closure& closure);
  void add(const LightPart& part, const Rgb& radiance, std::size_t layer) {
    record_->add(place_, part, layer, radiance);
  }
  /// The same for light that is split by light layers.
  void add(const LightPart& part, const Rgb& factor, const Rgb& light, const LightParts& parts) {
    record_->add(place_, part, factor, light, parts);
  }
  // Indices of light layers; arbitrary if layers were not requested.
  std::size_t layer_of_light(int light) const {
    return record_->has_layers() ? world_.light_layers.of_light[static_cast<std::size_t>(light)]
                                 : 0;
  }
  std::size_t layer_of_instance(int instance) const {
    return record_->has_layers()
               ? world_.light_layers.of_instance[static_cast<std::size_t>(instance)]
               : 0;
  }
  std::size_t layer_of_environment() const { return world_.light_layers.environment; }
  std::size_t layer_of_rest() const { return world_.light_layers.rest(); }
  // path_irradiance.cpp
  void sense_irradiance(const Closure& closure, const ShadingPoint& point);

  // path_volume.cpp
  bool pass_volume(const Vec3& end, float t);
  bool pass_volume_to_infinity();
  bool pass_volume(const NodeList& nodes, ShadingPoint& way, bool endless);

  // path_light.cpp
  /// What lights with a shape did to a ray: it ended at one, or was scattered before it.
  enum class AtLights { Passed, Ended, Scattered };
  AtLights meet_lights(float t_surface);
  AtLights end_at_light(int light, float t, const Rgb& radiance);
  void add_found(const LightInReflection& in, float kept, const Rgb& arriving, const Rgb& view,
                 std::size_t layer);
  bool ends_at(const Portal& portal) const;
  void meet_environment();
  void pass_to_background(float alpha);
  void darken_near(float t);
  void fade(float t);
  Rgb faded_to();
  std::size_t layer_of_faded() const;
  Rgb reflected_environment(const Vec3& direction);

  // path_emission.cpp
  /// A point of a surface that was sampled as a light.
  struct SurfaceTarget : TriangleSample {
    int light = -1;  ///< the directional light that it reflects; -1 = its emission
    Vec2 u_light{0};
  };
  void sample_surfaces(const Closure& closure, const LobeChoice& choice, const ShadingPoint& point,
                       bool on_diffuse, bool in_reflections);
  void sample_emission(const Closure& closure, const LobeChoice& choice, const ShadingPoint& point);
  void sample_lit(const Closure& closure, const LobeChoice& choice, const ShadingPoint& point);
  void connect(const Closure& closure, const LobeChoice& choice, const ShadingPoint& point,
               const SurfaceTarget& target, float u_group, std::size_t layer);
  Rgb seen_of(const SurfaceTarget& target, const Closure& closure, const ShadingPoint& point,
              RayKind kind);
  static float area_per_angle(float distance2, float cosine);
  BesideLitSurfaces beside_lit_surfaces(const ShadingPoint& point) const;
  float emission_weight(const geom::Hit& hit, const ShadingPoint& point) const;

  // path_scatter.cpp
  void choose_lobes(Closure& closure, LobeChoice& choice, const ShadingPoint& point,
                    bool diffuse) const;
  void guide(const Closure& closure, LobeChoice& choice, const ShadingPoint& point) const;
  bool split(const Closure& closure, LobeChoice& choice) const;
  void place_lit_vertex(const Closure& closure, const ShadingPoint& point);
  void take_direct(const Closure& closure, const LobeChoice& choice, ShadingPoint& point,
                   bool diffuse);
  void take_direct_of_layers(const Closure& closure, const LobeChoice& choice, ShadingPoint& point,
                             const DirectRequest& request);
  void add_direct(const Closure& closure, const DirectLight& light, std::size_t layer);
  void occlude(const Closure& closure, const ShadingPoint& point);
  EnvironmentChances environment_chances(const Material& material) const;
  int rays_at_first(float samples, float importance) const;
  bool continue_path(const Closure& closure, const LobeChoice& choice, const Material& material,
                     ShadingPoint& point, int lobe, float u_rest, bool weighed = true);
  void leave_diffusely(float indirect_scale, LobeKind kind);
  void scatter(const Closure& closure, const Material& material, ShadingPoint& point,
               const ClosureSample& sample);
  bool shade_vertex(Closure& closure, const Material& material, ShadingPoint& point);
  bool at_eye_surface() const {
    return depth_.reflections + depth_.refractions == 0 && !depth_.after_diffuse;
  }
  bool depth_reached(LobeKind kind) const;
  bool russian_roulette();
  bool end_with_expected(const Rgb& expected);

  bool allows(unsigned bits) const { return (visibility_ & bits) == bits; }
  /// Whether this vertex receives indirect light from surfaces and environment.
  bool indirect() const {
    return settings_.indirect && allows(kSendsGatherRays) &&
           depth_.diffuse_bounces < settings_.diffuse_bounces;
  }
  bool reads_maps() const { return settings_.maps && (depth_.after_diffuse || !off_maps_); }
  const IndirectCaches* maps_read_here() const { return reads_maps() ? settings_.maps : nullptr; }
  /// Whether the global photon map replaces diffuse rays here. It does not contain direct light of
  /// the sky.
  bool reads_photons() const {
    return reads_maps() && settings_.maps->global &&
           (depth_.after_diffuse || !settings_.maps->gather);
  }
  /// Whether coarse records contain exactly the remaining diffuse bounces.
  bool reads_bounces() const {
    if (!settings_.maps || !settings_.maps->bounces || !depth_.after_diffuse) return false;
    if (too_near_for_cache_) return false;
    const int held = settings_.maps->bounces_held;
    return held >= PathSettings::kAllBounces ||
           settings_.diffuse_bounces - depth_.diffuse_bounces == held;
  }
  /// Whether all light that reaches diffuse surfaces through mirrors and glass is in the caustic
  /// map. Rays that leave such a surface must then not add it again.
  bool caustics_are_mapped() const { return caustics_ && caustics_->caustic && !caustics_->sharp; }
  /// The same for light of one light along the current ray, if the map contains some caustics only.
  bool is_mapped_caustic(int light) const {
    return caustics_ && from_.caster >= 0 &&
           caustics_->have_sharp(light, from_.caster, from_.caster_way);
  }
  /// Factor of the options on indirect light that rays bring to this vertex.
  Rgb indirect_factor() const {
    if (depth_.after_diffuse) return settings_.further_bounces;
    return settings_.maps && settings_.maps->gather ? settings_.maps->gather_scale : Rgb(1);
  }
  /// The kind of ray for environment shaders. After a diffuse bounce all rays must see the same
  /// environment as the light samples.
  RayKind environment_kind(RayKind kind) const {
    return depth_.after_diffuse ? RayKind::FinalGather : kind;
  }
  // path_indirect.cpp
  std::optional<Rgb> mapped_irradiance(const ShadingPoint& point, const Vec3& normal,
                                       LightParts& parts) const;
  std::optional<Gathered> gathered(const ShadingPoint& point, const Vec3& normal, bool directional,
                                   Rgb* by_light) const;
  void emulate(const Closure& closure, const ShadingPoint& point);
  bool take_mapped(const Closure& closure, ShadingPoint& point);
  void take_caustics(const Closure& closure, ShadingPoint& point);
  void with_neighbours(const Closure& closure, const ShadingPoint& point, Rgb& smooth,
                       LightParts& parts);
  /// Transmittance of the current media over a distance.
  Rgb kept_over(float distance) const {
    const Rgb kept = transmittance(way_.medium.medium, distance);
    return way_.veil.clear() ? kept : kept * transmittance(way_.veil, distance);
  }
  static float mean_of(const Rgb& c) { return (c.x + c.y + c.z) / 3; }
  static Vec3 facing(const Vec3& n, const Vec3& side) { return dot(n, side) < 0 ? -n : n; }

  // path_grid.cpp
  void interpolate(Closure& closure, const Material& material, const ShadingPoint& point,
                   LobeChoice& choice);

  const World& world_;
  Vec2 raster_;
  const PathSettings& settings_;
  sampling::Sampler sampler_;
  RayCounts& counts_;
  PathRecord* record_;
  const GlossyGrid* grid_;   ///< null for rays of shaders
  SurfaceVisitor* visitor_;  ///< null = the path estimates light
  /// The maps that the last diffuse vertex has read caustics of, which its rays must not add again;
  /// null: none, as before the first one, and for points in volumes and light meters.
  const IndirectCaches* caustics_ = nullptr;

  PathObserver::Place place_ = PathObserver::kEye;
  RayWay way_;
  AovState aov_;
  EyeHit eye_hit_;
  PathDepth depth_;
  LightState light_;
  Vertex from_;
  mutable LookedUp looked_up_;
  Fading fading_;
  unsigned visibility_ = kAllVisibility;  ///< of the surface's instance
  bool too_near_for_cache_ = false;       ///< see IndirectCaches::retrace
  bool off_maps_ = false;                 ///< starts where maps contain no data
};

}  // namespace oriel
