// SPDX-License-Identifier: Apache-2.0
// oriel convert and oriel quick, from a model file to an image.
#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "image/files.h"
#include "models/testing/gltf_file.h"
#include "support/program.h"

namespace oriel {
namespace convert_test {

class ConvertTest : public ProgramTest {
 protected:
  /// A white square of side 4 on z = 0, a camera at (3, 0, 5) that looks straight at it, and a lamp
  /// of that many candela at (0, 0, 2).
  void write_square(const std::string& name, float candela) const {
    models::testing::Quad square;
    square.scene = "0,1,2";
    square.node = R"(,"translation":[-2,-2,0],"scale":[4,4,1])";
    square.nodes = R"(,{"camera":0,"name":"eye","translation":[3,0,5]},{"name":"lamp",)"
                   R"("translation":[0,0,2],"extensions":{"KHR_lights_punctual":{"light":0}}})";
    square.more = fmt::format(
        R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{{"KHR_lights_punctual":)"
        R"({{"lights":[{{"type":"point","intensity":{}}}]}}}},"cameras":[{{"type":"perspective",)"
        R"("perspective":{{"aspectRatio":1.5,"yfov":1,"znear":0.1}}}}],)",
        candela);
    square.material =
        R"("pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":1},"doubleSided":true)";
    write(name, square.text());
  }
  /// A white room from 0 to 1 with a camera in its middle that looks at the wall z = 0, away from
  /// the wall z = 1, of which a part of that height is there.
  void write_room(const std::string& name, float height) const {
    models::testing::Quad wall;
    wall.scene = "0,1,2,3,4,5,6";
    const auto at = [](const char* columns) {
      return fmt::format(R"(,{{"mesh":0,"matrix":[{}]}})", columns);
    };
    wall.nodes =
        fmt::format(R"(,{{"mesh":0,"translation":[0,0,1],"scale":[1,{},1]}})", height) +
        at("0,0,1,0, 0,1,0,0, 1,0,0,0, 0,0,0,1") + at("0,0,1,0, 0,1,0,0, 1,0,0,0, 1,0,0,1") +
        at("1,0,0,0, 0,0,1,0, 0,1,0,0, 0,0,0,1") + at("1,0,0,0, 0,0,1,0, 0,1,0,0, 0,1,0,1") +
        R"(,{"camera":0,"name":"eye","translation":[0.5,0.5,0.5]})";
    wall.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.01}}],)";
    wall.material =
        R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0,)"
        R"("roughnessFactor":1},"doubleSided":true)";
    write(name, wall.text());
  }
  float shutter_of(const std::string& scene) const {
    const std::string text = text_of(file(scene));
    std::smatch found;
    return std::regex_search(text, found, std::regex("\"camera_shutter\" ([0-9.e+-]+)"))
               ? std::stof(found[1])
               : 0;
  }
};

TEST_F(ConvertTest, ItsOwnLightsAreMetered) {
  float shutter[2];
  for (const int k : {0, 1}) {
    write_square("square.gltf", k == 0 ? 100 : 20000);
    const RunResult r = run({"convert", "square.gltf", "square.mi"});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    shutter[k] = shutter_of("square.mi");
    ASSERT_EQ(run({"render", "square.mi", "-q", "--size", "48x32", "-o", "square.png"}).exit_code,
              0);
    const Image image = read_image(file("square.png"));
    // Where the camera's left half sees the square.
    const float lit = image.at(12, 16)[1];
    EXPECT_GT(lit, .25f);
    EXPECT_LT(lit, .9f);
  }
  EXPECT_GT(shutter[0], 0);
  EXPECT_NEAR(shutter[1] / shutter[0], 200, 2);
}

// A camera has the transform of its node, applied once.
TEST_F(ConvertTest, GltfCamerasHaveTheTransformsOfTheirNodes) {
  write_square("square.gltf", 1000);
  ASSERT_EQ(run({"convert", "square.gltf", "square.mi"}).exit_code, 0);
  ASSERT_EQ(run({"render", "square.mi", "-q", "--size", "48x32", "-o", "square.exr"}).exit_code, 0);
  const Image image = read_image(file("square.exr"));
  // At 5 away the picture is 5.46 high and 8.19 wide: x from -1.1 to 7.1, y from -2.7 to 2.7.
  const auto lit = [&](float x, float y) {
    return image.at(static_cast<int>((x + 1.1f) / 8.2f * 48),
                    static_cast<int>((2.73f - y) / 5.46f * 32))[1] > 0;
  };
  EXPECT_TRUE(lit(0, 0));
  EXPECT_TRUE(lit(1.7f, 1.7f));
  EXPECT_FALSE(lit(2.3f, 0));
  EXPECT_FALSE(lit(0, 2.3f));
}

TEST_F(ConvertTest, SizeAppliesToAnyCamera) {
  write_square("square.gltf", 1000);
  ASSERT_EQ(run({"quick", "square.gltf", "--size", "40x10", "--samples", "1"}).exit_code, 0);
  EXPECT_EQ(read_image(file("square.png")).width, 40);
  EXPECT_EQ(read_image(file("square.png")).height, 10);
}

TEST_F(ConvertTest, ModelWithoutLightGetsAHint) {
  write("dark.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const RunResult r = run({"convert", "dark.obj", "dark.mi"});
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_NE(r.err.find("--daylight"), std::string::npos) << r.err;
  EXPECT_EQ(shutter_of("dark.mi"), 0);
}

TEST_F(ConvertTest, DamagedFileIsReported) {
  // The header ends in no line: assimp 5.2 reads beyond it.
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header";
  write("broken.ply", header + "\xff" + std::string(36, '\0') + "\3" + std::string(12, '\0'));
  write("endless.ply", header.substr(0, header.rfind('\n')) + "\n");
  for (const char* name : {"broken.ply", "endless.ply"}) {
    const RunResult r = run({"convert", name, "broken.mi"});
    EXPECT_EQ(r.exit_code, 1) << r.err;
    EXPECT_NE(r.err.find(fmt::format("'{}'", name)), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("[OR-MD-001]"), std::string::npos) << r.err;
    EXPECT_FALSE(std::filesystem::exists(file("broken.mi")));
  }
}

TEST_F(ConvertTest, FileCameraInARoomIsExposedForItsView) {
  write_room("room.gltf", .98f);
  const RunResult r = run({"convert", "--daylight", "room.gltf", "room.mi"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.err, "");
  EXPECT_LT(shutter_of("room.mi"), 100 / 8.0f);
  EXPECT_GT(shutter_of("room.mi"), 0);
}

TEST_F(ConvertTest, FileCameraInsideAClosedObjectIsSkipped) {
  write_room("box.gltf", 1);
  const RunResult r = run({"quick", "box.gltf", "--size", "48x32", "--samples", "4"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-MD-013"), std::string::npos) << r.err;
  EXPECT_EQ(shutter_of("box.mi"), 100);
  const Image image = read_image(file("box.png"));
  EXPECT_GT(image.at(24, 16)[1], .2f);
  EXPECT_NE(text_of(file("box.mi")).find("eye_inst"), std::string::npos);
}

/// Mean of green of a picture, in linear light.
double mean_light(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += std::pow(image.at(x, y)[1], 2.2);
  return sum / image.width / image.height;
}

TEST_F(ConvertTest, RoomsOfAllBrightnessesAreExposedForTheirMean) {
  for (const float wall : {.2f, .6f, .95f}) {
    write_room("room.gltf", wall);
    const RunResult r =
        run({"quick", "room.gltf", "--size", "48x32", "--samples", "64", "--no-denoise"});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    // A reflected-light meter makes the mean a middle grey.
    const double mean = mean_light(read_image(file("room.png")));
    EXPECT_GT(mean, .12) << wall;
    EXPECT_LT(mean, .35) << wall;
  }
}

TEST_F(ConvertTest, RenderTakesModelsAsQuickDoes) {
  write_square("square.gltf", 1000);
  const RunResult r = run({"render", "square.gltf", "--size", "16x8", "--samples", "1", "-q"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(read_image(file("square.png")).width, 16);
  const RunResult json = run({"quick", "square.gltf", "--size", "16x8", "--noise", ".5", "--json",
                              "-o", "square.exr", "--cryptomatte", "--layers", "depth"});
  ASSERT_EQ(json.exit_code, 0) << json.err;
  EXPECT_EQ(json.out.substr(0, 1), "{");
}

TEST_F(ConvertTest, TruncatedFilesAreReported) {
  // The header of a file of 1000 bytes.
  write("m.glb", std::string("glTF\2\0\0\0\xe8\3\0\0\x60\0\0\0JSON{\"asset\":", 29));
  write("m.ifc", "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n#1=IFCPRO");
  for (const char* name : {"m.glb", "m.ifc"}) {
    const RunResult r = run({"quick", name});
    EXPECT_EQ(r.exit_code, 1) << name;
    EXPECT_NE(r.err.find("truncated"), std::string::npos) << r.err;
  }
}

// A node that moves from x = 0 at 0 s to x = 4 at 2 s.
TEST_F(ConvertTest, AnimationsAreEvaluatedAtATime) {
  models::testing::GltfFile model;
  model.add_triangle();
  const std::size_t times = model.add<float>({0, 2}, models::testing::kFloat, "SCALAR", 1);
  const std::size_t places =
      model.add<float>({0, 0, 0, 4, 0, 0}, models::testing::kFloat, "VEC3", 3);
  model.root["animations"] = {
      {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
       {"samplers", {{{"input", times}, {"output", places}}}}}};
  write("m.gltf", model.text());
  const RunResult r = run({"convert", "m.gltf", "m.mi", "--animation-time", "1.5", "-q"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const std::string scene = text_of(file("m.mi"));
  // The transform of an instance is that from the world.
  EXPECT_TRUE(std::regex_search(scene, std::regex("-3 -?0 -?0 1"))) << scene;
}

TEST_F(ConvertTest, UsdFilesGetAConversionHint) {
  write("house.usda", "#usda 1.0\n");
  for (const char* command : {"quick", "render"}) {
    const RunResult r = run({command, "house.usda"});
    EXPECT_EQ(r.exit_code, 1);
    EXPECT_NE(r.err.find("OR-MD-018"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("Blender"), std::string::npos) << r.err;
  }
}

// A sky whose picture is bright on one side lights the model from there.
TEST_F(ConvertTest, ASkyLightsTheModel) {
  Image sky(64, 32, 3, .1f);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 32; ++x)
      for (int k = 0; k < 3; ++k) sky.at(x, y)[k] = 100;
  write_image(file("sky.hdr"), sky);
  write_square("square.gltf", 0);
  std::string scenes[2];
  for (const int turned : {0, 1}) {
    const RunResult r = run({"quick", "square.gltf", "--sky", "sky.hdr", "--sky-rotation",
                             turned ? "180" : "0", "--size", "24x16", "--samples", "16"});
    ASSERT_EQ(r.exit_code, 0) << r.err;
    EXPECT_GT(mean_light(read_image(file("square.png"))), .03);
    scenes[turned] = text_of(file("square.mi"));
  }
  EXPECT_NE(shutter_of("square.mi"), 0);
  EXPECT_NE(scenes[0], scenes[1]);
}

TEST_F(ConvertTest, QuickUsesAsManyThreadsAsAllowed) {
  write_square("square.gltf", 1);
  const auto quick = [&](const char* threads) {
    return run({"quick", "square.gltf", "--size", "8x8", "--samples", "1", "--threads", threads});
  };
  EXPECT_EQ(quick("1").exit_code, 0);
  EXPECT_EQ(quick("-1").exit_code, 2);
}

TEST_F(ConvertTest, QuickMakesAPictureInDaylight) {
  write("box.obj",
        "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1\n"
        "f 5 8 7 6\nf 4 3 7 8\nf 3 2 6 7\nf 2 1 5 6\nf 1 4 8 5\n");
  const RunResult r = run({"quick", "box.obj", "--size", "60x40", "--samples", "4"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const Image image = read_image(file("box.png"));
  double sum = 0, squares = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) {
      sum += image.at(x, y)[1];
      squares += double{image.at(x, y)[1]} * image.at(x, y)[1];
    }
  const double mean = sum / 2400, deviation = std::sqrt(squares / 2400 - mean * mean);
  EXPECT_GT(mean, .25);
  EXPECT_LT(mean, .85);
  EXPECT_GT(deviation, .05) << "sides in sun and shade, ground, sky";
  EXPECT_TRUE(std::filesystem::exists(file("box.mi")));
}

}  // namespace convert_test
}  // namespace oriel
