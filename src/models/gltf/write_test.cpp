// SPDX-License-Identifier: Apache-2.0
// Scenes written as glTF and read back.
#include "models/gltf/write.h"

#include <fmt/format.h>

#include <cmath>

#include "models/testing/gltf_file.h"
#include "support/expect_near.h"

namespace oriel::models {
namespace gltf_write_test {

using oriel::testing::expect_near;
using testing::GltfFile;
using testing::json;
using testing::Made;

/// Two instances of a triangle, a camera, a point light, a spot and a sun.
GltfFile scene_file() {
  GltfFile file;
  file.add_triangle();
  file.node()["translation"] = {1, 2, 3};
  file.root["nodes"].push_back(
      {{"name", "other"}, {"mesh", 0}, {"scale", {2, 3, 4}}, {"rotation", {0, .6, 0, .8}}});
  file.root["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", .8}, {"aspectRatio", 1.7}}}}};
  file.root["nodes"].push_back(
      {{"name", "eye"}, {"camera", 0}, {"translation", {0, 1, 9}}, {"rotation", {.6, 0, 0, .8}}});
  file.root["extensionsUsed"] = {"KHR_lights_punctual"};
  file.root["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "point"}, {"intensity", 100}, {"color", {1, .5, .25}}},
                   {{"type", "spot"},
                    {"intensity", 30},
                    {"spot", {{"innerConeAngle", .3}, {"outerConeAngle", .6}}}},
                   {{"type", "directional"}, {"intensity", 5000}}});
  for (const int i : {0, 1, 2})
    file.root["nodes"].push_back({{"name", fmt::format("light{}", i)},
                                  {"translation", {i, 5, 0}},
                                  {"rotation", {-.6, 0, 0, .8}},
                                  {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  for (int node = 1; node < 6; ++node) file.root["scenes"][0]["nodes"].push_back(node);
  return file;
}

/// The scene after writing and reading.
void write_and_read(const Made& from, Made& to) {
  ASSERT_TRUE(from.scene);
  Diagnostics notes;
  const std::string bytes = gltf::write_glb(*from.scene, notes);
  EXPECT_EQ(bytes, gltf::write_glb(*from.scene, notes));
  EXPECT_EQ(bytes.size() % 4, 0u);
  to.import(bytes, "w.glb");
  ASSERT_TRUE(to.scene);
}

// acceptance: M5
TEST(GltfWrite, GeometryCamerasAndLightsRoundTrip) {
  Made from, to;
  from.import(scene_file().text());
  write_and_read(from, to);
  EXPECT_EQ(to.group().vectors, from.group().vectors);
  const std::vector<Vec3> points = testing::world_points(*to.scene),
                          wanted = testing::world_points(*from.scene);
  ASSERT_EQ(points.size(), wanted.size());
  for (std::size_t i = 0; i < points.size(); ++i) expect_near(points[i], wanted[i], 1e-6f);
  const auto lights = [](const scene::Scene& scene) {
    std::vector<std::vector<double>> all;
    Diagnostics ignored;
    for (const scene::Leaf& leaf : scene::flatten(scene, kRootGroup, ignored)) {
      const auto* light = leaf.light();
      if (!light) continue;
      const Vec3 p = transform_point(light->origin.value_or(Vec3(0)), leaf.local_to_world);
      const Vec3 d =
          light->direction ? transform_vector(*light->direction, leaf.local_to_world) : Vec3(0);
      std::vector<double> row = light->shaders[0].arguments[0].value.numbers;
      const bool infinite = light->shaders[0].type == "mib_light_infinite";
      for (const float x : {p.x, p.y, p.z}) row.push_back(infinite ? 0 : x);
      for (const float x : {d.x, d.y, d.z, light->spread.value_or(0)}) row.push_back(x);
      all.push_back(row);
    }
    return all;
  };
  const auto before = lights(*from.scene), after = lights(*to.scene);
  ASSERT_EQ(before.size(), 3u);
  ASSERT_EQ(after.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < before[i].size(); ++k)
      EXPECT_NEAR(after[i][k], before[i][k], 1e-4 * std::max(1., std::fabs(before[i][k])))
          << i << ' ' << k;
  const auto camera = [](const scene::Scene& scene) {
    Diagnostics ignored;
    for (const scene::Leaf& leaf : scene::flatten(scene, kRootGroup, ignored))
      if (const auto* c = leaf.camera())
        return std::pair(*c->aperture / *c->focal, leaf.local_to_world);
    return std::pair(0.0f, Mat4());
  };
  EXPECT_NEAR(camera(*to.scene).first, 2 * std::tan(.4) * 1.7, 1e-4);
  EXPECT_NEAR(camera(*from.scene).first, camera(*to.scene).first, 1e-5);
  EXPECT_TRUE(camera(*to.scene).second.equalWithAbsError(camera(*from.scene).second, 1e-5f));
}

/// The intensity of the first light of the file of a scene, whose physical_light has colour 8.
double written_intensity(const scene::Scene& scene) {
  Diagnostics notes;
  const std::string bytes = gltf::write_glb(scene, notes);
  const std::size_t length =
      static_cast<unsigned char>(bytes[12]) + 256u * static_cast<unsigned char>(bytes[13]);
  const json root = json::parse(bytes.substr(20, length));
  return root["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"].get<double>();
}

scene::Value numbers(std::vector<double> values) {
  scene::Value value;
  value.kind = scene::Value::Kind::Numbers;
  value.numbers = std::move(values);
  return value;
}

// physical_light of colour 8 has 2 W/sr; a unit of a sky with conversion 1 / (683 pi) is 683 cd/m2.
TEST(GltfWrite, LightsHaveTheUnitOfTheScene) {
  Made from;
  from.import(scene_file().text());
  ASSERT_TRUE(from.scene);
  scene::Scene& scene = *from.scene;
  for (scene::Element& element : scene.elements())
    if (auto* light = std::get_if<scene::Light>(&element))
      if (light->shaders[0].type == "physical_light")
        light->shaders[0].arguments = {{"color", numbers({8, 8, 8}), {}}};
  EXPECT_NEAR(written_intensity(scene), 2, 1e-5);
  const double conversion = 1 / (683 * M_PI);
  scene::ShaderElement sky;
  sky.name = "sky";
  sky.functions.push_back(
      {.type = "mia_physicalsky",
       .arguments = {{"rgb_unit_conversion", numbers({conversion, conversion, conversion}), {}}}});
  scene.add(sky);
  EXPECT_NEAR(written_intensity(scene), 2 * 683, 1e-2);
  for (scene::Element& element : scene.elements())
    if (auto* camera = std::get_if<scene::Camera>(&element))
      camera->lens.push_back(
          {.type = "mia_exposure_photographic", .arguments = {{"cm2_factor", numbers({10}), {}}}});
  EXPECT_NEAR(written_intensity(scene), 20, 1e-4);
}

// acceptance: M5
TEST(GltfWrite, MaterialsRoundTrip) {
  const json volume = {
      {"KHR_materials_transmission", {{"transmissionFactor", 1}}},
      {"KHR_materials_ior", {{"ior", 1.4}}},
      {"KHR_materials_volume",
       {{"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", {.5, .25, .75}}}}};
  const auto pbr = [](double metallic, double roughness, double alpha = 1) {
    return json{{"pbrMetallicRoughness",
                 {{"metallicFactor", metallic},
                  {"roughnessFactor", roughness},
                  {"baseColorFactor", {.25, .5, .75, alpha}}}}};
  };
  std::vector<json> cases{pbr(0, .5),      pbr(1, .3), pbr(0, 0),
                          pbr(0, .5, .25), pbr(0, .5), pbr(.25, .5)};
  cases[2]["extensions"] = volume;
  cases[3]["alphaMode"] = "BLEND";
  cases[4]["emissiveFactor"] = {1, .5, .25};
  cases[4]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 40;
  for (const json& material : cases) {
    GltfFile file;
    file.add_triangle();
    file.material() = material;
    file.material()["name"] = "paint";
    Made from, to;
    from.import(file.text());
    write_and_read(from, to);
    for (const char* parameter :
         {"diffuse", "diffuse_weight", "refl_gloss", "refl_color", "brdf_0_degree_refl",
          "transparency", "thin_walled", "refr_color", "refr_ior", "refr_falloff_dist",
          "refr_falloff_color", "cutout_opacity", "additional_color"}) {
      const std::vector<double> before = testing::set_in(*from.scene, "paint", parameter);
      const std::vector<double> after = testing::set_in(*to.scene, "paint", parameter);
      ASSERT_EQ(after.size(), before.size()) << parameter << material;
      for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_NEAR(after[i], before[i], 1e-3 * std::max(1., before[i])) << parameter << material;
    }
  }
}

}  // namespace gltf_write_test
}  // namespace oriel::models
