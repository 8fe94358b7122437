// SPDX-License-Identifier: Apache-2.0
#include "models/vertex_colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bsdf/gloss.h"
#include "models/lobe_width.h"
#include "models/testing/gltf_file.h"

namespace oriel::models {
namespace vertex_colors_test {

using testing::GltfFile;
using testing::json;
using testing::Made;

const char* const kColoredPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 255 0 0\n1 0 0 0 128 0\n0 1 0 0 0 255\n3 0 1 2\n";

const scene::Object* object_of(const scene::Scene& scene) {
  for (const scene::Element& e : scene.elements())
    if (const auto* found = std::get_if<scene::Object>(&e)) return found;
  return nullptr;
}

/// The first texture space of the only object, in the order of its corners.
std::vector<Vec3> colors_in(const scene::Scene& scene) {
  const scene::PolygonGroup& group = object_of(scene)->groups[0];
  std::vector<Vec3> colors;
  if (group.vertices.textures.empty()) return colors;
  for (const std::uint32_t i : group.vertices.textures[0].coordinate)
    colors.push_back(group.vectors[i]);
  return colors;
}

const scene::ShaderUse* shader(const scene::Scene& scene, const char* name) {
  const auto* found = scene.get<scene::ShaderElement>(name);
  return found ? &found->functions[0] : nullptr;
}

TEST(VertexColors, OfPlyAndObjAreTheDiffuseColourCodedAsPicturesAre) {
  const float middle = std::pow(128 / 255.f, 2.2f);
  for (const char* name : {"m.ply", "m.obj", "M.PLY"}) {
    const bool obj = name[2] == 'o';
    Made made;
    made.import(
        obj ? "v 0 0 0 1 0 0\nv 1 0 0 0 0.50196078 0\nv 0 1 0 0 0 1\nf 1 2 3\n" : kColoredPly,
        name);
    ASSERT_TRUE(made.scene) << name;
    const std::vector<Vec3> colors = colors_in(*made.scene);
    const std::vector<Vec3> wanted{{1, 0, 0}, {0, middle, 0}, {0, 0, 1}};
    ASSERT_EQ(colors.size(), 3u) << name;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(length(colors[i] - wanted[i]), 1e-5f) << name;
    const bool asked = std::any_of(
        made.scene->elements().begin(), made.scene->elements().end(), [](const scene::Element& e) {
          const auto* found = std::get_if<scene::ShaderElement>(&e);
          return found && found->functions[0].type == "oriel_vertex_color";
        });
    EXPECT_TRUE(asked) << name;
    EXPECT_EQ(made.scene->packages.back(), "oriel.mi");
  }
}

TEST(VertexColors, MeshesWithoutThemAreWhiteBesideOthersOfTheirMaterial) {
  GltfFile file;
  file.add_triangle();
  json plain = file.primitive();
  file.primitive()["attributes"]["COLOR_0"] =
      file.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}, testing::kFloat, "VEC3", 3);
  file.root["meshes"].push_back({{"name", "other"}, {"primitives", {plain}}});
  file.root["nodes"].push_back({{"name", "other"}, {"mesh", 1}});
  file.root["scenes"][0]["nodes"].push_back(1);
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  EXPECT_EQ(made.uv(0, 1), Vec3(0, 1, 0));
  const scene::PolygonGroup& other = made.group("other");
  ASSERT_EQ(other.vertices.textures.size(), 1u);
  for (const std::uint32_t i : other.vertices.textures[0].coordinate)
    EXPECT_EQ(other.vectors[i], Vec3(1));
}

TEST(VertexColors, FollowTheTextureSpacesOfImages) {
  GltfFile file;
  file.add_triangle();
  json& attributes = file.primitive()["attributes"];
  attributes["COLOR_0"] =
      file.add<float>({.1f, .2f, .3f, .5f, 0, 0, 0, 1, 0, 0, 0, 1}, testing::kFloat, "VEC4", 4);
  attributes["TEXCOORD_0"] = file.add<float>({0, 0, 1, 0, 0, 1}, testing::kFloat, "VEC2", 2);
  file.root["images"] = json::array({{{"uri", "a.ppm"}}});
  file.root["textures"] = json::array({{{"source", 0}}});
  file.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  file.material()["alphaMode"] = "MASK";
  Made made;
  made.folder.write("a.ppm", "P6");
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  const scene::ShaderUse* call = shader(*made.scene, "paint_colors");
  ASSERT_TRUE(call);
  EXPECT_EQ(call->arguments[0].name, "color");
  EXPECT_EQ(call->arguments[1].value.numbers, std::vector<double>{1});
  EXPECT_EQ(call->arguments[2].value.numbers, std::vector<double>{2});
  EXPECT_LT(length(made.uv(1, 0) - Vec3(.1f, .2f, .3f)), 1e-6f);
  EXPECT_EQ(made.uv(2, 0).x, .5f);
  EXPECT_TRUE(shader(*made.scene, "paint_coverage"));
}

TEST(ModelMaterial, AnisotropyHasTheWidthsOfTheExtension) {
  for (const float roughness : {.1f, .3f, .5f})
    for (const float strength : {0.f, .1f, .25f}) {
      const float across = roughness * roughness;
      const float along = across + (1 - across) * strength * strength;
      if (std::sqrt(along * across) > .35f || along > 10 * across) continue;
      const Brushed lobe = brushed(roughness, strength);
      const bsdf::Roughness made = bsdf::gloss_to_roughness(lobe.gloss, lobe.ratio);
      EXPECT_NEAR(made.ax, along, 2e-3f) << roughness << ' ' << strength;
      EXPECT_NEAR(made.ay, across, 2e-3f) << roughness << ' ' << strength;
    }
  EXPECT_EQ(brushed(.05f, 1).ratio, 10);
}

}  // namespace vertex_colors_test
}  // namespace oriel::models
