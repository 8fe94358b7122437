// SPDX-License-Identifier: Apache-2.0
// Renders of imported models: vertex colours and brushed metal.
#include <fmt/format.h>

#include "mi/writer.h"
#include "models/daylight.h"
#include "models/testing/gltf_file.h"
#include "support/probe.h"

namespace oriel {
namespace colors_test {

using models::testing::GltfFile;
using models::testing::json;
using models::testing::Made;
using testing::Probe;

const Vec3 kUp(0, 0, 1), kMiddle(.25f, .25f, 0);
/// Of the triangle's corners at kMiddle.
constexpr float kShares[] = {.5f, .25f, .25f};

/// Of pi lux, from the light that the quaternion turns z to.
void add_sun(GltfFile& file, const json& turn) {
  file.root["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_specular",
                                 "KHR_materials_anisotropy"};
  file.root["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "directional"}, {"name", "sun"}, {"intensity", kPi}}});
  file.root["nodes"].push_back({{"name", "sun"},
                                {"rotation", turn},
                                {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  file.root["scenes"][0]["nodes"].push_back(1);
}

GltfFile triangle() {
  GltfFile file;
  file.add_triangle();
  file.primitive()["attributes"]["NORMAL"] =
      file.add<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, models::testing::kFloat, "VEC3", 3);
  return file;
}

Rgb light_at_middle(const std::string& content, const char* name = "m.gltf") {
  Made made;
  made.import(content, name);
  EXPECT_TRUE(made.scene);
  models::add_camera(*made.scene, {});
  const std::string path = (made.folder.path() / "m.mi").string();
  EXPECT_TRUE(mi::write_scene(*made.scene, path, made.diagnostics));
  for (const Diagnostic& d : made.diagnostics.all()) ADD_FAILURE() << made.diagnostics.format(d);
  std::ifstream read(path);
  const std::string text{std::istreambuf_iterator<char>(read), {}};
  return Probe(text).direct_only().ray(kMiddle + kUp, -kUp, 1024).mean;
}

// Matte, under a sun of pi lux: the radiance is the colour.
json matte(float base) {
  return {{"name", "paint"},
          {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}},
          {"pbrMetallicRoughness",
           {{"metallicFactor", 0}, {"baseColorFactor", {base, base, base, 1}}}}};
}

TEST(ColoursOfModels, MultiplyTheBaseColourAndRunStraight) {
  for (const bool bytes : {false, true}) {
    GltfFile file = triangle();
    add_sun(file, {0, 0, 0, 1});
    file.material() = matte(.5f);
    file.primitive()["attributes"]["COLOR_0"] =
        bytes ? file.add<std::uint8_t>({255, 0, 51, 0, 255, 51, 0, 0, 51},
                                       models::testing::kUnsignedByte, "VEC3", 3, true)
              : file.add<float>({1, 0, .2f, 1, 0, 1, .2f, 1, 0, 0, .2f, 1}, models::testing::kFloat,
                                "VEC4", 4);
    const Rgb light = light_at_middle(file.text());
    const Vec3 wanted = Vec3(kShares[0], kShares[1], .2f) * .5f;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(light[k], wanted[k], 1e-3f) << bytes << k;
  }
}

TEST(ColoursOfModels, AlphaCoversWhereTheMaterialBlends) {
  for (const bool blends : {false, true}) {
    GltfFile file = triangle();
    add_sun(file, {0, 0, 0, 1});
    file.material() = matte(1);
    if (blends) file.material()["alphaMode"] = "BLEND";
    file.primitive()["attributes"]["COLOR_0"] = file.add<std::uint16_t>(
        {65535, 65535, 65535, 0, 65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535},
        models::testing::kUnsignedShort, "VEC4", 4, true);
    const float covered = blends ? kShares[1] + kShares[2] : 1;
    EXPECT_NEAR(light_at_middle(file.text())[0], covered, blends ? .05f : 1e-3f) << blends;
  }
}

/// Light reflected upward by a brushed metal, from a sun at 45 degrees toward x or y.
float shine(bool along_x, float turn) {
  GltfFile file = triangle();
  file.primitive()["attributes"]["TEXCOORD_0"] =
      file.add<float>({0, 1, 1, 1, 0, 0}, models::testing::kFloat, "VEC2", 2);
  constexpr float kHalfSine = .382683432f, kHalfCosine = .923879533f;
  add_sun(file, along_x ? json{0, kHalfSine, 0, kHalfCosine} : json{-kHalfSine, 0, 0, kHalfCosine});
  file.material() = {
      {"name", "paint"},
      {"pbrMetallicRoughness", {{"metallicFactor", 1}, {"roughnessFactor", .4}}},
      {"extensions",
       {{"KHR_materials_anisotropy", {{"anisotropyStrength", .6}, {"anisotropyRotation", turn}}}}}};
  return light_at_middle(file.text())[0];
}

/// What GGX sends to the normal of light from a direction, times its cosine: its density of normals
/// and Smith's masking over 4.
double reflected(const Vec3& light, double ax, double ay) {
  const Vec3 h = normalize(light + kUp);
  const double slopes = std::pow(h.x / ax, 2) + std::pow(h.y / ay, 2) + std::pow(h.z, 2);
  const double density = 1 / (kPi * ax * ay * slopes * slopes);
  const double tangent2 =
      (std::pow(ax * light.x, 2) + std::pow(ay * light.y, 2)) / std::pow(light.z, 2);
  return density / (1 + (std::sqrt(1 + tangent2) - 1) / 2) / 4;
}

/// What of white light all around comes back at once; Oriel's lobes give back the rest as well.
double albedo(double ax, double ay) {
  constexpr int kSteps = 400;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k) {
      const double t = (i + .5) / kSteps * kPi / 2, p = (k + .5) / kSteps * 2 * kPi;
      const Vec3 light(static_cast<float>(std::sin(t) * std::cos(p)),
                       static_cast<float>(std::sin(t) * std::sin(p)),
                       static_cast<float>(std::cos(t)));
      sum += reflected(light, ax, ay) * std::sin(t);
    }
  return sum * kPi * kPi / kSteps / kSteps;
}

TEST(BrushedMetalOfModels, HighlightsStretchAlongTheTangent) {
  // Alpha across is .4^2, along it mix(.16, 1, .6^2).
  const double across = .16, along = .16 + .84 * .36;
  const Vec3 toward_x = normalize(Vec3(1, 0, 1)), toward_y = normalize(Vec3(0, 1, 1));
  const double all = albedo(along, across);
  const double with = reflected(toward_x, along, across) * kPi / all;
  const double against = reflected(toward_y, along, across) * kPi / all;
  ASSERT_GT(with, 10 * against);
  EXPECT_NEAR(shine(true, 0), with, .02 * with);
  EXPECT_NEAR(shine(false, 0), against, .02 * against);
  // A quarter turn: along the bitangent.
  EXPECT_NEAR(shine(true, kPi / 2), against, .02 * against);
  EXPECT_NEAR(shine(false, kPi / 2), with, .02 * with);
}

}  // namespace colors_test
}  // namespace oriel
