// SPDX-License-Identifier: Apache-2.0
// The prepared scene: geometry, bound shaders, lights, camera. Read-only while rendering.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/scene_budgets.h"
#include "geom/accel.h"
#include "runtime/camera.h"
#include "runtime/environment.h"
#include "runtime/light.h"
#include "runtime/light_layers.h"
#include "runtime/material.h"
#include "runtime/shader_node.h"
#include "runtime/texture_node.h"
#include "scene/motion.h"
#include "scene/render_options.h"

namespace oriel {

class LightSampler;

/// Visibility of an instance to rays and photons, and which rays it sends; bits.
enum VisibilityFlags : std::uint16_t {
  kSendsReflections = 1u << 0,
  kSendsRefractions = 1u << 1,
  kSendsTransparency = 1u << 2,
  kSendsGatherRays = 1u << 3,  ///< also for light of the environment
  kMeetsCaustics = 1u << 4,    ///< for the caustic map; otherwise these photons pass
  kCastsCaustics = 1u << 5,    ///< scatters caustic photons
  kReceivesCaustics = 1u << 6,
  kMeetsGlobillum = 1u << 7,
  kCastsGlobillum = 1u << 8,
  kReceivesGlobillum = 1u << 9,
  kAllVisibility = (1u << 10) - 1
};
/// Moves the bits of global photons to those of caustic photons.
inline unsigned photon_bits(unsigned visibility, bool caustic) {
  return (caustic ? visibility : visibility >> 3) &
         (kMeetsCaustics | kCastsCaustics | kReceivesCaustics);
}

/// One leaf of the instance graph that holds geometry.
struct InstanceData {
  std::string name;
  Mat4 to_object, to_world;    ///< as written; for moving instances see accel
  std::vector<int> materials;  ///< index into World::materials for each material slot of the mesh
  /// Lights linked to the instance: indices into World::lights; used if `linked`.
  std::vector<int> lights;
  bool linked = false;
  bool lights_exclusive = false;
  bool receives_shadow = true;
  bool flat_pane = false;  ///< light passes straight; set for caustics of path-traced pictures only
  std::uint16_t visibility = kAllVisibility;  ///< VisibilityFlags
};

/// Parts of a world that are prepared one after the other, without geometry; bits.
enum PreparedPart : std::uint8_t {
  kPartLights = 1u << 0,
  kPartEnvironment = 1u << 1,
  kPartCameraShaders = 1u << 2,
  kPartSampler = 1u << 3,  ///< with openings, portals and light layers
};

/// A frame buffer that shaders write to (`frame buffer N "type"`, `framebuffer` of the camera).
struct UserBuffer {
  int number = 0;
  std::string name;  ///< empty for buffers with a number only
  enum class Kind : std::uint8_t { Color, Scalar, Vector } kind = Kind::Color;
  bool interpolate = true;  ///< the mean over the pixel, otherwise its first sample
};
/// First number of named buffers.
inline constexpr int kFirstNamedBuffer = 4096;

struct World {
  /// Environment tables are small: its shaders are called a few thousand times, so that they report
  /// problems. Such a world cannot be rendered.
  bool coarse_tables = false;
  /// PreparedPart bits: parts that reported messages, which would be listed twice if the part were
  /// prepared again.
  unsigned parts_with_messages = 0;
  /// Number of the textures that the environment and the lights before it use, which are the first.
  std::size_t environment_textures = SIZE_MAX;
  /// The sampler's tables of the environment are small, or its openings are those of another
  /// geometry or camera: see complete_light_sampler().
  bool draft_environment = false, draft_openings = false;
  std::vector<UserBuffer> user_buffers;  ///< empty if no bound shader can write them
  scene::RenderOptions options;
  scene::Shutter shutter;
  Camera camera;
  std::unique_ptr<geom::Accel> accel;
  std::vector<InstanceData> instances;
  std::vector<Material> materials;
  std::vector<Light> lights;
  /// Indices into `lights` by the names of light instances and of groups of them.
  std::unordered_map<std::string, std::vector<int>> light_names;
  LightLayers light_layers;         ///< AOVs per group of lights
  bool has_tinted_portals = false;  ///< some portal attenuates the view through it
  bool has_area_lights = false;     ///< some light has a shape that rays can hit
  NodeList environment;             ///< shaders of the camera's environment
  /// Samples the lights, the environment and emissive triangles (lights/light_sampler.h).
  std::shared_ptr<const LightSampler> light_sampler;
  /// sample_light of lights/sample_light.h, for shaders that sample a light without a tracer.
  std::optional<LightSample> (*sample_light)(const Light&, ShadingPoint&, Vec2 u,
                                             RayKind) = nullptr;
  NodeList lens;                         ///< colour-mapping lens shaders, in order of application
  NodeList lens_rays;                    ///< lens shaders that refract camera rays, in order
  NodeList state_shaders;                ///< called before and after camera samples
  const TextureNode* preview = nullptr;  ///< displayed instead of a rendering; null = none
  NodeList camera_volume;                ///< volume shaders of the camera, for all rays
  NodeList light_volume;                 ///< those of them that attenuate light
  /// volume shaders in the camera's lens list: camera rays only
  NodeList eye_volume;
  bool has_object_volumes = false;        ///< some material has volume shaders
  bool has_transparent_blockers = false;  ///< some material may let light pass
  /// bits of geom::RayMask::Shadowless* that instances have
  std::uint32_t shadowless = 0;
  /// some opaque instance is invisible to rays but casts shadows
  bool has_unseen_blockers = false;
  /// some instance treats caustic and global photons differently
  bool photons_part_ways = false;

  std::deque<std::unique_ptr<ShaderNode>> nodes;
  std::deque<std::unique_ptr<photometry::LightProfile>> light_profiles;
  TextureSystem texture_system;
  SceneBudgets budgets;
  std::deque<std::unique_ptr<TextureNode>> textures;
  std::deque<std::string> strings;
  std::unordered_map<const void*, std::string> names;  ///< of bound shaders and textures
};

/// Displacement of the point's surface over the motion interval, world.
inline Vec3 motion_of(const ShadingPoint& point) {
  return point.world ? point.speed / static_cast<float>(point.world->shutter.last -
                                                        point.world->shutter.first)
                     : Vec3(0);
}

}  // namespace oriel
