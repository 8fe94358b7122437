// SPDX-License-Identifier: Apache-2.0
// Renders of imported models: normal maps and clear coats compared with closed forms.
#include <fmt/format.h>

#include "bsdf/sheen.h"
#include "bsdf/terminator.h"
#include "mi/writer.h"
#include "models/daylight.h"
#include "models/testing/model_file.h"
#include "support/probe.h"

namespace oriel {
namespace imported_test {

using models::testing::Folder;
using models::testing::Quad;
using testing::expect_exact;
using testing::Measured;
using testing::Probe;

const Vec3 kUp(0, 0, 1);
/// Positions of a red, a green and a blue light, and the quaternions that rotate z to them.
const Vec3 kSuns[] = {Vec3(0, 0, 1), Vec3(.6f, 0, .8f), Vec3(0, .6f, .8f)};
constexpr const char* kTurns[] = {"0,0,0,1", "0,0.316227766,0,0.948683298",
                                  "-0.316227766,0,0,0.948683298"};
/// Bytes of the picture: turned toward +x and, less, toward +y (up).
constexpr unsigned char kTexel[3] = {204, 153, 230};

Vec3 texel() {
  return {2 * kTexel[0] / 255.f - 1, 2 * kTexel[1] / 255.f - 1, 2 * kTexel[2] / 255.f - 1};
}

/// The model as a scene that a probe can look at: written, and read again.
std::string as_scene(const Quad& quad, const Folder& folder, const char* environment = "") {
  folder.write("n.ppm", "P6 1 1 255\n" + std::string(reinterpret_cast<const char*>(kTexel), 3));
  Diagnostics diagnostics;
  auto scene = models::import_model(folder.write("m.gltf", quad.text()),
                                    {folder.path() / "t", folder.path()}, diagnostics);
  EXPECT_TRUE(scene);
  models::add_camera(*scene, {});
  if (*environment) {
    scene::ShaderUse use;
    use.type = environment;
    for (scene::Element& e : scene->elements())
      if (auto* camera = std::get_if<scene::Camera>(&e)) camera->environment = {use};
  }
  const std::string file = (folder.path() / "m.mi").string();
  EXPECT_TRUE(mi::write_scene(*scene, file, diagnostics));
  for (const Diagnostic& d : diagnostics.all()) ADD_FAILURE() << diagnostics.format(d);
  std::ifstream read(file);
  std::string text{std::istreambuf_iterator<char>(read), {}};
  // The probe's text has no folder.
  const std::string from = "\"n.ppm\"";
  if (const auto at = text.find(from); at != std::string::npos)
    text.replace(at, from.size(), fmt::format("\"{}\"", (folder.path() / "n.ppm").string()));
  return text;
}

/// What the three lights, of pi lux each, bring to the middle of a white surface without
/// reflections that has the picture as its normal map; `place` is that middle.
Rgb light_on(Quad quad, const Vec3& place, float scale = 1, const Vec3& from = kUp) {
  quad.material = fmt::format(
      R"("doubleSided":true,"pbrMetallicRoughness":{{"metallicFactor":0}},"normalTexture":{{)"
      R"("index":0,"scale":{}}},"extensions":{{"KHR_materials_specular":{{"specularFactor":0}}}})",
      scale);
  std::string lights;
  for (int i = 0; i < 3; ++i) {
    lights += fmt::format(
        R"({}{{"type":"directional","name":"sun{}","intensity":3.14159265,"color":[{},{},{}]}})",
        i ? "," : "", i, i == 0 ? 1 : 0, i == 1 ? 1 : 0, i == 2 ? 1 : 0);
    quad.nodes +=
        fmt::format(R"(,{{"name":"sun{0}","rotation":[{1}],"extensions":{{"KHR_lights_punctual":{{)"
                    R"("light":{0}}}}}}})",
                    i, kTurns[i]);
    quad.scene += fmt::format(",{}", i + 1);
  }
  quad.more = R"("extensionsUsed":["KHR_lights_punctual","KHR_materials_specular"],"textures":)"
              R"([{"source":0}],"images":[{"uri":"n.ppm"}],)"
              R"("extensions":{"KHR_lights_punctual":{"lights":[)" +
              lights + "]}},";
  const Folder folder;
  return Probe(as_scene(quad, folder)).direct_only().ray(place + from, -from, 64).mean;
}

/// The same of a normal in the world, not yet of unit length.
Rgb light_for(const Vec3& n) {
  Rgb light;
  for (int i = 0; i < 3; ++i)
    light[i] = std::max(0.0f, dot(kSuns[i], normalize(n))) *
               bsdf::soft_terminator(kUp, normalize(n), kSuns[i]);
  return light;
}

void expect_light(const char* what, const Rgb& light, const Vec3& n) {
  const Rgb wanted = light_for(n);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(light[k], wanted[k], 2e-4f) << what << ' ' << k;
}

TEST(NormalMapOfModels, LightIsTheCosineOfTheTexelsNormal) {
  const Vec3 n = texel(), middle(.5f, .5f, 0);
  Quad plain;
  expect_light("plain", light_on(plain, middle), n);
  expect_light("scale", light_on(plain, middle, .5f), Vec3(n.x / 2, n.y / 2, n.z));
  // The picture lies mirrored: u runs against x.
  Quad mirrored;
  mirrored.uv0 = {1, 1, 0, 1, 0, 0, 1, 0};
  expect_light("mirrored", light_on(mirrored, middle), Vec3(-n.x, n.y, n.z));
  Quad upside_down;
  upside_down.uv0 = {0, 0, 1, 0, 1, 1, 0, 1};
  expect_light("upside down", light_on(upside_down, middle), Vec3(n.x, -n.y, n.z));
  // An instance that is turned by 90 degrees about z and stretched threefold along y, which was x.
  Quad turned;
  turned.node = R"(,"rotation":[0,0,0.707106781,0.707106781],"scale":[3,1,1])";
  expect_light("turned", light_on(turned, Vec3(-.5f, 1.5f, 0)), Vec3(-n.y, n.x, n.z));
  // Tangents in the file replace those of the coordinates: u along y, v along x (handedness -1).
  Quad tangents;
  tangents.tangents = {0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1};
  expect_light("tangents", light_on(tangents, middle), Vec3(n.y, n.x, n.z));
}

TEST(NormalMapOfModels, TheBackHasTheSameBumpFromBehind) {
  // Turned about y: what was x runs against it, and the back is seen. Its normal is -n of the
  // front.
  Quad behind;
  behind.node = R"(,"rotation":[0,1,0,0])";
  const Vec3 n = texel();
  expect_light("behind", light_on(behind, Vec3(-.5f, .5f, 0)), Vec3(n.x, -n.y, n.z));
}

/// Reflection of the coat at an angle.
float coat_at(float degrees, float coat) {
  return coat * (.04f + .96f * std::pow(1 - std::cos(degrees * kPi / 180), 5.0f));
}

std::string coated_material(const std::string& base, float coat, float roughness) {
  return fmt::format(
      R"({},"extensions":{{"KHR_materials_specular":{{"specularFactor":0}},)"
      R"("KHR_materials_clearcoat":{{"clearcoatFactor":{},"clearcoatRoughnessFactor":{}}}}})",
      base, coat, roughness);
}

std::string matte(float albedo) {
  return fmt::format(
      R"("pbrMetallicRoughness":{{"metallicFactor":0,"baseColorFactor":[{0},{0},{0},1]}})", albedo);
}

/// Its middle in the origin, under a white sky.
std::string coated(const Folder& folder, const std::string& base, float coat, float roughness) {
  Quad quad;
  quad.node = R"(,"translation":[-0.5,-0.5,0])";
  quad.more = R"("extensionsUsed":["KHR_materials_clearcoat"],)";
  quad.material = coated_material(base, coat, roughness);
  return as_scene(quad, folder, "test_white");
}

/// "test_white": light of 1 from everywhere.
constexpr ShaderSpec kTestWhite = {
    .name = "test_white",
    .library = "test",
    .apply = kApplyEnvironment,
    .value = [](const Call&, void* result) { *static_cast<Rgba*>(result) = Rgba(1); },
};

const Registry& registry() {
  static const Registry all([] {
    std::vector<const ShaderSpec*> specs = builtin_shaders().all();
    specs.push_back(&kTestWhite);
    return specs;
  }());
  return all;
}

TEST(ClearCoatOfModels, SkyAndBaseAreSharedByFresnel) {
  for (const float coat : {1.f, .5f})
    for (const float degrees : {0.f, 60.f}) {
      const float k = coat_at(degrees, coat);
      for (const float albedo : {0.f, .5f, 1.f}) {
        const Folder folder;
        const Probe probe(coated(folder, matte(albedo), coat, 0), registry());
        expect_exact(fmt::format("coat {}, base {}, {} degrees", coat, albedo, degrees),
                     probe.onto(Vec3(0), kUp, degrees, 16384), (1 - k) * albedo + k, .01f);
      }
    }
}

TEST(ClearCoatOfModels, WhiteUnderWhiteNeverGainsLight) {
  for (const float roughness : {0.f, .4f, 1.f})
    for (const char* base :
         {R"("pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.5})",
          R"("pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0.5})"})
      for (const float degrees : {0.f, 60.f}) {
        const Folder folder;
        const Measured m = Probe(coated(folder, base, 1, roughness), registry())
                               .onto(Vec3(0), kUp, degrees, 16384);
        // The tables of albedos, of coat and base, are within a thousandth each.
        EXPECT_LE(m.mean.x, 1 + 4 * m.error.x + 2e-3f) << roughness << base << degrees;
        EXPECT_GT(m.mean.x, .9f) << roughness << base << degrees;
      }
}

/// Share of light from the normal that GGX of roughness alpha reflects once, by quadrature.
double albedo_from_normal(double alpha) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double a = (i + .5) / kSteps * kPi / 2, c = std::cos(a), h = std::cos(a / 2);
    const double d = alpha * alpha / (kPi * std::pow(h * h * (alpha * alpha - 1) + 1, 2));
    const double lambda = (std::sqrt(1 + alpha * alpha * (1 / (c * c) - 1)) - 1) / 2;
    sum += d / (1 + lambda) / 4 * std::sin(a) * 2 * kPi;
  }
  return sum * kPi / 2 / kSteps;
}

TEST(ClearCoatOfModels, LightsShineInIt) {
  // Straight from above, and seen from there: pi lux x F0 x GGX's D(0) / 4 with D(0) = 1 / (pi
  // alpha^2) and alpha the roughness squared. Oriel's lobes give back what is scattered more often.
  const float roughness = .5f, alpha = roughness * roughness;
  Quad quad;
  quad.scene = "0,1";
  quad.nodes = R"(,{"name":"sun","extensions":{"KHR_lights_punctual":{"light":0}}})";
  quad.more = R"("extensionsUsed":["KHR_lights_punctual","KHR_materials_clearcoat"],"extensions":)"
              R"({"KHR_lights_punctual":{"lights":[{"type":"directional","name":"sun","intensity":)"
              R"(3.14159265}]}},)";
  quad.material = coated_material(matte(0), 1, roughness);
  const Folder folder;
  const Measured m = Probe(as_scene(quad, folder)).direct_only().ray(Vec3(.5f, .5f, 1), -kUp, 64);
  const double once = .04 / (4 * alpha * alpha);
  EXPECT_NEAR(m.mean.x, once / albedo_from_normal(alpha), .01 * once);
}

/// The middle of a model with sheen in the origin, under a white sky.
Measured sheen_in_sky(const std::string& base, float color, float roughness, float degrees) {
  Quad quad;
  quad.node = R"(,"translation":[-0.5,-0.5,0])";
  quad.more = R"("extensionsUsed":["KHR_materials_sheen","KHR_materials_specular"],)";
  quad.material = fmt::format(
      R"({},"extensions":{{"KHR_materials_specular":{{"specularFactor":0}},"KHR_materials_sheen":)"
      R"({{"sheenColorFactor":[{},0,0],"sheenRoughnessFactor":{}}}}})",
      base, color, roughness);
  const Folder folder;
  return Probe(as_scene(quad, folder, "test_white"), registry()).onto(Vec3(0), kUp, degrees, 16384);
}

TEST(SheenOfModels, SkyAndBaseAreSharedByItsAlbedo) {
  for (const float roughness : {.3f, .8f})
    for (const float degrees : {0.f, 45.f, 70.f}) {
      const float albedo = bsdf::sheen_albedo(roughness * roughness, std::cos(degrees * kPi / 180));
      for (const float color : {1.f, .5f})
        for (const float base : {0.f, .5f, 1.f}) {
          const Measured m = sheen_in_sky(matte(base), color, roughness, degrees);
          const float below = (1 - color * albedo) * base;
          EXPECT_NEAR(m.mean.x, below + color * albedo, .012f)
              << roughness << ' ' << degrees << ' ' << color << ' ' << base;
          EXPECT_NEAR(m.mean.y, below, .012f) << "green gets no sheen";
        }
    }
}

TEST(SheenOfModels, NeverGainsLight) {
  for (const float roughness : {0.f, .2f, 1.f})
    for (const float degrees : {60.f, 85.f, 88.f}) {
      const Measured m = sheen_in_sky(matte(1), 1, roughness, degrees);
      EXPECT_LE(m.mean.x, 1.03f + 4 * m.error.x) << roughness << ' ' << degrees;
    }
}

}  // namespace imported_test
}  // namespace oriel
