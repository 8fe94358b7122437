// SPDX-License-Identifier: Apache-2.0
// oriel render: files, exit codes, interruption, threads.
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/exr.h"
#include "image/files.h"
#include "support/program.h"

namespace oriel {
namespace render_test {

class RenderProgram : public ProgramTest {
 protected:
  RenderProgram() { write("scene.mi", small_scene()); }
};

TEST_F(RenderProgram, WritesTheRequestedFiles) {
  const RunResult r = run({"render", "scene.mi", "-o", "a.exr", "-o", "a.png", "--samples", "2"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const ExrFile exr = read_exr(file("a.exr"));
  EXPECT_EQ(exr.layers[0].image.width, 48);
  EXPECT_EQ(text_attribute(exr, "oriel.scene"), "scene.mi");
  EXPECT_EQ(number_attribute(exr, "oriel.samples"), 2.0f);
  EXPECT_EQ(read_image(file("a.png")).height, 32);
}

TEST_F(RenderProgram, OneAndTwoThreadsGiveTheSameBytes) {
  // Adaptive, so that the choice of pixels is under test too.
  const auto render = [&](const char* threads, const char* output) {
    const RunResult r =
        run({"render", "scene.mi", "-o", output, "--noise", "0.05", "--threads", threads});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return bytes_of(file(output));
  };
  const auto one = render("1", "one.exr"), two = render("2", "two.exr");
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(one == two);
}

// Displaced and textured objects are prepared in parallel, and so are gather points.
TEST_F(RenderProgram, ThreadsChangeNeitherPreparedScenesNorMessages) {
  std::string text =
      "options \"opt\" object space trace depth 2 2 4 finalgather accuracy 20 end options\n"
      "camera \"cam\" focal 1 aperture 1 aspect 1.5 resolution 24 16 end camera\n"
      "instance \"cam_inst\" \"cam\" end instance\n"
      "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 1 0 end light\n"
      "instance \"lamp_inst\" \"lamp\" end instance\n";
  std::string members;
  for (int i = 0; i < 12; ++i) {
    const std::string n = std::to_string(i);
    Image image(8, 8, 3);
    for (std::size_t k = 0; k < image.pixels.size(); ++k)
      image.pixels[k] = static_cast<float>((k * 7 + static_cast<std::size_t>(i) * 5) % 11) / 11;
    // A third of the files is missing.
    if (i % 3 != 0) write_image(file("t" + n + ".png"), image);
    text += "color texture \"t" + n + "\" \"t" + n + ".png\"\n" + "shader \"uv" + n +
            "\" \"mib_texture_vector\" ( \"select\" 0 )\n" + "shader \"look" + n +
            "\" \"mib_texture_lookup\" ( \"tex\" \"t" + n + "\", \"coord\" = \"uv" + n + "\" )\n" +
            "material \"m" + n + "\" \"mib_illum_lambert\" ( \"diffuse\" = \"look" + n + "\" )\n" +
            "displace \"mib_texture_turbulence\" ( \"coord\" = \"uv" + n + "\" ) end material\n" +
            "object \"o" + n + "\" visible trace shadow max displace .1 group\n" +
            "0 0 0 1 0 0 1 1 0 0 1 0 0 0 0 1 0 0 1 1 0 0 1 0\n" +
            "v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 p 0 1 2 3 p 0 0 0\n" +
            "approximate displace parametric 4 end group end object\n" + "instance \"i" + n +
            "\" \"o" + n + "\" material [ \"m" + n + "\" ] transform 1 0 0 0 0 1 0 0 0 0 1 0 " +
            std::to_string(2 - i % 4) + " " + std::to_string(1.5 - i / 4) + " 4 1 end instance\n";
    members += "\"i" + n + "\" ";
  }
  write("many.mi", text + "instgroup \"root\" \"cam_inst\" \"lamp_inst\" " + members +
                       " end instgroup\nrender \"root\" \"cam_inst\" \"opt\"\n");
  const auto render = [&](const std::string& threads) {
    const RunResult r =
        run({"render", "many.mi", "-o", "a.exr", "--samples", "2", "-q", "--threads", threads});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return std::pair(bytes_of(file("a.exr")), r.err);
  };
  const auto [picture, messages] = render("1");
  EXPECT_NE(messages.find("t3.png"), std::string::npos) << messages;
  EXPECT_NE(messages.find("displacement reaches"), std::string::npos) << messages;
  for (const char* threads : {"2", "3"}) {
    const auto [other, other_messages] = render(threads);
    EXPECT_TRUE(other == picture) << threads;
    EXPECT_EQ(other_messages, messages) << threads;
  }
}

TEST_F(RenderProgram, SeedsGiveOtherNoise) {
  for (const char* seed : {"0", "1"})
    EXPECT_EQ(run({"render", "scene.mi", "-o", std::string(seed) + ".exr", "--samples", "2",
                   "--seed", seed})
                  .exit_code,
              0);
  EXPECT_NE(read_exr_image(file("0.exr")).pixels, read_exr_image(file("1.exr")).pixels);
}

TEST_F(RenderProgram, CtrlCLeavesTheBestPictureSoFar) {
  const pid_t child =
      start({"render", "scene.mi", "-o", "a.exr", "--samples", "1000000", "--json"});
  // Wait for a sign of life: progress after a pass.
  for (int i = 0; i < 600 && text_of(file("stdout.txt")).find("progress") == std::string::npos; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(child, SIGINT);
  const RunResult r = finish(child);
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.out.find("\"stopped_by\":\"interrupted\""), std::string::npos) << r.out;
  const ExrFile exr = read_exr(file("a.exr"));
  EXPECT_EQ(exr.layers[0].image.width, 48);
  const Layer* samples = find_layer(exr.layers, "samples");
  ASSERT_NE(samples, nullptr);
  EXPECT_GE(samples->image.pixels[700], 1);
}

TEST_F(RenderProgram, TimeLimitEndsWithACompletePicture) {
  const RunResult r = run({"render", "scene.mi", "-o", "a.exr", "--time", "0.3", "--json"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.out.find("\"stopped_by\":\"time\""), std::string::npos) << r.out;
}

TEST_F(RenderProgram, JsonLinesAreJson) {
  const RunResult r = run({"render", "scene.mi", "-o", "a.exr", "--samples", "4", "--json"});
  std::istringstream lines(r.out);
  nlohmann::json last;
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) last = nlohmann::json::parse(line);
  EXPECT_GE(count, 4);  // passes of 1, 2, 4 samples and the end
  EXPECT_EQ(last["event"], "done");
  EXPECT_EQ(last["files"][0], "a.exr");
  EXPECT_EQ(last["samples"], 4);
}

TEST_F(RenderProgram, TextureCacheSizeIsConfigurableAndReported) {
  EXPECT_EQ(run({"render", "scene.mi", "-o", "a.exr", "--texture-cache", "15"}).exit_code, 2);
  write_image(file("t.tif"), Image(64, 64, 3), {});
  write("textured.mi",
        "color texture \"t\" \"t.tif\"\n" +
            small_scene("",
                        "environment \"mib_texture_lookup\" ( \"tex\" \"t\", \"coord\" .5 .5 0 )"));
  const RunResult r = run({"render", "textured.mi", "-o", "a.exr", "--samples", "1", "--json",
                           "--texture-cache", "16"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const std::size_t at = r.out.find("\"textures\"");
  ASSERT_NE(at, std::string::npos) << r.out;
  EXPECT_NE(r.out.find("\"files\":1", at), std::string::npos) << r.out;
}

TEST_F(RenderProgram, CropIsPartOfTheWholePicture) {
  ASSERT_EQ(run({"render", "scene.mi", "-o", "a.exr", "--samples", "2"}).exit_code, 0);
  ASSERT_EQ(run({"render", "scene.mi", "-o", "b.exr", "--samples", "2", "--crop", "10,8,19,15"})
                .exit_code,
            0);
  const Image a = read_exr_image(file("a.exr")), b = read_exr_image(file("b.exr"));
  EXPECT_EQ(b.at(10, 31 - 8)[0], a.at(10, 31 - 8)[0]);
  EXPECT_EQ(b.at(19, 31 - 15)[1], a.at(19, 31 - 15)[1]);
  EXPECT_EQ(b.at(9, 20)[3], 0);
  EXPECT_EQ(b.at(20, 20)[3], 0);
}

TEST_F(RenderProgram, SamplesAreDistributedFrom16And128x128On) {
  struct Case {
    std::vector<std::string> options;
    bool distributed;
  };
  for (const Case& c :
       {Case{{"--samples", "32", "--size", "128x128"}, true},
        Case{{"--samples", "16", "--size", "128x128"}, true},
        Case{{"--samples", "32", "--size", "512x300", "--crop", "100,60,299,239"}, true},
        Case{{"--samples", "32", "--size", "128x128", "--even-samples"}, false},
        Case{{"--samples", "15", "--size", "128x128"}, false},
        Case{{"--samples", "32", "--size", "128x127"}, false}}) {
    const std::string what = c.options.back();
    std::vector<std::string> words = {"render",   "scene.mi", "-o",    "a.exr",
                                      "--layers", "samples",  "--exr", "float"};
    words.insert(words.end(), c.options.begin(), c.options.end());
    const RunResult r = run(words);
    ASSERT_EQ(r.exit_code, 0) << r.err;
    const ExrFile exr = read_exr(file("a.exr"));
    const Layer* samples = find_layer(exr.layers, "samples");
    ASSERT_NE(samples, nullptr);
    const Image& image = samples->image;
    double sum = 0, least = 1e9, most = 0, count = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const double n = image.at(x, y)[0];
        if (n == 0) continue;  // outside the crop
        sum += n, count += 1, least = std::min(least, n), most = std::max(most, n);
      }
    const double asked = std::stoi(c.options[1]);
    EXPECT_NEAR(sum / count, asked, .01) << what;
    EXPECT_EQ(least, c.distributed ? asked / 2 : asked) << what;
    EXPECT_LE(most, 4 * asked) << what;
    EXPECT_EQ(most > asked, c.distributed) << what;
  }
}

TEST_F(RenderProgram, SizeAndLayersFollowTheOptions) {
  const RunResult r = run({"render", "scene.mi", "-o", "a.exr", "--samples", "1", "--size", "30x20",
                           "--layers", "normal,depth"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const ExrFile exr = read_exr(file("a.exr"));
  EXPECT_EQ(exr.layers[0].image.width, 30);
  EXPECT_EQ(exr.layers.size(), 3u);
}

TEST_F(RenderProgram, DenoiseAddsALayerAndCleansViews) {
  const RunResult r = run({"render", "scene.mi", "--samples", "8", "--denoise", "-o", "out.exr",
                           "-o", "out.png", "--exr", "float"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const ExrFile picture = read_exr(file("out.exr"));
  const Layer* clean = find_layer(picture.layers, "denoised");
  ASSERT_NE(clean, nullptr);
  // The file alone contains all information.
  ASSERT_EQ(run({"denoise", "out.exr", "-o", "clean.exr"}).exit_code, 0);
  const Image again = read_exr_image(file("clean.exr"));
  for (std::size_t i = 0; i < again.pixel_count(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(again.pixels[4 * i + c], clean->image.pixels[3 * i + c]);
}

TEST_F(RenderProgram, SetChangesTheScene) {
  const auto render = [&](const std::string& edit, const char* output) {
    const RunResult r = run({"render", "scene.mi", "-o", output, "--samples", "4", "--set", edit});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return read_exr_image(file(output));
  };
  const Image dark = render("lamp.color=0 0 0", "dark.exr");
  for (std::size_t i = 0; i < dark.pixel_count(); ++i) EXPECT_EQ(dark.pixels[4 * i], 0);
  const Image plain = render("grey.reflectivity=0", "plain.exr");
  const Image mirror = render("grey.reflectivity=1", "mirror.exr");
  EXPECT_NE(plain.pixels, mirror.pixels);
}

TEST_F(RenderProgram, SetReportsMissingNames) {
  const RunResult element = run({"render", "scene.mi", "-o", "a.exr", "--set", "lampe.color=1"});
  EXPECT_EQ(element.exit_code, 1);
  EXPECT_NE(element.err.find("did you mean \"lamp\"?"), std::string::npos) << element.err;
  const RunResult param = run({"render", "scene.mi", "-o", "a.exr", "--set", "grey.reflectivty=1"});
  EXPECT_EQ(param.exit_code, 1);
  EXPECT_NE(param.err.find("did you mean \"reflectivity\"?"), std::string::npos) << param.err;
}

TEST_F(RenderProgram, CameraOutputsAreWrittenBesideTheScene) {
  std::filesystem::create_directory(file("sub"));
  write("sub/scene.mi", small_scene("",
                                    "output \"rgba_fp\" \"exr\" \"out.exr\" "
                                    "output \"rgb\" \"png\" \"../outside.png\""));
  const RunResult r = run({"render", "sub/scene.mi", "--samples", "1"});
  EXPECT_EQ(r.exit_code, 1) << "an output is missing" << r.err;
  EXPECT_TRUE(std::filesystem::exists(file("sub/out.exr")));
  EXPECT_FALSE(std::filesystem::exists(file("outside.png")));
  EXPECT_NE(r.err.find("OR-RN-050"), std::string::npos) << r.err;
}

TEST_F(RenderProgram, MapsAreWrittenBelowTheSceneFolder) {
  std::filesystem::create_directory(file("sub"));
  std::string scene = small_scene("finalgather on finalgather file [\"a.fgm\", \"../b.fgm\"]");
  scene.replace(scene.find("\"indirect\" \"path\""), 17, "");
  write("sub/scene.mi", scene);
  const RunResult r = run({"render", "sub/scene.mi", "-o", "a.exr", "--samples", "1"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-RN-043"), std::string::npos) << r.err;
  EXPECT_TRUE(std::filesystem::exists(file("sub/a.fgm")));
  EXPECT_FALSE(std::filesystem::exists(file("b.fgm")));
  EXPECT_EQ(text_attribute(read_exr(file("a.exr")), "oriel.indirect"), "fg");
}

TEST_F(RenderProgram, UserErrorsAreOneClearLine) {
  const std::vector<std::vector<std::string>> usage = {{"render"},
                                                       {"render", "scene.mi", "--bogus"},
                                                       {"render", "scene.mi", "-o", "a.unknown"},
                                                       {"render", "scene.mi", "--gi", "magic"},
                                                       {"render", "scene.mi", "--size", "40"},
                                                       {"render", "scene.mi", "--crop", "5,5,1,1"},
                                                       {"render", "scene.mi", "--samples", "0"},
                                                       {"render", "scene.mi", "--noise", "-1"},
                                                       {"render", "scene.mi", "--layers", "gloss"},
                                                       {"render", "scene.mi", "--set", "nonsense"},
                                                       {},
                                                       {"paint"}};
  for (const auto& arguments : usage) {
    const RunResult r = run(arguments);
    EXPECT_EQ(r.exit_code, 2) << r.err;
    EXPECT_EQ(r.error_lines(), 1) << r.err;
  }
  const std::vector<std::vector<std::string>> failing = {
      {"render", "missing.mi", "-o", "a.exr"},
      {"render", "scene.mi", "-o", "no/such/folder/a.exr"}};
  for (const auto& arguments : failing) {
    const RunResult r = run(arguments);
    EXPECT_EQ(r.exit_code, 1) << r.err;
    EXPECT_EQ(r.error_lines(), 1) << r.err;
  }
}

TEST_F(RenderProgram, MissingRenderStatementIsReported) {
  write("empty.mi", "options \"o\" end options\n");
  const RunResult r = run({"render", "empty.mi", "-o", "a.exr"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("no render statement"), std::string::npos) << r.err;
}

}  // namespace render_test
}  // namespace oriel
