// SPDX-License-Identifier: Apache-2.0
// Material outputs as layers of EXR files, and messages about missing ones.
#include "image/exr.h"
#include "output/output_names.h"
#include "support/program.h"

namespace oriel {
namespace outputs_test {

class OutputsProgram : public ProgramTest {
 protected:
  /// The small scene; `material` is a further parameter of its only material.
  void write_scene(const std::string& parameter = {}, const std::string& options = {}) {
    std::string text = small_scene(options);
    const std::string last = "\"refl_gloss\" .6";
    text.insert(text.find(last) + last.size(), parameter.empty() ? "" : ", " + parameter);
    write("scene.mi", text);
  }
  RunResult render(const std::string& layers) {
    return run({"render", "scene.mi", "-o", "a.exr", "--layers", layers, "--samples", "4"});
  }
};

// acceptance: U1
TEST_F(OutputsProgram, AllOfThemAreLayersOfTheFile) {
  write_scene();
  const RunResult r = render("outputs");
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const ExrFile exr = read_exr(file("a.exr"));
  const char* manual[] = {"result",          "diffuse_result", "diffuse_raw",      "diffuse_level",
                          "spec_result",     "spec_raw",       "spec_level",       "refl_result",
                          "refl_raw",        "refl_level",     "refr_result",      "refr_raw",
                          "refr_level",      "tran_result",    "tran_raw",         "tran_level",
                          "indirect_result", "indirect_raw",   "indirect_post_ao", "ao_raw",
                          "add_result",      "opacity_result", "opacity_raw",      "opacity"};
  EXPECT_EQ(std::size(manual), 24u);
  for (const char* name : manual) {
    const Layer* layer = find_layer(exr.layers, name);
    ASSERT_NE(layer, nullptr) << name;
    EXPECT_EQ(layer->image.width, 48) << name;
    EXPECT_EQ(layer->image.channels, std::string(name) == "opacity" ? 1 : 3) << name;
  }
  EXPECT_NE(find_layer(exr.layers, "other"), nullptr);
}

TEST_F(OutputsProgram, SingleOutputsCanBeRequested) {
  write_scene();
  ASSERT_EQ(render("refl_raw,opacity").exit_code, 0);
  const ExrFile exr = read_exr(file("a.exr"));
  EXPECT_EQ(exr.layers.size(), 3u);
  EXPECT_NE(find_layer(exr.layers, "refl_raw"), nullptr);
  EXPECT_NE(find_layer(exr.layers, "opacity"), nullptr);
}

// acceptance: U4
TEST_F(OutputsProgram, MaterialsWithoutThemLeaveTheResultAndAMessage) {
  write_scene("\"multiple_outputs\" off");
  const RunResult r = render("outputs");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-RN-055"), std::string::npos) << r.err;
  const ExrFile exr = read_exr(file("a.exr"));
  EXPECT_EQ(exr.layers.size(), 1u) << "the picture alone";

  write_scene();
  const RunResult with = render("outputs");
  EXPECT_EQ(with.err.find("OR-RN-055"), std::string::npos) << with.err;
  EXPECT_EQ(find_layer(exr.layers, "")->image.pixels,
            find_layer(read_exr(file("a.exr")).layers, "")->image.pixels)
      << "the picture is the same";
}

// acceptance: U3
TEST_F(OutputsProgram, AFileGivesItsPictureBackWhateverTheFilter) {
  write_scene("\"ao_on\" on, \"cutout_opacity\" .7", "filter mitchell 4 4");
  ASSERT_EQ(render("outputs").exit_code, 0);
  const RunResult r = run({"recombine", "a.exr"});
  EXPECT_EQ(r.exit_code, 0) << r.out << r.err;
}
TEST_F(OutputsProgram, CryptomattesAreWrittenWithTheirNames) {
  write_scene();
  const RunResult r = run({"render", "scene.mi", "-o", "a.exr", "--cryptomatte", "--samples", "4"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const ExrFile exr = read_exr(file("a.exr"));
  for (const char* type : {"CryptoObject", "CryptoMaterial", "CryptoAsset"})
    for (const char* rank : {"00", "01", "02"})
      EXPECT_NE(find_layer(exr.layers, std::string(type) + rank), nullptr) << type << rank;
  std::string manifests;
  for (const auto& [key, value] : exr.metadata)
    if (key.starts_with("cryptomatte/") && key.ends_with("/manifest"))
      manifests += std::get<std::string>(value);
  for (const char* name : {"\"floor\":", "\"grey\":"})
    EXPECT_NE(manifests.find(name), std::string::npos) << manifests;
  EXPECT_EQ(manifests.find("_inst"), std::string::npos) << manifests;

  ASSERT_EQ(
      run({"render", "scene.mi", "-o", "b.exr", "--cryptomatte=2", "--samples", "4"}).exit_code, 0);
  const ExrFile two = read_exr(file("b.exr"));
  EXPECT_NE(find_layer(two.layers, "CryptoObject00"), nullptr);
  EXPECT_EQ(find_layer(two.layers, "CryptoObject01"), nullptr);
  EXPECT_EQ(find_layer(exr.layers, "")->image.pixels, find_layer(two.layers, "")->image.pixels);
}

TEST_F(OutputsProgram, SceneMayEnableCryptomattes) {
  write_scene({}, "\"cryptomatte\" on");
  ASSERT_EQ(run({"render", "scene.mi", "-o", "a.exr", "--samples", "1"}).exit_code, 0);
  EXPECT_NE(find_layer(read_exr(file("a.exr")).layers, "CryptoAsset02"), nullptr);
  const RunResult png = run({"render", "scene.mi", "-o", "a.png", "--samples", "1"});
  EXPECT_NE(png.err.find("OR-RN-062"), std::string::npos) << png.err;
  ASSERT_EQ(
      run({"render", "scene.mi", "-o", "a.exr", "--samples", "1", "--cryptomatte=0"}).exit_code, 0);
  EXPECT_EQ(find_layer(read_exr(file("a.exr")).layers, "CryptoAsset00"), nullptr);
}

TEST_F(OutputsProgram, EveryFormatThatIsNamedIsWritten) {
  for (const char* format :
       {"exr", "hdr", "png", "jpg", "tif",  "tifu", "tga", "bmp", "ppm", "iff",
        "sgi", "rgb", "rla", "dpx", "fits", "gif",  "jp2", "pgm", "pnm", "webp"}) {
    write("scene.mi",
          small_scene("", "output \"rgb\" \"" + std::string(format) + "\" \"a." + format + "\""));
    const RunResult r = run({"render", "scene.mi", "--samples", "1"});
    EXPECT_EQ(r.exit_code, 0) << format << r.err;
    EXPECT_TRUE(std::filesystem::exists(file("a." + std::string(format)))) << format << r.err;
  }
}

TEST_F(OutputsProgram, CamerasWithTwoEyesWriteTwoFiles) {
  write("scene.mi", small_scene("",
                                "stereo offaxis eye separation .4 parallax distance 3 "
                                "output \"rgba\" \"exr\" \"a.exr\""));
  const RunResult r = run({"render", "scene.mi", "--samples", "4"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const ExrFile left = read_exr(file("a_left.exr")), right = read_exr(file("a_right.exr"));
  EXPECT_FALSE(std::filesystem::exists(file("a.exr")));
  EXPECT_NE(left.layers.front().image.pixels, right.layers.front().image.pixels);
}

}  // namespace outputs_test
}  // namespace oriel
