// SPDX-License-Identifier: Apache-2.0
#include "models/daylight.h"

#include <ImathBox.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/math.h"
#include "models/import.h"
#include "models/import_material.h"
#include "models/shader_call.h"
#include "scene/hierarchy.h"

namespace oriel::models {
namespace {

using Box3 = Imath::Box3f;

constexpr float kFocal = 50, kAperture = 36;  // millimetres
/// Distance factor that leaves a margin around the model; chosen by eye.
constexpr float kMargin = 1.08f;
/// Direction from the model to the camera.
const Vec3 kFromModel(.6f, .45f, 1);
/// Half the side of the ground, in radii of the model.
constexpr float kGround = 60;
/// Converts W/(m2 sr) to cd/m2 over pi, the unit of the sun and sky shaders.
constexpr float kUnit = .318f;

/// All vertices in world space; the corners of a unit cube if there are none.
std::vector<Vec3> points_of(const scene::Scene& scene) {
  Diagnostics ignored;  // rendering reports them again
  std::vector<Vec3> points;
  for (const scene::Leaf& leaf : scene::flatten(scene, kRootGroup, ignored)) {
    if (leaf.kind != scene::LeafKind::Object) continue;
    for (const scene::PolygonGroup& group : leaf.object()->groups)
      for (const std::uint32_t index : group.vertices.point)
        if (index < group.vectors.size())
          points.push_back(transform_point(group.vectors[index], leaf.local_to_world));
  }
  if (points.empty())
    for (int i = 0; i < 8; ++i)
      points.emplace_back((i & 1) - .5f, (i >> 1 & 1) - .5f, (i >> 2 & 1) - .5f);
  return points;
}

Box3 bounds_of(const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3& p : points) box.extendBy(p);
  return box;
}

/// Half the diagonal of the box, at least 1e-4.
float radius_of(const Box3& box) { return std::max(length(box.size()) / 2, 1e-4f); }

void put(scene::Scene& scene, scene::Instance instance) {
  scene.get<scene::InstanceGroup>(kRootGroup)->members.push_back(instance.name);
  scene.add(std::move(instance));
}

/// Position of a camera with these axes, looking along -z, from which all points just fit the
/// frame.
Vec3 place_for(const std::vector<Vec3>& points, const Vec3& x, const Vec3& y, const Vec3& z,
               float aspect) {
  const float wide = kAperture / 2 / kFocal, high = wide / aspect;
  Vec3 centre = bounds_of(points).center();
  const float near = radius_of(bounds_of(points)) * 1e-3f;
  // The centre of the projection depends on the distance and vice versa, so iterate.
  constexpr int kRounds = 4;
  for (int round = 0;; ++round) {
    float distance = near;
    for (const Vec3& p : points) {
      const Vec3 from = p - centre;
      const float across = std::max(std::fabs(dot(from, x)) / wide, std::fabs(dot(from, y)) / high);
      distance = std::max(distance, kMargin * across + dot(from, z));
    }
    if (round == kRounds) return centre + z * distance;
    Imath::Box2f seen;
    for (const Vec3& p : points) {
      const Vec3 from = p - centre;
      const float depth = std::max(distance - dot(from, z), near);
      seen.extendBy(Vec2(dot(from, x), dot(from, y)) / depth);
    }
    centre += (x * seen.center().x + y * seen.center().y) * distance;
  }
}

scene::Camera* rendering_camera(scene::Scene& scene) {
  const auto* placed = scene.get<scene::Instance>(scene.renders.back().camera);
  return scene.get<scene::Camera>(placed->element);
}

scene::ShaderList reference(const std::string& name) {
  scene::ShaderUse use;
  use.reference = name;
  return {use};
}

/// Inputs:  eye: position of the rendering camera; the ground is also below it.
void add_ground(scene::Scene& scene, const Box3& box, const Vec3& eye) {
  const float size = radius_of(box), r = kGround * size;
  const Vec3 c = box.center();
  scene::Material material;
  material.name = unique_name(scene, "ground_material");
  ShaderCall call("mia_material_x");
  call.set("diffuse", Vec3(.35f)).set("diffuse_weight", 1.0f).set("reflectivity", 0.0f);
  material.shaders = {call.use()};
  scene::Object object;
  object.name = unique_name(scene, "ground");
  for (const char* flag : {"visible", "shadow", "trace"})
    object.flags.push_back({flag, false, {}, {}});
  scene::PolygonGroup group;
  // Slightly below the model, so that the ground is not coplanar with a floor of the model.
  constexpr float kBelow = 1e-3f;
  constexpr float kEyeHeight = .1f;
  const float lowest = eye.y < box.min.y ? eye.y - kEyeHeight * size : box.min.y;
  const float y = lowest - kBelow * size;
  group.vectors = {Vec3(c.x - r, y, c.z + r), Vec3(c.x + r, y, c.z + r), Vec3(c.x + r, y, c.z - r),
                   Vec3(c.x - r, y, c.z - r)};
  group.vertices.point = {0, 1, 2, 3};
  group.polygons.indices = {0, 1, 2, 3};
  group.polygons.first = {0, 4};
  object.groups.push_back(std::move(group));
  scene::Instance instance;
  instance.name = object.name + "_inst";
  instance.element = object.name;
  instance.materials = {material.name};
  scene.add(std::move(material));
  scene.add(std::move(object));
  put(scene, std::move(instance));
}

}  // namespace

void add_camera(scene::Scene& scene, const DaylightOptions& options) {
  const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
  const Vec3 z = normalize(kFromModel), x = normalize(cross(Vec3(0, 1, 0), z)), y = cross(z, x);
  const Vec3 p = place_for(points_of(scene), x, y, z, aspect);
  scene::Camera camera;
  camera.name = unique_name(scene, "camera");
  camera.focal = kFocal;
  camera.aperture = kAperture;
  camera.aspect = aspect;
  camera.resolution = {{options.width, options.height}};
  scene::Instance instance;
  instance.name = unique_name(scene, camera.name + "_inst");
  instance.element = camera.name;
  instance.transform =
      Mat4(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, p.x, p.y, p.z, 1).inverse();
  scene.renders = {{kRootGroup, instance.name, kOptions, {}}};
  scene.add(std::move(camera));
  put(scene, std::move(instance));
}

void set_picture_size(scene::Scene& scene, int width, int height) {
  scene::Camera* camera = rendering_camera(scene);
  camera->resolution = {{width, height}};
  camera->aspect = static_cast<float>(width) / static_cast<float>(height);
}

void add_exposure(scene::Scene& scene, float f_number, float shutter) {
  // The gamma of the options is applied when pictures are written.
  ShaderCall photographic("mia_exposure_photographic");
  photographic.set("cm2_factor", 1.0f).set("film_iso", 100.0f).set("camera_shutter", shutter);
  photographic.set("f_number", f_number).set("vignetting", 0.0f).set("burn_highlights", .3f);
  photographic.set("crush_blacks", .15f).set("gamma", 1.0f);
  const scene::ShaderList before = rendering_camera(scene)->lens;
  for (const scene::ShaderUse& use : before) scene.remove(use.reference);
  const std::string exposure = add_shader(scene, "exposure", photographic);
  rendering_camera(scene)->lens = reference(exposure);
}

void add_sky(scene::Scene& scene, const std::string& picture, float rotation) {
  const auto* placed = scene.get<scene::Instance>(scene.renders.back().camera);
  const Vec3 eye = placed->transform.value_or(Mat4()).inverse().translation();
  add_ground(scene, bounds_of(points_of(scene)), eye);
  scene::Texture texture;
  texture.name = unique_name(scene, "sky_picture");
  texture.file = std::filesystem::absolute(picture).string();
  ShaderCall lookup("mib_lookup_spherical");
  lookup.set("rotate", rotation * kPi / 180).set("tex", texture.name.c_str());
  scene.add(std::move(texture));
  const std::string sky = add_shader(scene, "sky", lookup);
  rendering_camera(scene)->environment = reference(sky);
}

void add_daylight(scene::Scene& scene, const DaylightOptions& options) {
  const auto* placed = scene.get<scene::Instance>(scene.renders.back().camera);
  const Vec3 eye = placed->transform.value_or(Mat4()).inverse().translation();
  add_ground(scene, bounds_of(points_of(scene)), eye);
  const float azimuth = options.sun_azimuth * kPi / 180, up = options.sun_elevation * kPi / 180;
  const Vec3 to_sun(math::cos(up) * math::sin(azimuth), math::sin(up),
                    -math::cos(up) * math::cos(azimuth));
  scene::Light sun;
  sun.name = unique_name(scene, "sun");
  ShaderCall sunlight("mia_physicalsun");
  sunlight.set("rgb_unit_conversion", Vec3(kUnit)).set("samples", 8).set("y_is_up", true);
  sun.shaders = {sunlight.use()};
  sun.direction = -to_sun;
  scene::Instance instance;
  instance.name = unique_name(scene, sun.name + "_inst");
  instance.element = sun.name;

  ShaderCall skylight("mia_physicalsky");
  skylight.set("rgb_unit_conversion", Vec3(kUnit)).set("ground_color", Vec3(.35f));
  skylight.set("y_is_up", true).set("sun_direction", to_sun).set("sun", instance.name.c_str());

  scene.add(std::move(sun));
  put(scene, std::move(instance));
  const std::string sky = add_shader(scene, "sky", skylight);
  rendering_camera(scene)->environment = reference(sky);
  add_exposure(scene, kSunnyFNumber, kSunnyShutter);
}

}  // namespace oriel::models
