// SPDX-License-Identifier: Apache-2.0
// oriel explain.
#include <cmath>
#include <nlohmann/json.hpp>

#include "image/exr.h"
#include "support/program.h"

namespace oriel {
namespace explain_test {

class ExplainProgram : public ProgramTest {};

/// Sums all light that the surfaces brought.
std::array<double, 3> sum_of(const nlohmann::json& surfaces) {
  std::array<double, 3> sum{};
  for (const auto& surface : surfaces)
    for (const auto& light : surface["light"])
      for (std::size_t k = 0; k < 3; ++k) sum[k] += light["light"][k].get<double>();
  return sum;
}

TEST_F(ExplainProgram, SharesSumToThePixelOfTheRenderedFile) {
  write("scene.mi", small_scene());
  const RunResult render =
      run({"render", "scene.mi", "-o", "out.exr", "--samples", "32", "--quiet"});
  ASSERT_EQ(render.exit_code, 0) << render.err;
  const Image picture = read_exr_image(file("out.exr"));
  for (const auto& [x, y] : {std::pair(20, 28), std::pair(30, 8)}) {
    const RunResult r =
        run({"explain", "scene.mi", "--pixel", std::to_string(x) + "," + std::to_string(y),
             "--samples", "32", "--json"});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    const auto e = nlohmann::json::parse(r.out, nullptr, false);
    const auto sum = sum_of(e["surfaces"]);
    for (std::size_t k = 0; k < 3; ++k) {
      const float rendered = picture.at(x, y)[k];
      // Files hold half floats.
      EXPECT_NEAR(e["colour"][k].get<double>(), rendered, 1e-3 * rendered);
      EXPECT_NEAR(sum[k], rendered, 1e-3 * rendered);
    }
    EXPECT_EQ(e["surfaces"][1]["instance"], "floor_inst");
    EXPECT_EQ(e["surfaces"][1]["material"], "grey");
    EXPECT_EQ(e["surfaces"][1]["segment"], "eye");
    EXPECT_EQ(e["surfaces"][1]["lobes"][0]["weight"].size(), 3u);
    EXPECT_EQ(e["surfaces"][1]["lights"][0]["light"], "lamp_inst");
  }
}

TEST_F(ExplainProgram, WordsNameSurfaceMaterialAndLight) {
  write("scene.mi", small_scene());
  const RunResult r = run({"explain", "scene.mi", "--pixel", "20,28", "--samples", "16", "-q"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  for (const char* words : {"pixel 20,28:", "The camera sees floor_inst.", "grey (mia_material_x)",
                            "direct light of lamp_inst", "diffuse 0.",
                            "Light by layer: diffuse_result", "No tone mapper"})
    EXPECT_NE(r.out.find(words), std::string::npos) << words << " in\n" << r.out;
}

TEST_F(ExplainProgram, InvalidPixelsAndMissingScenesAreUserErrors) {
  write("scene.mi", small_scene());
  EXPECT_EQ(run({"explain", "scene.mi", "--pixel", "48,0"}).exit_code, 1);
  EXPECT_EQ(run({"explain", "scene.mi", "--pixel", "here"}).exit_code, 2);
  EXPECT_EQ(run({"explain", "scene.mi"}).exit_code, 2);
  EXPECT_EQ(run({"explain", "missing.mi", "--pixel", "1,1"}).exit_code, 1);
}

}  // namespace explain_test
}  // namespace oriel
