// SPDX-License-Identifier: Apache-2.0
// The scene made ready for rendering: geometry, bound shaders, lights, camera. Read-only
// afterwards.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

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

/// What an instance does with rays and photons beside being met by them; bits.
enum VisibilityFlags : std::uint16_t {
  kSendsReflections = 1u << 0,
  kSendsRefractions = 1u << 1,
  kSendsTransparency = 1u << 2,
  kSendsGatherRays = 1u << 3,  ///< diffuse bounces and light of the environment as well
  kMeetsCaustics = 1u << 4,    ///< photons for the caustic map; without it they pass
  kCastsCaustics = 1u << 5,    ///< and are scattered on
  kReceivesCaustics = 1u << 6,
  kMeetsGlobillum = 1u << 7,
  kCastsGlobillum = 1u << 8,
  kReceivesGlobillum = 1u << 9,
  kAllVisibility = (1u << 10) - 1
};
/// The bits of one kind of photon, moved to those of caustics.
inline unsigned photon_bits(unsigned visibility, bool caustic) {
  return (caustic ? visibility : visibility >> 3) &
         (kMeetsCaustics | kCastsCaustics | kReceivesCaustics);
}

/// One leaf of the instance graph that holds geometry.
struct InstanceData {
  std::string name;
  Mat4 to_object, to_world;    ///< as written; of what moves accel tells the rest
  std::vector<int> materials;  ///< per material slot of its mesh, index into World::materials
  /// Lights linked to the instance: indices into World::lights; used when `linked`.
  std::vector<int> lights;
  bool linked = false;
  bool lights_exclusive = false;
  bool receives_shadow = true;
  std::uint16_t visibility = kAllVisibility;  ///< see Takes
};

/// A frame buffer that shaders write to (`frame buffer N "type"`, `framebuffer` of the camera).
struct UserBuffer {
  int number = 0;
  std::string name;  ///< empty for those that have a number alone
  enum class Kind : std::uint8_t { Color, Scalar, Vector } kind = Kind::Color;
  bool interpolate = true;  ///< the mean over the pixel, else its first sample
};
/// Numbers of buffers with a name count from here.
inline constexpr int kFirstNamedBuffer = 4096;

struct World {
  /// Tables of the environment have few texels: its shaders are called, so that they can report
  /// problems, but only some thousand times. Such a world is not for rendering.
  bool coarse_tables = false;
  std::vector<UserBuffer> user_buffers;  ///< none where no bound shader could write them
  scene::RenderOptions options;
  scene::Shutter shutter;
  Camera camera;
  std::unique_ptr<geom::Accel> accel;
  std::vector<InstanceData> instances;
  std::vector<Material> materials;
  std::vector<Light> lights;
  LightLayers light_layers;         ///< AOVs per group of lights
  bool has_tinted_portals = false;  ///< some portal dims what is seen through it
  bool has_area_lights = false;     ///< some light has a shape that rays can meet
  NodeList environment;             ///< shaders of the camera's environment
  /// Samples the lights, the environment and emissive triangles (lights/light_sampler.h).
  std::shared_ptr<const LightSampler> light_sampler;
  /// sample_light of lights/sample_light.h, for shaders that sample a light without a tracer.
  std::optional<LightSample> (*sample_light)(const Light&, ShadingPoint&, Vec2 u,
                                             RayKind) = nullptr;
  NodeList lens;           ///< colour-mapping lens shaders, in the order in which they map
  NodeList lens_rays;      ///< lens shaders that bend eye rays, in order
  NodeList state_shaders;  ///< called around eye samples
  const TextureNode* preview = nullptr;   ///< shown in place of a rendering; null = none
  NodeList camera_volume;                 ///< volume shaders of the camera: around all rays
  NodeList light_volume;                  ///< those of them that dim light on its way
  NodeList eye_volume;                    ///< those that stand as its lens: eye rays alone
  bool has_object_volumes = false;        ///< some material has volume shaders
  bool has_transparent_blockers = false;  ///< some material may let light pass
  std::uint32_t shadowless = 0;           ///< bits geom::RayMask::Shadowless* that instances have
  bool has_unseen_blockers = false;       ///< something opaque casts shadows on rays that miss it
  bool photons_part_ways = false;         ///< some instance treats caustic and global photons apart

  std::deque<std::unique_ptr<ShaderNode>> nodes;
  std::deque<std::unique_ptr<photometry::LightProfile>> light_profiles;
  TextureSystem texture_system;
  std::deque<std::unique_ptr<TextureNode>> textures;
  std::deque<std::string> strings;
  std::unordered_map<const void*, std::string> names;  ///< of bound shaders and textures
};

/// Way of what the point is on in one motion interval, world.
inline Vec3 motion_of(const ShadingPoint& point) {
  return point.world ? point.speed / static_cast<float>(point.world->shutter.last -
                                                        point.world->shutter.first)
                     : Vec3(0);
}

}  // namespace oriel
