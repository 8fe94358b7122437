// SPDX-License-Identifier: Apache-2.0
// Texture spaces, normal maps, clear coats and small glTF extensions.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>

#include "bsdf/gloss.h"
#include "models/gltf/extras.h"
#include "models/import.h"
#include "models/lobe_width.h"
#include "models/testing/model_file.h"

namespace oriel::models {
namespace import_surface_test {

using testing::Folder;
using testing::imported;
using testing::Quad;
using testing::set_in;

const char* const kPictures =
    R"("textures":[{"source":0},{"source":1}],"images":[{"uri":"a.ppm"},{"uri":"b.ppm"}],)";

/// A scene with existing pictures, and the diagnostics.
struct Imported {
  Folder folder;
  Diagnostics diagnostics;
  scene::Scene scene;

  explicit Imported(const std::string& content, const std::string& name = "m.gltf") {
    for (const char* picture : {"a.ppm", "b.ppm", "wood_Normal.ppm"}) folder.write(picture, "P6");
    auto made = import_model(folder.write(name, content), {folder.path() / "t", folder.path()},
                             diagnostics);
    EXPECT_TRUE(made.has_value());
    if (made) scene = std::move(*made);
  }
  bool said(const std::string& words) const {
    for (const Diagnostic& d : diagnostics.all())
      if (diagnostics.format(d).find(words) != std::string::npos) return true;
    return false;
  }
};

const scene::Argument* argument(const scene::ShaderUse& use, const std::string& name) {
  for (const scene::Argument& a : use.arguments)
    if (a.name == name) return &a;
  return nullptr;
}

/// The shader connected to a parameter.
const scene::ShaderUse* behind(const scene::Scene& scene, const scene::ShaderUse& use,
                               const std::string& parameter) {
  const scene::Argument* a = argument(use, parameter);
  const auto* shader = a ? scene.get<scene::ShaderElement>(a->value.text) : nullptr;
  return shader ? &shader->functions[0] : nullptr;
}

const scene::ShaderUse& material_of(const scene::Scene& scene, const char* name = "oak") {
  return *models::testing::surface_of(scene, name);
}

/// Texture coordinates of a corner of the only object.
Vec3 uv_of(const scene::Scene& scene, std::size_t space, std::size_t corner) {
  const scene::PolygonGroup& group = scene.get<scene::Object>("seat")->groups[0];
  if (space >= group.vertices.textures.size()) return Vec3(-1e9f);
  return group.vectors[group.vertices.textures[space].coordinate[corner]];
}

TEST(ModelTexture, TransformsFollowTheExtension) {
  Quad quad;
  // Example of the extension: the lower left quadrant of the picture, rotated by 90 degrees.
  quad.material =
      R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{)"
      R"("KHR_texture_transform":{"offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5]}}}})";
  quad.more = std::string(kPictures) + R"("extensionsUsed":["KHR_texture_transform"],)";
  const Imported quadrant(quad.text());
  // With v up, the quadrant is 0..0.5 in u and v; its corner at the corner of the image is (0, 0)
  // of the file.
  EXPECT_LT(length(uv_of(quadrant.scene, 0, 3) - Vec3(0, 0, 0)), 1e-6f);
  EXPECT_LT(length(uv_of(quadrant.scene, 0, 0) - Vec3(.5f, 0, 0)), 1e-6f);
  EXPECT_LT(length(uv_of(quadrant.scene, 0, 1) - Vec3(.5f, .5f, 0)), 1e-6f);
  EXPECT_LT(length(uv_of(quadrant.scene, 0, 2) - Vec3(0, .5f, 0)), 1e-6f);
  quad.material = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{)"
                  R"("KHR_texture_transform":{"offset":[0.1,0.2],"scale":[2,3]}}}})";
  const Imported scaled(quad.text());
  // (1, 1) of the file maps to (2.1, 3.2), v down.
  EXPECT_LT(length(uv_of(scaled.scene, 0, 1) - Vec3(2.1f, -2.2f, 0)), 1e-6f);
}

TEST(ModelTexture, EachUseHasItsCoordinates) {
  Quad quad;
  quad.uv1 = {0, .5f, .5f, .5f, .5f, 0, 0, 0};
  quad.material = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0},)"
                  R"("metallicRoughnessTexture":{"index":0,"texCoord":1}},"normalTexture":)"
                  R"({"index":1,"texCoord":1})";
  quad.more = kPictures;
  const Imported made(quad.text());
  // The normal map has the first space, which is the second set of the file.
  EXPECT_LT(length(uv_of(made.scene, 0, 1) - Vec3(.5f, .5f, 0)), 1e-6f);
  EXPECT_LT(length(uv_of(made.scene, 1, 1) - Vec3(1, 0, 0)), 1e-6f);
  const scene::ShaderUse* base = behind(made.scene, material_of(made.scene), "diffuse");
  ASSERT_TRUE(base);
  EXPECT_EQ(base->type, "mib_texture_lookup");
  const scene::ShaderUse* remap = behind(made.scene, *base, "coord");
  ASSERT_TRUE(remap);
  const scene::ShaderUse* vector = behind(made.scene, *remap, "input");
  ASSERT_TRUE(vector);
  EXPECT_EQ(argument(*vector, "select")->value.numbers, std::vector<double>{1});
  // The same file as colours and as numbers.
  const scene::ShaderUse* gloss = behind(made.scene, material_of(made.scene), "refl_gloss");
  ASSERT_TRUE(gloss);
  const scene::ShaderUse* rough = behind(made.scene, *gloss, "input");
  const scene::ShaderUse* mask = behind(made.scene, *rough, "input");
  const scene::ShaderUse* data = behind(made.scene, *mask, "color_base");
  ASSERT_TRUE(data);
  EXPECT_EQ(data->type, "mib_texture_lookup2");
  const auto kind_of = [&](const scene::ShaderUse& lookup) {
    return made.scene.get<scene::Texture>(argument(lookup, "tex")->value.text)->type;
  };
  EXPECT_EQ(kind_of(*base), scene::ParamType::ColorTexture);
  EXPECT_EQ(kind_of(*data), scene::ParamType::VectorTexture);
}

TEST(ModelBump, NormalMapsOfGltfHaveTheirScaleAndTheMeshsTangents) {
  Quad quad;
  quad.material = R"("normalTexture":{"index":1,"scale":0.7})";
  quad.tangents = {0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1};
  quad.more = kPictures;
  const Imported made(quad.text());
  const scene::ShaderUse& material = material_of(made.scene);
  EXPECT_EQ(argument(material, "bump_mode")->value.numbers, std::vector<double>{5});
  const scene::ShaderUse* normals = behind(made.scene, material, "overall_bump");
  ASSERT_TRUE(normals);
  EXPECT_EQ(normals->type, "oriel_normal_map");
  EXPECT_NEAR(argument(*normals, "factor")->value.numbers.at(0), .7, 1e-6);
  EXPECT_FALSE(made.said("unsupported"));
  EXPECT_EQ(made.scene.packages.back(), "oriel.mi");
  const scene::PolygonGroup& group = made.scene.get<scene::Object>("seat")->groups[0];
  ASSERT_EQ(group.vertices.textures[0].basis_v.size(), 4u);
  EXPECT_EQ(group.vectors[group.vertices.textures[0].basis_u[0]], Vec3(0, 1, 0));
  // (n x t) w = (-1 0 0) x -1.
  EXPECT_EQ(group.vectors[group.vertices.textures[0].basis_v[0]], Vec3(1, 0, 0));
}

TEST(ModelBump, HeightsOfObjBecomeBumpsAndNormalsByTheirName) {
  const auto of_obj = [](const std::string& line) {
    Folder folder;
    folder.write("a.ppm", "P6");
    folder.write("wood_Normal.ppm", "P6");
    folder.write("m.mtl", "newmtl oak\nKd .8 .1 .1\n" + line + "\n");
    Diagnostics diagnostics;
    const auto made = import_model(
        folder.write("m.obj",
                     "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                     "usemtl oak\nf 1/1 2/2 3/3\n"),
        {folder.path() / "t", folder.path()}, diagnostics);
    EXPECT_TRUE(made);
    return made ? *made : scene::Scene();
  };
  const scene::Scene heights = of_obj("map_Bump -bm 2 a.ppm");
  EXPECT_EQ(argument(material_of(heights), "bump_mode")->value.numbers, std::vector<double>{0});
  const scene::ShaderUse* bump = behind(heights, material_of(heights), "bump");
  ASSERT_TRUE(bump);
  EXPECT_EQ(bump->type, "mib_bump_map2");
  EXPECT_EQ(argument(*bump, "factor")->value.numbers, std::vector<double>{-2});
  for (const char* line : {"map_Bump wood_Normal.ppm", "norm a.ppm"}) {
    const scene::Scene normals = of_obj(line);
    const scene::ShaderUse* map = behind(normals, material_of(normals), "overall_bump");
    ASSERT_TRUE(map) << line;
    EXPECT_EQ(map->type, "oriel_normal_map");
  }
}

// The image content decides, not its name: normal maps have a mean near (.5, .5, 1).
// acceptance: M3
TEST(ModelBump, MapsOfObjAreNormalsIfTheirPicturesShowThem) {
  const struct {
    std::array<unsigned char, 6> texels;
    const char* type;
  } kPictures[] = {{{90, 128, 240, 166, 128, 240}, "oriel_normal_map"},
                   {{128, 128, 128, 140, 140, 140}, "mib_bump_map2"},
                   {{60, 80, 220, 60, 80, 220}, "mib_bump_map2"}};
  for (const auto& picture : kPictures) {
    Folder folder;
    folder.write("brick_n.ppm",
                 "P6 2 1 255\n" + std::string(picture.texels.begin(), picture.texels.end()));
    folder.write("m.mtl", "newmtl oak\nKd .8 .1 .1\nmap_Bump -bm 0.5 brick_n.ppm\n");
    Diagnostics diagnostics;
    const auto made = import_model(
        folder.write("m.obj",
                     "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                     "usemtl oak\nf 1/1 2/2 3/3\n"),
        {folder.path() / "t", folder.path()}, diagnostics);
    ASSERT_TRUE(made);
    const bool normals = std::string(picture.type) == "oriel_normal_map";
    const scene::ShaderUse* map =
        behind(*made, material_of(*made), normals ? "overall_bump" : "bump");
    ASSERT_TRUE(map) << picture.type;
    EXPECT_EQ(map->type, picture.type);
    EXPECT_EQ(argument(*map, "factor")->value.numbers[0], normals ? .5 : -.5);
  }
}

TEST(ModelBump, MissingMaterialFilesOfObjAreReported) {
  Folder folder;
  Diagnostics diagnostics;
  const auto made =
      import_model(folder.write("m.obj", "mtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"),
                   {folder.path() / "t", folder.path()}, diagnostics);
  ASSERT_TRUE(made);
  const auto found =
      std::count_if(diagnostics.all().begin(), diagnostics.all().end(), [](const Diagnostic& d) {
        return d.code == "OR-MD-015" && d.message.find("lost.mtl") != std::string::npos;
      });
  EXPECT_EQ(found, 1);
}

TEST(ModelCoat, LayersOverTheMaterial) {
  Quad quad;
  quad.more = std::string(kPictures) + R"("extensionsUsed":["KHR_materials_clearcoat"],)";
  quad.material =
      R"("pbrMetallicRoughness":{"metallicFactor":1},"extensions":{"KHR_materials_clearcoat":)"
      R"({"clearcoatFactor":0.5,"clearcoatRoughnessFactor":0.3,"clearcoatNormalTexture":)"
      R"({"index":0}}})";
  const Imported made(quad.text());
  EXPECT_EQ(material_of(made.scene).type, "mib_glossy_reflection");
  EXPECT_NEAR(set_in(made.scene, "oak", "reflection_base_weight").at(0), .02, 1e-6);
  EXPECT_NEAR(set_in(made.scene, "oak", "reflection_edge_weight").at(0), .5, 1e-6);
  EXPECT_NEAR(set_in(made.scene, "oak", "u_spread").at(0), .09, 1e-6);
  const scene::ShaderUse* base = behind(made.scene, material_of(made.scene), "base_material");
  ASSERT_TRUE(base);
  EXPECT_EQ(base->type, "mia_material_x");
  EXPECT_EQ(argument(*base, "brdf_0_degree_refl")->value.numbers, std::vector<double>{1});
  EXPECT_TRUE(made.said("are ignored: normal map of the clear coat"));
}

TEST(ModelMaterial, SpecularAndEmissiveStrengthAreThoseOfTheFile) {
  Quad quad;
  quad.material =
      R"("pbrMetallicRoughness":{"metallicFactor":0},"emissiveFactor":[1,0.5,0],"extensions":{)"
      R"("KHR_materials_emissive_strength":{"emissiveStrength":8},"KHR_materials_specular":)"
      R"({"specularFactor":0.5,"specularColorFactor":[2,1,1]},"KHR_materials_dispersion":{}})";
  const Imported made(quad.text());
  EXPECT_EQ(set_in(made.scene, "oak", "additional_color"), (std::vector<double>{8, 4, 0}));
  // Facing: min(.04 colour, 1) specular; at the edge: specular.
  EXPECT_NEAR(set_in(made.scene, "oak", "brdf_0_degree_refl").at(0), .04, 1e-6);
  EXPECT_NEAR(set_in(made.scene, "oak", "brdf_90_degree_refl").at(0), .5, 1e-6);
  EXPECT_EQ(set_in(made.scene, "oak", "refl_color"), (std::vector<double>{1, .5, .5}));
  EXPECT_TRUE(made.said("are ignored: dispersion"));
}

TEST(ModelMaterial, TexturesOfSpecularScaleTheReflection) {
  Quad quad;
  quad.more = std::string(kPictures) + R"("extensionsUsed":["KHR_materials_specular"],)";
  quad.material =
      R"("pbrMetallicRoughness":{"metallicFactor":0.25,"baseColorFactor":[0.8,0.4,0.2,1]},)"
      R"("extensions":{"KHR_materials_specular":{"specularColorFactor":[1,0.5,0.5],)"
      R"("specularTexture":{"index":0},"specularColorTexture":{"index":0}}})";
  const Imported made(quad.text());
  // base colour over (alpha of the one) (colour of the other) (factor)
  const scene::ShaderUse* mix = behind(made.scene, material_of(made.scene), "refl_color");
  ASSERT_TRUE(mix);
  EXPECT_EQ(argument(*mix, "weight_0")->value.numbers, std::vector<double>{.25});
  EXPECT_NEAR(argument(*mix, "color_0")->value.numbers.at(1), .4, 1e-6);
  const scene::ShaderUse* factor = behind(made.scene, *mix, "color_base");
  ASSERT_TRUE(factor);
  EXPECT_EQ(argument(*factor, "color_0")->value.numbers, (std::vector<double>{1, .5, .5}));
  const scene::ShaderUse* product = behind(made.scene, *factor, "color_base");
  ASSERT_TRUE(product);
  const scene::ShaderUse* strength = behind(made.scene, *product, "color_0");
  ASSERT_TRUE(strength);
  EXPECT_EQ(strength->type, "mib_color_alpha");
  EXPECT_TRUE(behind(made.scene, *product, "color_base"));
}

TEST(ModelMaterial, AnisotropyTextureTurnsAndWeakensTheLobe) {
  Quad quad;
  quad.more = std::string(kPictures) + R"("extensionsUsed":["KHR_materials_anisotropy"],)";
  quad.material = R"("pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0.4},)"
                  R"("extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":0.6,)"
                  R"("anisotropyRotation":1.57079633,"anisotropyTexture":{"index":0}}})";
  const Imported made(quad.text());
  const scene::ShaderUse* angle =
      behind(made.scene, material_of(made.scene), "anisotropy_rotation");
  ASSERT_TRUE(angle);
  EXPECT_EQ(angle->type, "oriel_direction_angle");
  EXPECT_NEAR(argument(*angle, "offset")->value.numbers.at(0), .25, 1e-6);
  for (const char* parameter : {"anisotropy", "refl_gloss"}) {
    const scene::ShaderUse* curve = behind(made.scene, material_of(made.scene), parameter);
    ASSERT_TRUE(curve) << parameter;
    const bool ratio = std::string(parameter) == "anisotropy";
    const Brushed none = brushed(.4f, 0), whole = brushed(.4f, .6f);
    EXPECT_NEAR(argument(*curve, "color_0")->value.numbers.at(0), ratio ? none.ratio : none.gloss,
                1e-6);
    EXPECT_NEAR(argument(*curve, "color_7")->value.numbers.at(0), ratio ? whole.ratio : whole.gloss,
                1e-6);
  }
}

TEST(ModelMaterial, IridescenceIsAFilmOverTheReflection) {
  Quad quad;
  quad.more = std::string(kPictures) + R"("extensionsUsed":["KHR_materials_iridescence"],)";
  quad.material =
      R"("pbrMetallicRoughness":{"metallicFactor":0},"extensions":{"KHR_materials_iridescence":)"
      R"({"iridescenceFactor":0.75,"iridescenceIor":1.4,"iridescenceThicknessMinimum":200,)"
      R"("iridescenceThicknessMaximum":500,"iridescenceThicknessTexture":{"index":0}}})";
  const Imported made(quad.text());
  const scene::ShaderUse* film = behind(made.scene, material_of(made.scene), "refl_color");
  ASSERT_TRUE(film);
  EXPECT_EQ(film->type, "oriel_thin_film");
  EXPECT_EQ(argument(*film, "factor")->value.numbers, std::vector<double>{.75});
  EXPECT_NEAR(argument(*film, "ior")->value.numbers.at(0), 1.4, 1e-6);
  EXPECT_NEAR(argument(*film, "reflectance")->value.numbers.at(0), .04, 1e-6);
  const scene::ShaderUse* thickness = behind(made.scene, *film, "thickness");
  ASSERT_TRUE(thickness);
  EXPECT_EQ(argument(*thickness, "color_0")->value.numbers.at(0), 200);
  EXPECT_EQ(argument(*thickness, "color_7")->value.numbers.at(0), 500);
  EXPECT_EQ(set_in(made.scene, "oak", "brdf_0_degree_refl"), std::vector<double>{1});
  EXPECT_FALSE(made.said("are ignored"));
}

TEST(ModelSheen, LayersOverTheMaterial) {
  Quad quad;
  quad.more = std::string(kPictures) + R"("extensionsUsed":["KHR_materials_sheen"],)";
  quad.material = R"("extensions":{"KHR_materials_sheen":{"sheenColorFactor":[0.5,0.25,1],)"
                  R"("sheenRoughnessFactor":0.3,"sheenColorTexture":{"index":0}}})";
  const Imported made(quad.text());
  const scene::ShaderUse& sheen = material_of(made.scene);
  EXPECT_EQ(sheen.type, "oriel_sheen");
  EXPECT_NEAR(argument(sheen, "roughness")->value.numbers.at(0), .3, 1e-6);
  const scene::ShaderUse* color = behind(made.scene, sheen, "color");
  ASSERT_TRUE(color);
  EXPECT_EQ(argument(*color, "color_0")->value.numbers, (std::vector<double>{.5, .25, 1}));
  const scene::ShaderUse* base = behind(made.scene, sheen, "base_material");
  ASSERT_TRUE(base);
  EXPECT_EQ(base->type, "mia_material_x");
  EXPECT_FALSE(made.said("are ignored"));
}

TEST(ModelMaterial, UnlitIsMatte) {
  Quad quad;
  quad.more = R"("extensionsUsed":["KHR_materials_unlit"],)";
  quad.material = R"("pbrMetallicRoughness":{"baseColorFactor":[0.2,0.4,0.6,1]},)"
                  R"("extensions":{"KHR_materials_unlit":{}})";
  const Imported made(quad.text());
  EXPECT_EQ(set_in(made.scene, "oak", "reflectivity"), std::vector<double>{0});
  EXPECT_NEAR(set_in(made.scene, "oak", "diffuse").at(1), .4, 1e-6);
  EXPECT_TRUE(made.said("unlit"));
}

TEST(ModelMaterial, ExtensionsThatAreNotReadAreNamed) {
  Quad quad;
  quad.material = R"("pbrMetallicRoughness":{})";
  quad.more = R"("extensionsUsed":["EXT_lights_image_based","KHR_texture_transform"],)";
  const Imported made(quad.text());
  EXPECT_TRUE(made.said("extensions that are not read: EXT_lights_image_based; their data"));
}

TEST(ModelMaterial, SpecularGlossinessIsNotMetallic) {
  Quad quad;
  quad.more = R"("extensionsUsed":["KHR_materials_pbrSpecularGlossiness"],)";
  quad.material =
      R"("extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.1,0.2,0.3,1],)"
      R"("specularFactor":[0.5,0.25,0.125],"glossinessFactor":0.7}})";
  const Imported made(quad.text());
  EXPECT_NEAR(set_in(made.scene, "oak", "diffuse").at(2), .3, 1e-6);
  EXPECT_EQ(set_in(made.scene, "oak", "diffuse_weight"), std::vector<double>{1});
  EXPECT_EQ(set_in(made.scene, "oak", "brdf_0_degree_refl"), std::vector<double>{.5});
  EXPECT_EQ(set_in(made.scene, "oak", "refl_color"), (std::vector<double>{1, .5, .25}));
  // alpha = (1 - glossiness)^2.
  const double gloss = set_in(made.scene, "oak", "refl_gloss").at(0);
  EXPECT_NEAR(bsdf::gloss_to_alpha(static_cast<float>(gloss)), .09, 1e-3);
}

TEST(ModelMaterial, TransmissionIsTextured) {
  Quad quad;
  quad.more = std::string(kPictures) + R"("extensionsUsed":["KHR_materials_transmission"],)";
  quad.material = R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":0.5,)"
                  R"("transmissionTexture":{"index":0}}})";
  const Imported made(quad.text());
  const scene::ShaderUse* map = behind(made.scene, material_of(made.scene), "transparency");
  ASSERT_TRUE(map);
  EXPECT_EQ(argument(*map, "color_7")->value.numbers, (std::vector<double>{.5, .5, .5}));
}

std::map<std::string, GltfExtras> extras_of_text(const char* text) {
  return gltf_extras(gltf::json::parse(text, nullptr, false));
}

TEST(GltfExtras, UnknownNamesAreIgnored) {
  const auto extras =
      extras_of_text(R"({"materials":[{"name":"a"},{"name":"b"},{"name":"a"},{},{"name":"a"}]})");
  ASSERT_EQ(extras.size(), 1u);
  EXPECT_EQ(extras.count("b"), 1u);
  EXPECT_EQ(extras_of_text(R"({"materials":[{}]})").count(""), 1u);
}

TEST(TextureSpace, TurnsWhereUOrVRunsInAnotherDirection) {
  for (const std::array<float, 6>& same :
       {std::array<float, 6>{1, 0, 0, 0, 1, 0}, {2, 0, -3, 0, .5f, 7}})
    EXPECT_FALSE((TextureSpace{0, same}.turns()));
  for (const std::array<float, 6>& other : {std::array<float, 6>{0, 1, 0, -1, 0, 0},
                                            {-1, 0, 1, 0, 1, 0},
                                            {1, 0, 0, 0, -1, 1},
                                            {0, 0, 0, 0, 1, 0},
                                            {1, 0, 0, 0, 0, 0},
                                            {1, .5f, 0, 0, 1, 0},
                                            {1, 0, 0, .5f, 1, 0}})
    EXPECT_TRUE((TextureSpace{0, other}.turns()));
}

TEST(GltfExtras, InvalidValuesAreIgnored) {
  for (
      const char* text :
      {"", "glTF", "[", "null", "[1]", R"({"materials":3})", R"({"materials":[3,null,"x"]})",
       R"({"materials":[{"name":3,"normalTexture":{"texCoord":-1,"extensions":7}}]})",
       R"({"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"texCoord":1e30,"extensions":)"
       R"({"KHR_texture_transform":{"offset":["a"],"scale":3,"rotation":null}}}}}]})"})
    for (const auto& [name, extras] : extras_of_text(text))
      for (const auto& [use, space] : extras.spaces) EXPECT_EQ(space, TextureSpace()) << text;
}

}  // namespace import_surface_test
}  // namespace oriel::models
