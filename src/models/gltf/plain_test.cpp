// SPDX-License-Identifier: Apache-2.0
// Import of glTF files with unusual storage.
#include "models/gltf/plain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "models/testing/gltf_file.h"

namespace oriel::models {
namespace plain_test {

using testing::GltfFile;
using testing::json;
using testing::Made;
using testing::world_points;

/// The unit sphere: strips of quads between circles of latitude with shared points.
void add_sphere(GltfFile& file, bool quantized) {
  constexpr int kRings = 12, kSides = 24;
  std::vector<float> points;
  std::vector<std::uint16_t> corners;
  for (int r = 0; r <= kRings; ++r)
    for (int s = 0; s < kSides; ++s) {
      const double up = M_PI * r / kRings, around = 2 * M_PI * s / kSides;
      for (const double x :
           {std::sin(up) * std::cos(around), std::cos(up), std::sin(up) * std::sin(around)})
        points.push_back(static_cast<float>(x));
      if (r == kRings) continue;
      const auto at = [&](int ring, int side) {
        return static_cast<std::uint16_t>(ring * kSides + side % kSides);
      };
      // At the poles one of the two has no area.
      if (r < kRings - 1) corners.insert(corners.end(), {at(r, s), at(r + 1, s + 1), at(r + 1, s)});
      if (r > 0) corners.insert(corners.end(), {at(r, s), at(r, s + 1), at(r + 1, s + 1)});
    }
  json& primitive = file.primitive();
  if (quantized) {
    std::vector<std::int16_t> stored;
    for (const float x : points)
      stored.push_back(static_cast<std::int16_t>(std::lround(x * 32767)));
    primitive["attributes"]["POSITION"] = file.add(stored, testing::kShort, "VEC3", 3, true);
    file.root["extensionsUsed"] = file.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  } else {
    primitive["attributes"]["POSITION"] = file.add(points, testing::kFloat, "VEC3", 3);
  }
  primitive["indices"] = file.add(corners, testing::kUnsignedShort, "SCALAR", 1);
}

TEST(GltfPlain, QuantizedSphereIsDecoded) {
  for (const bool quantized : {false, true}) {
    GltfFile file;
    add_sphere(file, quantized);
    file.node()["scale"] = {2, 2, 2};
    Made made;
    made.import(file.binary(), "ball.glb");
    ASSERT_TRUE(made.scene);
    EXPECT_TRUE(made.diagnostics.all().empty());
    EXPECT_EQ(made.group().polygons.size(), 11u * 24 * 2);
    // Half a quantisation step per coordinate, times two.
    for (const Vec3& p : world_points(*made.scene)) EXPECT_NEAR(length(p), 2, 2e-4 / 3);
  }
}

TEST(GltfPlain, TextureCoordinatesMayBeFractionsOfWholeNumbers) {
  GltfFile file;
  file.add_triangle();
  file.primitive()["attributes"]["TEXCOORD_0"] = file.add<std::uint16_t>(
      {0, 65535, 13107, 0, 65535, 65535}, testing::kUnsignedShort, "VEC2", 2, true);
  file.primitive()["attributes"]["TEXCOORD_1"] = file.add<std::uint8_t>(
      {0, 255, 51, 0, 255, 255, 0, 0}, testing::kUnsignedByte, "VEC2", 2, true);
  file.root["accessors"].back()["count"] = 3;
  Made made;
  made.import(file.text());
  // v up here, down in the file.
  for (const std::size_t space : {0u, 1u}) {
    EXPECT_LT(length(made.uv(space, 0) - Vec3(0, 0, 0)), 1e-6f);
    EXPECT_LT(length(made.uv(space, 1) - Vec3(.2f, 1, 0)), 1e-6f);
    EXPECT_LT(length(made.uv(space, 2) - Vec3(1, 0, 0)), 1e-6f);
  }
}

TEST(GltfPlain, BuffersAndPicturesAreFoundByEscapedNames) {
  GltfFile file;
  file.add_triangle();
  file.primitive()["attributes"]["TEXCOORD_0"] =
      file.add<float>({0, 0, 1, 0, 0, 1}, testing::kFloat, "VEC2", 2);
  file.root["buffers"][0] = {{"uri", "my%20\xE2\x99\xBB.bin"}, {"byteLength", file.bytes.size()}};
  file.root["images"] = json::array({{{"uri", "my%20wood.ppm"}}});
  file.root["textures"] = json::array({{{"source", 0}}});
  file.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  Made made;
  made.folder.write("my \xE2\x99\xBB.bin", file.bytes);
  made.folder.write("my wood.ppm", "P6");
  made.import(file.root.dump());
  ASSERT_TRUE(made.scene);
  EXPECT_TRUE(made.diagnostics.all().empty());
  EXPECT_EQ(made.point(1), Vec3(1, 0, 0));
  const auto* picture = made.scene->get<scene::Texture>("picture_my_wood");
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->file, "my wood.ppm");
}

TEST(GltfPlain, UpperCaseSuffixesAreGltf) {
  GltfFile file;
  file.add_triangle();
  file.primitive()["attributes"]["COLOR_0"] = file.add<std::uint8_t>(
      {255, 0, 0, 9, 255, 0, 0, 9, 255, 0, 0, 9}, testing::kUnsignedByte, "VEC3", 4, true);
  file.root["bufferViews"].back()["byteStride"] = 4;
  for (const char* name : {"M.GLTF", "M.GLB"}) {
    Made made;
    made.import(name[2] == 'G' && name[4] == 'B' ? file.binary() : file.text(), name);
    ASSERT_TRUE(made.scene) << name;
    // As for glTF: no smooth normals, and linear vertex colours.
    EXPECT_TRUE(made.group().vertices.normal.empty());
    EXPECT_EQ(made.uv(0, 0), Vec3(1, 0, 0));
  }
}

TEST(GltfPlain, MeshWeightsApplyMorphTargets) {
  GltfFile file;
  file.add_triangle();
  file.primitive()["targets"] = json::array();
  for (int i = 0; i < 2; ++i)
    file.primitive()["targets"].push_back(
        {{"POSITION", file.add<float>({0, 0, 1, 0, 0, 2, 0, 1, 0}, testing::kFloat, "VEC3", 3)}});
  file.root["meshes"][0]["weights"] = {.5, 0};
  Made made;
  made.import(file.text());
  EXPECT_EQ(made.point(0), Vec3(0, 0, .5f));
  EXPECT_EQ(made.point(1), Vec3(1, 0, 1));
  EXPECT_EQ(made.point(2), Vec3(0, 1.5f, 0));
}

TEST(GltfPlain, UnreadablePartsAreSkippedAndReported) {
  GltfFile file;
  file.add_triangle();
  json broken = file.primitive();
  broken["attributes"]["POSITION"] = 99;
  file.root["meshes"][0]["primitives"].push_back(broken);
  json far = file.primitive();
  far["indices"] = file.add<std::uint16_t>({0, 1, 3}, testing::kUnsignedShort, "SCALAR", 1);
  file.root["meshes"][0]["primitives"].push_back(far);
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  EXPECT_EQ(world_points(*made.scene).size(), 3u);
  EXPECT_TRUE(made.said("2 mesh primitives are skipped: accessor 99 does not exist"));
  EXPECT_EQ(made.diagnostics.all().size(), 1u);
  // If nothing can be read, there is no model.
  file.root["meshes"][0]["primitives"].erase(0);
  Made none;
  none.import(file.text());
  EXPECT_FALSE(none.scene);
  EXPECT_TRUE(none.said("accessor 99 does not exist"));
}

TEST(GltfPlain, TrianglesWithInvalidIndicesAreSkipped) {
  GltfFile file;
  file.add_triangle();
  file.primitive()["indices"] =
      file.add<std::uint16_t>({0, 1, 2, 2, 1, 3, 0, 2, 1}, testing::kUnsignedShort, "SCALAR", 1);
  Made made;
  made.import(file.text());
  EXPECT_EQ(made.group().polygons.size(), 2u);
  EXPECT_TRUE(made.said("1 triangles have vertex indices out of range"));
}

TEST(GltfPlain, CoordinatesThatDoNotFitAreReplacedByTheNextSet) {
  GltfFile file;
  file.add_triangle();
  json& attributes = file.primitive()["attributes"];
  attributes["TEXCOORD_0"] = file.add<float>({9, 9}, testing::kFloat, "VEC2", 2);
  attributes["TEXCOORD_1"] = file.add<float>({0, 0, 1, 0, 0, 1}, testing::kFloat, "VEC2", 2);
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  EXPECT_EQ(made.uv(0, 1), Vec3(1, 1, 0));
  EXPECT_EQ(made.uv(1, 1), Vec3(1, 1, 0));
}

TEST(GltfPlain, TooDeeplyNestedTextIsRejected) {
  Made made;
  made.import(R"({"asset":{"version":"2.0"},"extras":)" + std::string(300'000, '['));
  EXPECT_FALSE(made.scene);
  EXPECT_TRUE(made.said("its JSON is nested too deeply"));
}

TEST(GltfPlain, UnsupportedRequiredExtensionsAreReportedOnce) {
  GltfFile file;
  file.add_triangle();
  file.root["extensionsUsed"] = file.root["extensionsRequired"] = {
      "ACME_b", "ACME_a", "ACME_a", "KHR_mesh_quantization", "KHR_materials_unlit"};
  Made made;
  made.import(file.text());
  ASSERT_TRUE(made.scene);
  EXPECT_TRUE(made.said("unsupported required extensions: ACME_a, ACME_b; their data is skipped"));
  EXPECT_EQ(made.diagnostics.all().size(), 1u);
}

TEST(GltfPictures, WebPIsPreferredAndBasisUniversalIsSkipped) {
  GltfFile file;
  file.add_triangle();
  file.root["images"] = json::array(
      {{{"uri", "a.ppm"}}, {{"uri", "b.webp"}}, {{"uri", "c.ktx2"}}, {{"uri", "d.webp"}}});
  file.root["textures"] = json::array();
  json& textures = file.root["textures"];
  textures.push_back({{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}});
  textures.push_back({{"extensions", {{"EXT_texture_webp", {{"source", 3}}}}}});
  textures.push_back({{"source", 0}, {"extensions", {{"KHR_texture_basisu", {{"source", 2}}}}}});
  textures.push_back({{"extensions", {{"KHR_texture_basisu", {{"source", 2}}}}}});
  json& material = file.material();
  const auto picture_of = [&](int texture) {
    material = {{"name", "paint"},
                {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}};
    Made made;
    for (const char* name : {"a.ppm", "b.webp", "c.ktx2", "d.webp"}) made.folder.write(name, "P6");
    made.import(file.text());
    EXPECT_TRUE(made.said("2 textures use Basis Universal"));
    EXPECT_EQ(made.diagnostics.all().size(), 1u);
    for (const scene::Element& e : made.scene->elements())
      if (const auto* found = std::get_if<scene::Texture>(&e)) return found->file;
    return std::string();
  };
  EXPECT_EQ(picture_of(0), "b.webp");
  EXPECT_EQ(picture_of(1), "d.webp");
  EXPECT_EQ(picture_of(2), "a.ppm");
  EXPECT_EQ(picture_of(3), "");
}

TEST(GltfPictures, PicturesInTheBufferAreFilesOfTheirKind) {
  GltfFile file;
  file.add_triangle();
  const std::string webp("RIFF\0\0\0\0WEBPVP8 ", 16);
  file.root["images"] =
      json::array({{{"bufferView", file.add_view(webp)}, {"mimeType", "image/webp"}}});
  file.root["textures"] = json::array({{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}});
  file.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  Made made;
  made.import(file.binary(), "m.glb");
  ASSERT_TRUE(made.scene);
  EXPECT_TRUE(made.diagnostics.all().empty());
  std::ifstream written(made.folder.path() / "t" / "texture_0.webp", std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(written), {}), webp);
}

}  // namespace plain_test
}  // namespace oriel::models
