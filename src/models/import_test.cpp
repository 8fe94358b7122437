// SPDX-License-Identifier: Apache-2.0
#include "models/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include "bsdf/gloss.h"
#include "models/daylight.h"
#include "models/lobe_width.h"
#include "models/testing/model_file.h"
#include "scene/hierarchy.h"

namespace oriel::models {
namespace import_test {

using testing::base64;
using testing::Folder;
using testing::gltf;
using testing::imported;
using testing::set_in;

TEST(ModelMaterial, GlossinessHasTheRoughnessOfTheModel) {
  for (float r = .06f; r < .59f; r += .05f)
    EXPECT_NEAR(bsdf::gloss_to_alpha(gloss_of_roughness(r)), r * r, 1e-4f) << r;
  EXPECT_EQ(gloss_of_roughness(.05f), 1);  // nearly smooth becomes a perfect mirror
  EXPECT_EQ(gloss_of_roughness(1), 0);
}

TEST(ModelMaterial, AMetalReflectsItsColourAndADielectricItsIndex) {
  const scene::Scene metal =
      imported("m.gltf", gltf(R"("pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1],)"
                              R"("metallicFactor":1,"roughnessFactor":0.3})"));
  EXPECT_EQ(set_in(metal, "oak", "refl_color"), (std::vector<double>{1, .5, .25}));
  EXPECT_EQ(set_in(metal, "oak", "diffuse_weight"), std::vector<double>{0});
  EXPECT_NEAR(set_in(metal, "oak", "brdf_0_degree_refl").at(0), 1, 1e-6);
  const scene::Scene plastic =
      imported("m.gltf", gltf(R"("pbrMetallicRoughness":{"metallicFactor":0},)"
                              R"("extensions":{"KHR_materials_ior":{"ior":1.8}})",
                              "", R"("extensionsUsed":["KHR_materials_ior"],)"));
  // Fresnel at normal incidence, ((n - 1) / (n + 1))^2, if the reader supports the extension.
  const double f0 = set_in(plastic, "oak", "brdf_0_degree_refl").at(0);
  EXPECT_TRUE(std::fabs(f0 - std::pow(.8 / 2.8, 2)) < 1e-6 || std::fabs(f0 - .04) < 1e-6) << f0;
  EXPECT_EQ(set_in(plastic, "oak", "diffuse_weight"), std::vector<double>{1});
  EXPECT_EQ(set_in(plastic, "oak", "refl_color"), (std::vector<double>{1, 1, 1}));
}

TEST(ModelMaterial, TransmissionIsThinUntilThereIsAVolume) {
  const std::string through =
      R"("pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},)"
      R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":0.75})";
  const char* const kUses =
      R"("extensionsUsed":["KHR_materials_transmission","KHR_materials_volume"],)";
  const scene::Scene thin = imported("m.gltf", gltf(through + "}", "", kUses));
  EXPECT_EQ(set_in(thin, "oak", "transparency"), std::vector<double>{.75});
  EXPECT_EQ(set_in(thin, "oak", "thin_walled"), std::vector<double>{1});
  EXPECT_EQ(set_in(thin, "oak", "refr_gloss"), std::vector<double>{1});
  const scene::Scene solid = imported(
      "m.gltf", gltf(through + R"(,"KHR_materials_volume":{"thicknessFactor":1,)"
                               R"("attenuationDistance":0.5,"attenuationColor":[1,0.5,0.5]}})",
                     "", kUses));
  EXPECT_EQ(set_in(solid, "oak", "thin_walled"), std::vector<double>{0});
  EXPECT_EQ(set_in(solid, "oak", "refr_falloff_dist"), std::vector<double>{.5});
  EXPECT_EQ(set_in(solid, "oak", "refr_falloff_color"), (std::vector<double>{1, .5, .5}));
}

TEST(ModelMaterial, PhongExponentsBecomeTheWidthOfTheLobe) {
  const auto scene =
      imported("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n",
               "newmtl red\nKd .8 .1 .1\nKs .5 .5 .5\nNs 98\nd 0.25\n");
  const double gloss = set_in(scene, "red", "refl_gloss").at(0);
  // sqrt(2 / (98 + 2)).
  EXPECT_NEAR(bsdf::gloss_to_alpha(static_cast<float>(gloss)), .1414f, 1e-3f);
  EXPECT_NEAR(set_in(scene, "red", "brdf_0_degree_refl").at(0), .04, 1e-6) << "8 / 100 of .5";
  EXPECT_NEAR(set_in(scene, "red", "diffuse").at(0), .8, 1e-6);
  EXPECT_NEAR(set_in(scene, "red", "transparency").at(0), .75, 1e-6);
  // A quad stays one.
  for (const scene::Element& e : scene.elements())
    if (const auto* object = std::get_if<scene::Object>(&e)) {
      EXPECT_EQ(object->groups[0].polygons.size(), 1u);
    }
}

TEST(ModelMaterial, MirrorsOfObjReflectWhatTheySayOthersAsTheirHighlightDoes) {
  const auto scene = imported("m.obj",
                              "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl mirror\n"
                              "f 1 2 3\nusemtl dull\nf 1 2 3\n",
                              "newmtl mirror\nKd 0 0 0\nKs .5 .5 .5\nNs 98\nillum 3\n"
                              "newmtl dull\nKd .5 .5 .5\nKs .5 .5 .5\nNs 8\nillum 2\n");
  EXPECT_NEAR(set_in(scene, "mirror", "brdf_0_degree_refl").at(0), .5, 1e-6);
  EXPECT_NEAR(set_in(scene, "dull", "brdf_0_degree_refl").at(0), .4, 1e-6);
}

TEST(ModelImport, UpAxisIsConverted) {
  const Folder folder;
  const std::string path =
      folder.write("m.stl",
                   "solid s\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                   "vertex 0 0 3\nendloop\nendfacet\nendsolid s\n");
  const auto tip = [&](std::optional<char> up) {
    Diagnostics diagnostics;
    const auto scene = import_model(path, {folder.path() / "t", folder.path(), up}, diagnostics);
    EXPECT_TRUE(scene);
    Diagnostics ignored;
    Vec3 highest(0);
    for (const scene::Leaf& leaf : scene::flatten(*scene, kRootGroup, ignored))
      for (const Vec3& v : leaf.object()->groups[0].vectors) {
        const Vec3 p = transform_point(v, leaf.local_to_world);
        if (length(p) > length(highest)) highest = p;
      }
    return highest;
  };
  EXPECT_LT(length(tip({}) - Vec3(0, 3, 0)), 1e-6f) << "STL: z is up";
  EXPECT_LT(length(tip('y') - Vec3(0, 0, 3)), 1e-6f);
}

TEST(ModelMaterial, PicturesWithinTheModelBecomeFilesAndAreLookedUp) {
  const Folder folder;
  Diagnostics diagnostics;
  const std::string path = folder.write(
      "m.gltf",
      gltf(R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0})", "",
           R"("textures":[{"source":0}],"images":[{"mimeType":"image/png","uri":)"
           R"("data:image/png;base64,)" +
               base64("no picture, but its bytes") + "\"}],"));
  const auto scene = import_model(path, {folder.path() / "t", folder.path()}, diagnostics);
  ASSERT_TRUE(scene);
  const auto* material = scene->get<scene::Material>("oak");
  ASSERT_TRUE(material);
  const auto& arguments = material->shaders[0].arguments;
  ASSERT_EQ(arguments[0].name, "diffuse");
  EXPECT_EQ(arguments[0].value.kind, scene::Value::Kind::Connection);
  const auto* lookup = scene->get<scene::ShaderElement>(arguments[0].value.text);
  ASSERT_TRUE(lookup);
  EXPECT_EQ(lookup->functions[0].type, "mib_texture_lookup2");
  const auto* texture = scene->get<scene::Texture>(lookup->functions[0].arguments[0].value.text);
  ASSERT_TRUE(texture);
  std::ifstream file(folder.path() / texture->file);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "no picture, but its bytes");
}

TEST(ModelImport, NodesBecomeInstancesWithTheInverseMatrix) {
  const scene::Scene scene = imported(
      "m.gltf", gltf(R"("doubleSided":true)", R"(,"translation":[1,2,3],"scale":[2,2,2])"));
  const auto* instance = scene.get<scene::Instance>("chair_inst");
  ASSERT_TRUE(instance && instance->transform);
  EXPECT_EQ(instance->element, "seat");
  EXPECT_EQ(instance->materials, std::vector<std::string>{"oak"});
  // The far corner in world space maps to the local one.
  const Vec3 local = transform_point(Vec3(3, 2, 3), *instance->transform);
  EXPECT_NEAR(length(local - Vec3(1, 0, 0)), 0, 1e-6f);
  const auto* object = scene.get<scene::Object>("seat");
  ASSERT_TRUE(object);
  EXPECT_EQ(object->groups[0].polygons.size(), 1u);
}

TEST(ModelImport, LightsAreInCandela) {
  const scene::Scene scene = imported(
      "m.gltf",
      gltf(R"("doubleSided":true)", R"(,"extensions":{"KHR_lights_punctual":{"light":0}})",
           R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":)"
           R"({"lights":[{"type":"point","name":"bulb","color":[1,1,1],"intensity":50}]}},)"));
  const scene::Light* light = nullptr;
  for (const scene::Element& e : scene.elements())
    if (const auto* found = std::get_if<scene::Light>(&e)) light = found;
  ASSERT_TRUE(light);
  // physical_light divides by 4 pi, a surface by pi: 50 cd at 1 m are 50 lux.
  EXPECT_EQ(light->shaders[0].arguments[0].value.numbers, (std::vector<double>{200, 200, 200}));
}

TEST(ModelImport, FileWithoutSurfacesIsReported) {
  const Folder folder;
  Diagnostics diagnostics;
  const auto scene =
      import_model(folder.write("m.gltf", R"({"asset":{"version":"2.0"},"scene":0,)"
                                          R"("scenes":[{"nodes":[0]}],"nodes":[{"name":"a"}]})"),
                   {folder.path() / "t", folder.path()}, diagnostics);
  EXPECT_TRUE(scene);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "OR-MD-012");
}

TEST(ModelImport, InvalidFileIsReported) {
  const Folder folder;
  Diagnostics diagnostics;
  const std::string whole = gltf(R"("doubleSided":true)");
  for (const std::size_t size : {0u, 1u, 40u, 400u}) {
    Diagnostics d;
    EXPECT_FALSE(import_model(folder.write("m.gltf", whole.substr(0, size)),
                              {folder.path(), folder.path()}, d));
    ASSERT_FALSE(d.all().empty());
    EXPECT_EQ(d.all()[0].code, "OR-MD-001");
  }
  EXPECT_FALSE(
      import_model(folder.path() / "none.obj", {folder.path(), folder.path()}, diagnostics));
}

/// Largest image coordinate of points for the rendering camera; 1 is the image border.
float largest_in_frame(const scene::Scene& scene, const std::vector<Vec3>& points) {
  const auto* placed = scene.get<scene::Instance>(scene.renders.at(0).camera);
  const auto* camera = scene.get<scene::Camera>(placed->element);
  const float half = *camera->aperture / 2 / *camera->focal;
  float most = 0;
  for (const Vec3& point : points) {
    const Vec3 p = transform_point(point, *placed->transform);
    EXPECT_LT(p.z, 0);
    most = std::max(
        {most, std::fabs(p.x / p.z) / half, std::fabs(p.y / p.z) / half * *camera->aspect});
  }
  return most;
}

TEST(Daylight, EmptyModelIsTreatedAsAUnitCube) {
  scene::Scene scene;
  scene::InstanceGroup root;
  root.name = kRootGroup;
  scene.add(root);
  add_camera(scene, {});
  std::vector<Vec3> corners;
  for (const float x : {-.5f, .5f})
    for (const float y : {-.5f, .5f})
      for (const float z : {-.5f, .5f}) corners.emplace_back(x, y, z);
  const float most = largest_in_frame(scene, corners);
  EXPECT_LT(most, 1);
  EXPECT_GT(most, .7f);
}

TEST(Daylight, TheWholeModelIsInTheFrame) {
  scene::Scene scene = imported(
      "m.gltf", gltf(R"("doubleSided":true)", R"(,"translation":[10,2,-3],"scale":[7,1,1])"));
  DaylightOptions options;
  add_camera(scene, options);
  add_daylight(scene, options);
  const auto* placed = scene.get<scene::Instance>(scene.renders.at(0).camera);
  const auto* camera = scene.get<scene::Camera>(placed->element);
  const auto* chair = scene.get<scene::Instance>("chair_inst");
  std::vector<Vec3> corners;
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)})
    corners.push_back(transform_point(corner, chair->transform->inverse()));
  const float most = largest_in_frame(scene, corners);
  EXPECT_LT(most, 1);
  EXPECT_GT(most, .7f);
  EXPECT_TRUE(scene.get<scene::Light>("sun"));
  EXPECT_EQ(camera->environment.size(), 1u);
}

}  // namespace import_test
}  // namespace oriel::models
