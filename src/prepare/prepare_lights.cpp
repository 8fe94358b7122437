// SPDX-License-Identifier: Apache-2.0
// Lights and camera: converts elements and instances to world space.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "geom/motion.h"
#include "prepare/object_light.h"
#include "prepare/prepare_parts.h"
#include "scene/element_settings.h"

namespace oriel {
namespace {

using scene::Statement;

/// Default film size of a camera: a 50 mm lens on 36 mm film, as most exporters assume.
constexpr float kDefaultFocal = 50, kDefaultAperture = 36;

/// All numbers of a statement, regardless of their grouping.
std::vector<float> numbers_of(const Statement& s) {
  std::vector<float> all;
  for (const scene::Value& v : s.values) all.insert(all.end(), v.numbers.begin(), v.numbers.end());
  return all;
}

/// Length scale of a transform: the cube root of its volume factor.
float scale_of(const Mat4& m) {
  const Vec3 x = transform_vector(Vec3(1, 0, 0), m), y = transform_vector(Vec3(0, 1, 0), m),
             z = transform_vector(Vec3(0, 0, 1), m);
  return math::cbrt(std::abs(dot(cross(x, y), z)));
}

void place_area(const scene::Light& element, const Mat4& to_world,
                const std::vector<scene::Leaf>& leaves, Light& light, Diagnostics& diagnostics) {
  const Statement& area = *element.area;
  const std::vector<float> n = numbers_of(area);
  const auto vec = [&](std::size_t i) {
    return transform_vector(Vec3(n[i], n[i + 1], n[i + 2]), to_world);
  };
  if (area.keyword == "rectangle" && n.size() >= 6) {
    light.shape = LightShape::Rectangle;
    light.edge_u = vec(0);
    light.edge_v = vec(3);
    light.axes = {light.edge_u, light.edge_v};
    const Vec3 normal = cross(light.edge_u, light.edge_v);
    light.area = length(normal);
    const Vec3 unit = normalize(normal);
    // Emission is on the side of the direction if the light has one.
    light.direction = light.has_direction && dot(unit, light.direction) < 0 ? -unit : unit;
  } else if (area.keyword == "disc" && n.size() >= 4) {
    light.shape = LightShape::Disc;
    light.radius = n[3] * scale_of(to_world);
    light.direction = normalize(vec(0));
    const Frame frame(light.direction);
    light.edge_u = frame.s;
    light.edge_v = frame.t;
    light.area = kPi * sqr(light.radius);
  } else if (area.keyword == "sphere" && !n.empty()) {
    light.shape = LightShape::Sphere;
    light.radius = n[0] * scale_of(to_world);
    light.area = kPi * sqr(light.radius);
  } else if (area.keyword == "cylinder" && n.size() >= 4) {
    light.shape = LightShape::Cylinder;
    light.edge_u = vec(0);
    light.radius = n[3] * scale_of(to_world);
    // Area whose constant radiance gives the flux of a point light of the same colour.
    light.area = kPi * light.radius * length(light.edge_u);
  } else if (area.keyword == "object") {
    const std::string name = area.values.empty() ? std::string() : area.values[0].text;
    const auto lies_there = [&](const scene::Leaf& leaf) {
      return leaf.object() &&
             std::any_of(leaf.chain.begin(), leaf.chain.end(),
                         [&](const scene::Instance* i) { return i->name == name; });
    };
    const auto leaf = std::find_if(leaves.begin(), leaves.end(), lies_there);
    if (leaf != leaves.end() && place_on_object(*leaf->object(), leaf->local_to_world, light))
      return;
    diagnostics.warning("OR-RN-021", element.where,
                        fmt::format("area light \"{}\" names \"{}\", which is not an instance of "
                                    "an object with polygons; it is rendered as a point light",
                                    element.name, name));
    return;
  } else if (area.keyword == "user") {
    light.placed_by_shader = true;
    return;
  } else {
    return;
  }
  if (!(light.area > 0)) {
    diagnostics.warning(
        "OR-RN-022", element.where,
        fmt::format("area light \"{}\" has no area; rendered as a point light", element.name));
    light.shape = LightShape::Point;
  }
}

LightPhotons photons_of(const scene::LightSettings& settings) {
  LightPhotons photons;
  photons.global = {settings.globillum.store, settings.globillum.emit};
  photons.caustic = {settings.caustic.store, settings.caustic.emit};
  photons.only = settings.photons_only;
  photons.has_energy = settings.energy.has_value();
  photons.none = settings.energy && !(max_component(*settings.energy) > 0);
  if (photons.has_energy && !photons.none) photons.emission.energy = settings.energy;
  return photons;
}

Light place_light(const scene::Leaf& leaf, const std::vector<scene::Leaf>& leaves,
                  Diagnostics& diagnostics) {
  const scene::Light& element = *leaf.light();
  Light light;
  light.name = leaf.instance().name;
  light.where = leaf.light()->where;
  light.to_local = leaf.world_to_local;
  light.to_world = leaf.local_to_world;
  light.position = transform_point(element.origin.value_or(Vec3(0)), light.to_world);
  light.has_direction = element.direction.has_value();
  const Vec3 direction =
      transform_vector(element.direction.value_or(Vec3(0, 0, -1)), light.to_world);
  light.direction = normalize(direction);
  const scene::LightSettings settings = settings_of(element);
  light.exponent = settings.exponent;
  light.visible = settings.visible || settings_of(leaf.instance()).visible_light;
  const bool infinite = element.direction && (!element.origin || !element.spread);
  light.photons = photons_of(settings);
  if (element.spread && !infinite) light.spread = *element.spread;
  if (infinite && !element.area)
    light.shape = LightShape::Directional;
  else if (element.area && !(infinite && !element.origin))
    place_area(element, light.to_world, leaves, light, diagnostics);
  else if (infinite)
    light.shape = LightShape::Directional;
  return light;
}

/// Orients a rectangle's front to its own +z, or to -z.
void place_portal(const scene::Light& element, Light& light, Diagnostics& diagnostics) {
  if (light.shape != LightShape::Rectangle) {
    diagnostics.warning(
        "OR-RN-023", element.where,
        fmt::format("portal light \"{}\" is not a rectangle and gives no light", element.name));
    light.portal.reset();
    return;
  }
  const Vec3 z = transform_vector(Vec3(0, 0, light.portal->reverse ? -1.0f : 1.0f), light.to_world);
  const Vec3 normal = normalize(cross(light.edge_u, light.edge_v));
  light.direction = dot(normal, z) < 0 ? -normal : normal;
}

/// The emitter shader of a light, from its list `emitter`, after applying its photon settings.
/// Shaders that precompute data per light are used as the light's shader only.
const ShaderNode* emitter_of(const scene::Light& element, const Light& light, Binder& binder) {
  if (element.emitters.empty() || light.portal || light.profile_placement) return nullptr;
  const NodeList nodes = binder.bind(element.emitters);
  if (nodes.empty()) return nullptr;
  const ShaderSpec& spec = nodes.back()->spec();
  const bool tells =
      (spec.light.evaluate && !spec.light.prepare && !spec.light.profile) || spec.value;
  return spec.photon.emit || (tells && (spec.apply & kApplyEmitter)) ? nodes.back() : nullptr;
}

}  // namespace

LightNames place_lights(const std::vector<scene::Leaf>& leaves, World& world,
                        Diagnostics& diagnostics) {
  LightNames names;
  for (const scene::Leaf& leaf : leaves) {
    if (leaf.kind != scene::LeafKind::Light || leaf.flags.hidden) continue;
    const int index = static_cast<int>(world.lights.size());
    world.lights.push_back(place_light(leaf, leaves, diagnostics));
    // Matrices from the written placement to the actual one.
    for (const Mat4& to_world : scene::motion_path(leaf, world.shutter))
      world.lights.back().path.emplace_back(Imath::M44d(leaf.world_to_local) *
                                            Imath::M44d(to_world));
    const LightShape shape = world.lights.back().shape;
    world.has_area_lights |= shape != LightShape::Point && shape != LightShape::Directional;
    for (const scene::Instance* instance : leaf.chain) {
      names[instance->name].push_back(index);
      if (instance != leaf.chain.back()) names[instance->element].push_back(index);
    }
  }
  return names;
}

void bind_lights(const std::vector<scene::Leaf>& leaves, Binder& binder, World& world,
                 Diagnostics& diagnostics) {
  std::size_t index = 0;
  for (const scene::Leaf& leaf : leaves) {
    if (leaf.kind != scene::LeafKind::Light || leaf.flags.hidden) continue;
    Light& light = world.lights[index++];
    const NodeList nodes = binder.bind(leaf.light()->shaders);
    if (nodes.empty()) {
      diagnostics.warning(
          "OR-RN-020", leaf.light()->where,
          fmt::format("light \"{}\" has no shader and gives no light", leaf.light()->name));
      continue;
    }
    light.shader = nodes.back();
    const ShaderSpec& spec = light.shader->spec();
    const auto profile = settings_of(*leaf.light()).profile;
    light.profile_placement =
        place_profile(profile ? binder.light_profile(profile->name, profile->where) : nullptr,
                      light.to_world, light.direction);
    if (light.placed_by_shader && spec.library != std::string_view("user"))
      diagnostics.warning("OR-RN-021", leaf.light()->where,
                          fmt::format("area light \"{}\" of kind user is rendered as a point "
                                      "light: {} does not choose the points of its samples",
                                      leaf.light()->name, spec.name));
    if (spec.light.cone && spec.light.prepare && light.shape != LightShape::Directional)
      diagnostics.warning(
          "OR-RN-024", leaf.light()->where,
          fmt::format("{} works on directional lights only; light \"{}\" gives none", spec.name,
                      leaf.light()->name),
          "give it a direction and no origin");
    // Connected parameters are evaluated as those of a sky: toward the light.
    ShadingPoint toward(binder.constant_point());
    if (light.shape == LightShape::Directional) toward.ray_direction = -light.direction;
    toward.environment = light.shape == LightShape::Directional;
    light.shader->with_params(toward, [&](const Call& call) {
      light.profile_placement.profile =
          spec.light.profile ? spec.light.profile(call.params, light) : nullptr;
      if (spec.light.cone && light.shape == LightShape::Directional)
        light.cone_angle = std::min(spec.light.cone(call.params), kPi / 2);
      if (spec.light.portal) {
        light.portal = std::make_unique<Portal>();
        if (spec.light.portal(call.params, *light.portal))
          place_portal(*leaf.light(), light, diagnostics);
        else
          light.portal.reset();
        // The sky is visible there in any case; a highlight would be added to it.
        light.visible = light.portal != nullptr;
        // The energy of a portal's photons is that of the environment behind it.
        light.photons.has_energy = true;
        light.photons.none |= !light.portal;
      }
      if (spec.light.prepare) light.state = spec.light.prepare(call.params, light);
      if (spec.light.photons) spec.light.photons(call.params, light, light.photons);
    });
    light.emitter = emitter_of(*leaf.light(), light, binder);
  }
}

namespace {

/// Film settings of the element: size, window, planes.
void set_film(const scene::Camera& element, const PrepareOptions& options, Camera& camera,
              Diagnostics& diagnostics) {
  camera.orthographic = element.orthographic;
  camera.focal = element.focal.value_or(kDefaultFocal);
  camera.aperture = element.aperture.value_or(kDefaultAperture);
  auto resolution = element.resolution.value_or(std::array<int, 2>{640, 480});
  for (int& side : resolution) side = std::max(1, side);
  camera.aspect = element.aspect.value_or(static_cast<float>(resolution[0]) /
                                          static_cast<float>(resolution[1]));
  constexpr int kMaxPixels = 1 << 16;
  camera.width = std::clamp(options.width > 0 ? options.width : resolution[0], 1, kMaxPixels);
  camera.height = std::clamp(options.height > 0 ? options.height : resolution[1], 1, kMaxPixels);
  if (options.width > 0 && options.height > 0 && element.resolution)
    camera.aspect *= static_cast<float>(camera.width) / static_cast<float>(camera.height) *
                     static_cast<float>(resolution[1]) / static_cast<float>(resolution[0]);
  // Squares of larger values would overflow.
  constexpr float kLargest = 1e15f;
  const auto is_length = [](float x) { return x > 0 && x < kLargest; };
  if (!is_length(camera.focal) || !is_length(camera.aperture) || !is_length(camera.aspect)) {
    diagnostics.warning("OR-RN-003", element.where,
                        fmt::format("camera \"{}\" has a focal length, aperture or aspect that is "
                                    "not positive, or beyond all measure; defaults are used",
                                    element.name));
    camera.focal = kDefaultFocal;
    camera.aperture = kDefaultAperture;
    camera.aspect = static_cast<float>(camera.width) / static_cast<float>(camera.height);
  }
  const scene::CameraSettings settings = settings_of(element);
  const float size_ratio = static_cast<float>(camera.width) / static_cast<float>(resolution[0]);
  camera.offset = settings.offset * size_ratio;
  take_eye(settings, options.eye, camera);
  constexpr float kFarthest = 1e6f;  // pixels; larger offsets would make rays infinite
  for (float* shift : {&camera.offset.x, &camera.offset.y})
    *shift = std::abs(*shift) < kFarthest ? *shift : 0;
  camera.clip_near = settings.clip_near;
  camera.clip_far = settings.clip_far;
  camera.window[2] = camera.width;
  camera.window[3] = camera.height;
  if (settings.window) {
    const std::array<float, 4>& w = *settings.window;
    const int most[] = {camera.width, camera.height};
    // Clipped before conversion to an integer, since files may contain any number.
    const auto pixel = [&](float x, int least, int last) {
      return static_cast<int>(
          clamp(x * size_ratio, static_cast<float>(least), static_cast<float>(last)));
    };
    for (std::size_t i = 0; i < 2; ++i) {
      camera.window[i] = pixel(w[i], 0, most[i] - 1);
      camera.window[i + 2] = pixel(w[i + 2] + 1, camera.window[i] + 1, most[i]);
    }
  }
}

}  // namespace

bool place_camera(const scene::Scene& scene, const std::vector<scene::Leaf>& leaves,
                  const std::string& name, const PrepareOptions& options, World& world,
                  const scene::Camera*& element, Diagnostics& diagnostics) {
  Camera& camera = world.camera;
  for (const scene::Leaf& leaf : leaves) {
    if (leaf.kind != scene::LeafKind::Camera) continue;
    if (leaf.instance().name != name && leaf.camera()->name != name) continue;
    element = leaf.camera();
    camera.to_world = leaf.local_to_world;
    camera.to_camera = leaf.world_to_local;
    camera.path = scene::motion_path(leaf, world.shutter);
  }
  if (!element) {
    // A camera outside of the rendered group is placed by its own instance only.
    const auto* instance = scene.get<scene::Instance>(name);
    element = scene.get<scene::Camera>(instance ? instance->element : name);
    if (instance && instance->transform) {
      camera.to_camera = *instance->transform;
      camera.to_world = instance->transform->inverse();
    }
    if (instance) camera.path = scene::motion_path(*instance, world.shutter);
  }
  if (!element) {
    std::vector<std::string> names;
    for (const scene::Leaf& leaf : leaves)
      if (leaf.kind == scene::LeafKind::Camera) names.push_back(leaf.instance().name);
    const std::string near = did_you_mean(name, names);
    diagnostics.error("OR-RN-001", {}, fmt::format("there is no camera \"{}\"", name),
                      names.empty() ? "the rendered group contains no camera instance"
                      : near.empty()
                          ? fmt::format("cameras: {}", fmt::join(names, ", "))
                          : fmt::format("{} (cameras: {})", near, fmt::join(names, ", ")));
    return false;
  }
  camera.middle = world.shutter.middle();
  if (!camera.path.empty()) {
    camera.to_world = geom::matrix_at(camera.path, camera.middle);
    camera.to_camera = geom::inverse_of(camera.to_world);
  }
  set_film(*element, options, camera, diagnostics);
  return true;
}

}  // namespace oriel
