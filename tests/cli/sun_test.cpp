// SPDX-License-Identifier: Apache-2.0
// oriel sun, and oriel render --sun.
#include <cmath>
#include <nlohmann/json.hpp>

#include "image/exr.h"
#include "image/files.h"
#include "support/program.h"

namespace oriel {
namespace sun_test {

using nlohmann::json;

/// A white card at the origin that faces the camera at (0, 0, 5); the sun in lux.
std::string card_scene(const std::string& sun, const std::string& instance = "",
                       const std::string& environment = "") {
  return "options \"opt\" object space \"indirect\" \"path\" end options\n"
         "camera \"cam\" focal 1 aperture .1 aspect 1 resolution 4 4 " +
         environment +
         " end camera\n"
         "instance \"cam_inst\" \"cam\" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -5 1 end instance\n" +
         (sun.empty() ? ""
                      : "light \"sun\" \"mia_physicalsun\" ( \"rgb_unit_conversion\" 1 1 1" + sun +
                            " ) direction 1 0 0 end light\ninstance \"sun_inst\" \"sun\" " +
                            instance + " end instance\n") +
         "material \"white\" \"mia_material_x\" ( \"diffuse\" 1 1 1, \"reflectivity\" 0 ) end "
         "material\n"
         "object \"card\" visible trace shadow tagged group\n"
         "  -1 -1 0  1 -1 0  1 1 0  -1 1 0  v 0 v 1 v 2 v 3  p 0 0 1 2 3\n"
         "end group end object\n"
         "instance \"card_inst\" \"card\" material [ \"white\" ] end instance\n"
         "instgroup \"root\" \"cam_inst\" \"card_inst\"" +
         (sun.empty() ? "" : " \"sun_inst\"") +
         " end instgroup\n"
         "render \"root\" \"cam_inst\" \"opt\"\n";
}

class SunProgram : public ProgramTest {
 protected:
  json sun(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"sun", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const RunResult r = run(arguments);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return json::parse(r.out);
  }
  /// Luminance of the middle of scene.mi, rendered with these arguments as well.
  float rendered(std::vector<std::string> more) const {
    more.insert(more.begin(), {"render", "scene.mi", "-q", "--samples", "64", "-o", "out.exr"});
    const RunResult r = run(more);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    const Image image = read_image(file("out.exr"));
    const float* p = image.at(2, 2);
    return 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
  }
};

const std::string kPlace = "48.14,11.58", kTime = "2026-06-21T12:00+02:00";
const std::string kSun = kPlace + "," + kTime;

TEST_F(SunProgram, ReportsPositionDirectionsAndLight) {
  const json s = sun({"--at", kPlace, "--time", kTime});
  // An hour and 15 minutes before the sun culminates at 90 - 48.14 + 23.44 degrees.
  EXPECT_NEAR(s["elevation"].get<double>(), 61.5, 1);
  EXPECT_NEAR(s["azimuth"].get<double>(), 143, 3);
  const auto z = s["direction"]["z_up"].get<std::vector<double>>();
  const auto y = s["direction"]["y_up"].get<std::vector<double>>();
  EXPECT_NEAR(z[2], std::sin(s["elevation"].get<double>() / 57.29577951), 1e-5);
  EXPECT_NEAR(std::atan2(z[0], z[1]) * 57.29577951, s["azimuth"].get<double>(), 1e-3);
  EXPECT_EQ(z[0], y[0]);
  EXPECT_EQ(z[1], -y[2]);
  EXPECT_EQ(z[2], y[1]);
  // Between the tables' 60 and 90 degrees.
  EXPECT_GT(s["sun_illuminance"]["normal"].get<double>(), 97972);
  EXPECT_LT(s["sun_illuminance"]["normal"].get<double>(), 101477);
  EXPECT_NEAR(s["sun_illuminance"]["horizontal"].get<double>(),
              s["sun_illuminance"]["normal"].get<double>() * z[2], 1);
  EXPECT_NEAR(s["sky_illuminance"]["horizontal"].get<double>(), 24423, 200);
  EXPECT_NEAR(s["zenith_luminance"].get<double>(), 6100, 200);
  EXPECT_GT(sun({"--at", kPlace, "--time", kTime, "--haze", "5"})["sky_illuminance"]["horizontal"]
                .get<double>(),
            40000);

  const RunResult text = run({"sun", "--at", kPlace, "--time", kTime});
  EXPECT_EQ(text.exit_code, 0);
  for (const char* part : {"azimuth", "elevation", "z up", "y up", "lux", "cd/m2"})
    EXPECT_NE(text.out.find(part), std::string::npos) << part << '\n' << text.out;
}

TEST_F(SunProgram, SouthernAndWesternPlacesHaveASign) {
  const json s = sun({"--at", "-33.87,151.21", "--time", "2026-06-21T12:00+10:00"});
  EXPECT_GT(std::cos(s["azimuth"].get<double>() / 57.29577951), .99);  // north at noon
}

TEST_F(SunProgram, AtNightThereIsNoLight) {
  const json s = sun({"--at", kPlace, "--time", "2026-12-21T00:00+01:00"});
  EXPECT_LT(s["elevation"].get<double>(), -60);
  EXPECT_EQ(s["sun_illuminance"]["normal"], 0);
  EXPECT_EQ(s["sky_illuminance"]["horizontal"], 0);
  EXPECT_EQ(s["zenith_luminance"], 0);
}

TEST_F(SunProgram, WrongArgumentsAreReportedInOneLine) {
  const std::vector<std::vector<std::string>> wrong = {
      {"sun", "--at", "48.14", "--time", kTime},
      {"sun", "--at", "98,11", "--time", kTime},
      {"sun", "--at", kPlace, "--time", "2026-06-21T12:00"},
      {"sun", "--at", kPlace, "--time", "noon"},
      {"sun", "--at", kPlace},
      {"render", "scene.mi", "--sun", "48,11"},
      {"render", "scene.mi", "--sun", "48,11,noon"},
      {"render", "scene.mi", "--north", "3"}};
  for (const auto& arguments : wrong) {
    const RunResult r = run(arguments);
    EXPECT_EQ(r.exit_code, 2) << r.err;
    EXPECT_EQ(r.error_lines(), 1) << r.err;
  }
}

TEST_F(SunProgram, RenderRotatesTheSun) {
  const json s = sun({"--at", kPlace, "--time", kTime});
  // z up: the card lies on the ground.
  write("scene.mi", card_scene(", \"haze\" 0"));
  const float level = s["sun_illuminance"]["horizontal"];
  EXPECT_NEAR(rendered({"--sun", kSun}), level, 1e-3f * level);
  // The light's instance is turned: the light's direction is that of the world all the same.
  write("scene.mi", card_scene(", \"haze\" 0", "transform 0 0 1 0 1 0 0 0 0 1 0 0 7 8 9 1"));
  EXPECT_NEAR(rendered({"--sun", kSun}), level, 1e-3f * level);
  // y up: the card is vertical and faces south, also with a rotated north.
  write("scene.mi", card_scene(", \"y_is_up\" on"));
  const float normal = s["sun_illuminance"]["normal"];
  const float south = normal * s["direction"]["y_up"][2].get<float>();
  EXPECT_NEAR(rendered({"--sun", kSun}), south, 1e-3f * south);
  EXPECT_NEAR(
      rendered({"--sun", kSun, "--north", "90"}),
      normal * sun({"--at", kPlace, "--time", kTime, "--north", "90"})["direction"]["y_up"][2]
                   .get<float>(),
      1e-3f * normal);
}

TEST_F(SunProgram, RenderTurnsTheSkyAsWell) {
  // The sky alone lights the card: more of it when the sun is high.
  const std::string sky =
      "environment \"mia_physicalsky\" ( \"rgb_unit_conversion\" 1 1 1, \"sun_direction\" 0 0 1 )";
  write("scene.mi", card_scene("", "", sky));
  const float noon = rendered({"--sun", kSun});
  EXPECT_NEAR(noon,
              sun({"--at", kPlace, "--time", kTime})["sky_illuminance"]["horizontal"].get<float>(),
              .05f * noon);
  EXPECT_LT(rendered({"--sun", kPlace + ",2026-06-21T05:30+02:00"}), .9f * noon);
  EXPECT_EQ(rendered({"--sun", kPlace + ",2026-12-21T00:00+01:00"}), 0);
}

TEST_F(SunProgram, MissingSunIsReported) {
  write("scene.mi", small_scene());
  const RunResult r = run({"render", "scene.mi", "--sun", kSun, "-q"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("no light with mia_physicalsun"), std::string::npos) << r.err;
}

}  // namespace sun_test
}  // namespace oriel
