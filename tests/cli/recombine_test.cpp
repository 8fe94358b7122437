// SPDX-License-Identifier: Apache-2.0
// oriel recombine.
#include <limits>
#include <nlohmann/json.hpp>

#include "image/exr.h"
#include "image/files.h"
#include "support/output_layers.h"
#include "support/program.h"

namespace oriel {
namespace recombine_test {

class RecombineProgram : public ProgramTest {
 protected:
  std::vector<Layer> layers = output_layers(24, 10);

  Layer& layer(const std::string& name) {
    for (Layer& l : layers)
      if (l.name == name) return l;
    throw std::runtime_error("no layer " + name);
  }
  RunResult recombined(std::vector<std::string> more = {}, const ExrOptions& options = {}) {
    write_exr(file("in.exr"), layers, options);
    more.insert(more.begin(), {"recombine", "in.exr"});
    return run(more);
  }
};

TEST_F(RecombineProgram, OutputsReproduceTheImage) {
  const RunResult r = recombined();
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.out.find("simple   largest relative difference"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("complex  largest relative difference"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("0 of 240 pixels above 0.0001"), std::string::npos) << r.out;
}

TEST_F(RecombineProgram, OneWrongPixelIsFoundWithBothValues) {
  const float before = layer("").image.at(17, 3)[1];
  layer("spec_result").image.at(17, 3)[1] += before;
  const RunResult r = recombined({"--json"});
  EXPECT_EQ(r.exit_code, 1);
  const auto json = nlohmann::json::parse(r.out);
  EXPECT_FALSE(json["agrees"]);
  EXPECT_NEAR(json["simple"]["largest"], 1, 1e-5);
  EXPECT_EQ(json["simple"]["x"], 17);
  EXPECT_EQ(json["simple"]["y"], 3);
  EXPECT_EQ(json["simple"]["channel"], "G");
  EXPECT_FLOAT_EQ(json["simple"]["beauty"], before);
  EXPECT_FLOAT_EQ(json["simple"]["rebuilt"], 2 * before);
  EXPECT_EQ(json["simple"]["pixels_above"], 1);
  EXPECT_EQ(json["complex"]["pixels_above"], 0);

  const RunResult text = recombined();
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_NE(text.out.find("at 17, 3 G"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("1 of 240 pixels above"), std::string::npos) << text.out;
  EXPECT_EQ(recombined({"--threshold", "2"}).exit_code, 0);
}

TEST_F(RecombineProgram, MissingLayersAreNamedWithAHint) {
  std::erase_if(layers,
                [](const Layer& l) { return l.name == "diffuse_raw" || l.name == "other"; });
  const RunResult r = recombined();
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_EQ(r.error_lines(), 1) << r.err;
  EXPECT_NE(r.err.find("diffuse_raw is missing, other is missing"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("--layers outputs"), std::string::npos) << r.err;
}

TEST_F(RecombineProgram, LayersOfAnotherShapeAreRefused) {
  layer("refl_level") = {"refl_level", {""}, Image(24, 10, 1)};
  const RunResult r = recombined();
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_EQ(r.error_lines(), 1) << r.err;
  EXPECT_NE(r.err.find("refl_level has 1 channel instead of 3"), std::string::npos) << r.err;
}

TEST_F(RecombineProgram, NanFails) {
  layer("refr_raw").image.at(2, 9)[0] = std::numeric_limits<float>::quiet_NaN();
  const RunResult r = recombined({"--threshold", "1e30"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.out.find("difference inf at 2, 9 R"), std::string::npos) << r.out;
  const RunResult json = recombined({"--json"});
  EXPECT_TRUE(nlohmann::json::parse(json.out)["complex"]["largest"].is_null()) << json.out;
}

TEST_F(RecombineProgram, HalfFilesHaveTheThresholdOfTheirPrecision) {
  const RunResult r = recombined({}, {.precision = ExrPrecision::Half});
  EXPECT_EQ(r.exit_code, 0) << r.out;
  EXPECT_NE(r.out.find("0 of 240 pixels above 0.003"), std::string::npos) << r.out;
  EXPECT_EQ(recombined({"--threshold", "1e-4"}, {.precision = ExrPrecision::Half}).exit_code, 1);
  layer("spec_result").image.at(17, 3)[1] += .1f + layer("").image.at(17, 3)[1];
  const RunResult wrong = recombined({}, {.precision = ExrPrecision::Half});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_NE(wrong.out.find("--exr float"), std::string::npos) << wrong.out;
}

TEST_F(RecombineProgram, ThreePicturesAreWritten) {
  layer("add_result").image.at(5, 5)[2] += 1;
  const RunResult r = recombined({"-o", "out.exr"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  const ExrFile out = read_exr(file("out.exr"));
  for (const char* name : {"simple", "complex", "difference"}) {
    const Layer* found = find_layer(out.layers, name);
    ASSERT_NE(found, nullptr) << name;
    EXPECT_EQ(found->channel_names, (std::vector<std::string>{"R", "G", "B"}));
  }
  const Image& difference = find_layer(out.layers, "difference")->image;
  EXPECT_NEAR(difference.at(5, 5)[2], 1 / layer("").image.at(5, 5)[2], 1e-5);
  EXPECT_LT(difference.at(5, 6)[2], 1e-5f);
}

TEST_F(RecombineProgram, WrongUseIsOneLine) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"recombine"},
                                                    {"recombine", "in.exr", "-o", "out.png"},
                                                    {"recombine", "in.exr", "--threshold", "-1"}}) {
    const RunResult r = run(arguments);
    EXPECT_EQ(r.exit_code, 2);
    EXPECT_EQ(r.error_lines(), 1) << r.err;
  }
  const RunResult missing = run({"recombine", "in.exr"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("there is no such file"), std::string::npos) << missing.err;
}

TEST_F(RecombineProgram, RenderIsReproduced) {
  write("scene.mi", small_scene());
  ASSERT_EQ(run({"render", "scene.mi", "-o", "in.exr", "--layers", "outputs", "--samples", "8"})
                .exit_code,
            0);
  const RunResult r = run({"recombine", "in.exr"});
  EXPECT_EQ(r.exit_code, 0) << r.out << r.err;
}

// acceptance: U6
TEST_F(RecombineProgram, FrameBuffersHoldTheLayersOfTheirNames) {
  write("scene.mi", small_scene("",
                                "framebuffer \"fb_diffuse_result\" datatype \"rgb_fp\" filename "
                                "\"diffuse.exr\" filetype \"exr\" "
                                "framebuffer \"spec_raw\" filename \"two.exr\" "
                                "framebuffer \"opacity\" filename \"two.exr\" "));
  ASSERT_EQ(run({"render", "scene.mi", "--samples", "8"}).exit_code, 0);
  ASSERT_EQ(run({"render", "scene.mi", "-o", "in.exr", "--layers", "outputs", "--samples", "8",
                 "--exr", "float"})
                .exit_code,
            0);
  const ExrFile all = read_exr(file("in.exr"));
  const ExrFile two = read_exr(file("two.exr"));
  EXPECT_EQ(read_image(file("diffuse.exr")).pixels,
            find_layer(all.layers, "diffuse_result")->image.pixels);
  for (const char* name : {"spec_raw", "opacity", ""}) {
    ASSERT_NE(find_layer(two.layers, name), nullptr) << name;
    EXPECT_EQ(find_layer(two.layers, name)->image.pixels,
              find_layer(all.layers, name)->image.pixels)
        << name;
  }
}

}  // namespace recombine_test
}  // namespace oriel
