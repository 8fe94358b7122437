// SPDX-License-Identifier: Apache-2.0
// oriel measure and oriel falsecolor.
#include <cmath>
#include <nlohmann/json.hpp>

#include "image/exr.h"
#include "image/files.h"
#include "support/program.h"

namespace oriel {
namespace measure_test {

/// A light of 1000 cd, 2 above a black floor that the camera faces.
class MeasureProgram : public ProgramTest {
 protected:
  void write_scene(const std::string& camera = {}) const {
    write("scene.mi",
          "options \"opt\" object space \"indirect\" \"path\" end options\n"
          "camera \"cam\" focal 1 aperture 1 aspect 1 resolution 32 32 " +
              camera +
              " end camera\n"
              "instance \"cam_i\" \"cam\" transform 1 0 0 0  0 1 0 0  0 0 1 0  0 0 -1.5 1 "
              "end instance\n"
              "light \"lamp\" \"physical_light\" ( \"color\" 4000 4000 4000 ) origin 0 0 2 "
              "end light\n"
              "instance \"lamp_i\" \"lamp\" end instance\n"
              "material \"black\" \"mia_material_x\" ( \"diffuse_weight\" 0, \"reflectivity\" 0 ) "
              "end material\n"
              "object \"floor\" visible trace shadow group\n"
              "  -3 -2 0  3 -2 0  3 2 0  -3 2 0  v 0 v 1 v 2 v 3  p 0 0 1 2 3\n"
              "end group end object\n"
              "instance \"floor_i\" \"floor\" material \"black\" end instance\n"
              "instgroup \"root\" \"cam_i\" \"lamp_i\" \"floor_i\" end instgroup\n"
              "render \"root\" \"cam_i\" \"opt\"\n");
  }
  nlohmann::json measure(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"measure", "scene.mi", "--json"});
    const RunResult r = run(arguments);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return nlohmann::json::parse(r.out, nullptr, false);
  }
};

TEST_F(MeasureProgram, PointsMatchTheIlluminanceOfALight) {
  write_scene();
  const auto m = measure({"--at", "0,0,0", "--at", "0,0,1", "--at", "2,0,0"});
  const auto& sensors = m["illuminance"]["sensors"];
  ASSERT_EQ(sensors.size(), 3u);
  const double expected[] = {250, 1000, 1000 * 2 / std::pow(8, 1.5)};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(sensors[i]["value"].get<double>(), expected[i], 1e-4 * expected[i]);
    EXPECT_TRUE(sensors[i]["precise"].get<bool>());
  }
  const auto down = measure({"--at", "0,0,1", "--normal", "0,0,-1"});
  EXPECT_EQ(down["illuminance"]["mean"]["value"], 0);
}

TEST_F(MeasureProgram, GridAndPlaneAreTheSameSensors) {
  write_scene();
  const auto grid = measure({"--grid", "-2.5,-1.5,.5:5,0,.0:0,3,0:5x3"})["illuminance"];
  EXPECT_EQ(grid["columns"], 5);
  EXPECT_EQ(grid["rows"], 3);
  const auto plane = measure({"--plane", "z=.5", "--spacing", "1", "--inset", ".5"})["illuminance"];
  EXPECT_EQ(plane["sensors"], grid["sensors"]);
  // The first row is the most distant one; it is brightest below the light.
  EXPECT_EQ(grid["sensors"][0]["position"], (std::vector<double>{-2, 1, .5}));
  EXPECT_NEAR(grid["max"].get<double>(), 1000 / 2.25, .05);
  const double least = 1000 * 1.5 / std::pow(4 + 1 + 2.25, 1.5);
  EXPECT_NEAR(grid["min"].get<double>(), least, .05);
  EXPECT_NEAR(grid["uniformity"].get<double>(), least / grid["mean"]["value"].get<double>(), 1e-6);
}

TEST_F(MeasureProgram, UnitsChangeLocationsOnly) {
  write_scene();
  const auto units = measure({"--plane", "z=.5", "--spacing", "2"})["illuminance"];
  const auto metres =
      measure({"--plane", "z=.05m", "--spacing", ".2m", "--meters-per-unit", ".1"})["illuminance"];
  EXPECT_EQ(metres["mean"], units["mean"]);
  EXPECT_NEAR(metres["sensors"][0]["position"][0].get<double>(),
              .1 * units["sensors"][0]["position"][0].get<double>(), 1e-6);
}

TEST_F(MeasureProgram, SpotsReportLuminanceIlluminanceLocationAndMaterial) {
  write_scene();
  const auto m = measure({"--pixel", "16,16"});
  const auto& spot = m["spots"][0];
  EXPECT_EQ(spot["luminance"]["value"], 0);  // it is black
  EXPECT_NEAR(spot["illuminance"]["value"].get<double>(), 250, 1);
  EXPECT_NEAR(spot["distance"].get<double>(), 1.5, .01);
  EXPECT_EQ(spot["material"], "black");
  EXPECT_EQ(run({"measure", "scene.mi", "--pixel", "32,0"}).exit_code, 1);
}

TEST_F(MeasureProgram, TextAndFileAgree) {
  write_scene("lens \"mia_exposure_photographic\" ( \"cm2_factor\" 2 )");
  const RunResult r =
      run({"measure", "scene.mi", "--grid", "-1,-1,0:2,0,0:0,2,0:2x2", "--csv", "a.csv"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.out.find("2 cd/m2 (mia_exposure_photographic)"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("uniformity  1.000"), std::string::npos) << r.out;
  const std::string csv = text_of(file("a.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_EQ(csv.rfind("x,y,z,nx,ny,nz,lux,half_width,samples\n-0.5,0.5,0,0,0,1,419.", 0), 0u)
      << csv;
}

TEST_F(MeasureProgram, WrongUseIsReportedInOneLine) {
  write_scene();
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"--grid", "0,0,0:1,0,0"},
      {"--grid", "0,0,0:1,0,0:2,0,0:2x2"},
      {"--grid", "0,0,0:1,0,0:0,1,0"},
      {"--plane", "q=1", "--spacing", "1"},
      {"--plane", "z=1"},
      {"--plane", "z=1m", "--spacing", "1"},
      {"--plane", "z=1", "--spacing", "1", "--inset", "9"},
      {"--plane", "z=1", "--spacing", "1e-6"},
      {"--at", "1,2"},
      {"--at", "0,0,0", "--precision", "-1"},
      {"--at", "0,0,0", "--normal", "0,0,0"},
      {"--at", "0,0,0", "--unit-luminance", "0"},
      {"--pixel", "a,b"}};
  for (auto arguments : wrong) {
    const std::string last = arguments.empty() ? "" : arguments.back();
    arguments.insert(arguments.begin(), {"measure", "scene.mi"});
    const RunResult r = run(arguments);
    EXPECT_EQ(r.exit_code, 2) << last;
    EXPECT_EQ(r.error_lines(), 1) << last << r.err;
  }
}

TEST_F(MeasureProgram, LayersAreInLuxAndCandela) {
  write_scene();
  const RunResult r = run({"render", "scene.mi", "-o", "a.exr", "--samples", "4", "--layers",
                           "depth,luminance,illuminance", "--unit-luminance", "2"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const ExrFile exr = read_exr(file("a.exr"));
  const Layer* lux = find_layer(exr.layers, "illuminance");
  ASSERT_NE(lux, nullptr);
  EXPECT_NEAR(*lux->image.at(16, 16), 500, 1);  // black as the floor is
  ASSERT_NE(find_layer(exr.layers, "luminance"), nullptr);
  EXPECT_EQ(*find_layer(exr.layers, "luminance")->image.at(16, 16), 0);
  EXPECT_EQ(number_attribute(exr, "oriel.unitLuminance"), 2.0f);

  ASSERT_EQ(run({"falsecolor", "a.exr", "-o", "a.png", "--isolines"}).exit_code, 0);
  const Image picture = read_image(file("a.png"));
  EXPECT_GT(picture.width, 32 + 20);
  EXPECT_EQ(run({"falsecolor", "a.exr", "-o", "b.png", "--range", "9,1"}).exit_code, 2);
  EXPECT_EQ(run({"falsecolor", "a.exr", "-o", "b.png", "--layer", "nothing"}).exit_code, 1);
  EXPECT_EQ(run({"falsecolor", "a.exr", "-o", "b.png", "--log", "--layer", "luminance", "--range",
                 "1,1000"})
                .exit_code,
            0);
}

}  // namespace measure_test
}  // namespace oriel
