// SPDX-License-Identifier: Apache-2.0
// Indirect light of the sun through a glass pane of a model: every method against a closed form.
#include "color/luminance.h"
#include "pane_models.h"
#include "prepare/testing/prepared_scene.h"
#include "render/session.h"

namespace oriel {
namespace pane_methods_test {

using models::testing::Made;
using namespace pane_models;

constexpr float kAlbedo = .5f;
/// Of two unit squares that share an edge at a right angle (Howell, "Radiation configuration
/// factors", C-14).
constexpr double kFormFactor = .2000437;

/// The pane, 1 x 1 m, 10 m above a floor of its size; a wall at the floor's far edge, which an
/// orthographic camera sees from the front.
GltfFile room(const json& material, float thickness) {
  GltfFile file = gltf_pane(material, thickness);
  file.node()["matrix"] = {.1, 0, 0, 0, 0, 0, -.1, 0, 0, .1, 0, 0, .5, 10, -.5, 1};
  const std::size_t square =
      file.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, models::testing::kFloat, "VEC3", 3);
  const std::size_t corners =
      file.add<std::uint16_t>({0, 1, 3, 0, 3, 2}, models::testing::kUnsignedShort, "SCALAR", 1);
  file.root["meshes"].push_back(
      {{"name", "square"},
       {"primitives",
        {{{"attributes", {{"POSITION", square}}}, {"indices", corners}, {"material", 1}}}}});
  file.root["materials"].push_back(
      {{"name", "matte"},
       {"pbrMetallicRoughness",
        {{"metallicFactor", 0}, {"baseColorFactor", {kAlbedo, kAlbedo, kAlbedo, 1}}}},
       {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}});
  file.root["nodes"].push_back(
      {{"mesh", 1}, {"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}}});
  file.root["nodes"].push_back({{"mesh", 1}, {"translation", {0, 0, -1}}});
  file.root["cameras"] = {
      {{"type", "orthographic"},
       {"orthographic", {{"xmag", .5}, {"ymag", .5}, {"znear", .1}, {"zfar", 100}}}}};
  file.root["nodes"].push_back({{"camera", 0}, {"name", "eye"}, {"translation", {.5, .5, 5}}});
  for (int node = 1; node < 4; ++node) file.root["scenes"][0]["nodes"].push_back(node);
  return file;
}

/// Mean illuminance of the wall.
double wall_lux(const json& material, float thickness, const char* method) {
  Made made;
  made.import(room(material, thickness).text());
  if (!made.scene) return -1;
  add_sun(*made.scene, Vec3(0, 1, 0));
  std::string text = text_of(made);
  const std::string path = "\"indirect\" \"path\"";
  const auto at = text.find(path);
  EXPECT_NE(at, text.npos);
  if (at == text.npos) return -1;
  // A small radius: estimates lose what lies beyond the wall's edges.
  text.replace(
      at, path.size(),
      fmt::format("finalgather on finalgather accuracy 600 globillum on globillum accuracy "
                  "4000 .015 photon trace depth 8 8 12 \"indirect\" \"{}\"",
                  method));
  const testing::PreparedScene prepared(text, builtin_shaders(), {.width = 24, .height = 24});
  if (!prepared.world) {
    ADD_FAILURE() << prepared.messages();
    return -1;
  }
  RenderSession session(*prepared.world, {.budget = {.samples = 64}, .seed = 1});
  session.run();
  const Film& film = session.film();
  double sum = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) sum += luminance(rgb(film.pixel(x, y).beauty));
  return sum / film.width() / film.height() * kPi / kAlbedo;
}

// Light of the floor, which the sun reaches through the pane alone; the wall sends a little of it
// back.
// acceptance: M1
TEST(ImportedPanes, EveryMethodGivesTheSameIndirectLight) {
  const struct {
    const char* what;
    json material;
    float thickness;
    double through;
  } kPanes[] = {
      {"thin", transmitting(1), 0, kClear},
      {"solid", transmitting(1, {{"KHR_materials_volume", {{"thicknessFactor", .02}}}}), .2f,
       kClear * kClear},
      {"blended", covering("BLEND", .1), 0, .9},
  };
  const double back = kAlbedo * kFormFactor;
  for (const auto& pane : kPanes)
    for (const char* method : {"path", "fg", "photons", "fg+photons"}) {
      const double lux = pane.through * kSunLux * back / (1 - back * back);
      EXPECT_NEAR(wall_lux(pane.material, pane.thickness, method), lux, kTolerance * lux)
          << pane.what << ' ' << method;
    }
}

}  // namespace pane_methods_test
}  // namespace oriel
