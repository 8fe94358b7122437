// SPDX-License-Identifier: Apache-2.0
// Each shader of examples/shaders does in the picture what its first line says. The wrapper,
// photons and emitters are in material_api_test.cpp and photons_test.cpp.
#include <fmt/format.h>

#include "user_picture.h"

namespace oriel {
namespace examples_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserPicture;
using testing::UserScene;

/// A folder with one example's library, and its declaration.
struct Example {
  ShaderFolder folder;
  std::string declaration;

  Example(const std::string& kind, const std::string& source) {
    const std::filesystem::path from = std::filesystem::path(ORIEL_SOURCE_DIR) / "examples/shaders";
    folder.compile_file(kind, from / kind / source);
    std::ifstream file(from / kind / std::filesystem::path(source).replace_extension(".mi"));
    declaration.assign(std::istreambuf_iterator<char>(file), {});
    // A material that shows where it is met.
    folder.compile("where",
                   "#include <shader.h>\n"
                   "DLLEXPORT miBoolean where(miColor *r, miState *state, void *p) {"
                   "  r->r = state->point.x; r->g = state->point.y; r->b = state->point.z;"
                   "  r->a = 1; return miTRUE; }");
    declaration +=
        "link \"where.so\" declare shader color \"where\" ( ) apply material end declare ";
  }
};

/// Mean over a pixel of 8 x 8 seen from (0, 0, 4): f(x, y) of places on the plane z = 0.
template <class F>
double mean_over_pixel(int px, int py, F&& f) {
  constexpr int kSteps = 64;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j)
      sum += f(px - 4 + (i + .5) / kSteps, py - 4 + (j + .5) / kSteps);
  return sum / (kSteps * kSteps);
}

const std::string kLambert =
    "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 0 0 0, \"diffuse\" 1 1 1, \"mode\" 1, "
    "\"lights\" [\"lamp_i\"] ) end material ";
const std::string kGlow =
    "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" "
    ".5 .5 .5, \"diffuse\" 0 0 0 ) end material ";
const std::string kWhere = "material \"m\" \"where\" ( ) end material ";

TEST(Examples, LacquerShowsItsPaintUnderTheCoat) {
  Example example("material", "ex_lacquer.cpp");
  const std::string lacquer =
      "material \"m\" \"ex_lacquer\" ( \"paint\" .8 .4 .2, \"lights\" [\"lamp_i\"] ) end material ";
  const std::string lamp =
      "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 3 "
      "end light instance \"lamp_i\" \"lamp\" end instance ";
  UserScene lit(example.folder, example.declaration + lamp + lacquer + UserScene::square("m"),
                "\"lamp_i\" \"square_i\"");
  // Glass reflects .04 straight on, hardly more at the angles of this pixel.
  const double cosine =
      mean_over_pixel(4, 4, [](double x, double y) { return 3 / std::sqrt(x * x + y * y + 9); });
  expect_near(lit.pixel(4, 4, 256), Rgb(.8f, .4f, .2f) * float(.96 * cosine), 4e-3f);
  // Under an even sky: what the coat reflects, and of the rest the paint's share.
  UserScene sky(example.folder, example.declaration + lamp + lacquer + UserScene::square("m"),
                "\"square_i\"", "",
                "environment \"mib_color_mix\" ( \"num\" 0, \"color_base\" 1 1 1 1 )");
  expect_near(sky.pixel(4, 4, 64), Rgb(.8f, .4f, .2f) * .96f + Rgb(.04f), 2e-3f);
}

TEST(Examples, CheckerIsEvenAndOddInTurn) {
  Example example("texture", "ex_checker.c");
  UserScene scene(example.folder,
                  example.declaration +
                      "shader \"at\" \"mib_texture_vector\" ( \"select\" 0 ) "
                      "shader \"c\" \"ex_checker\" ( \"coord\" = \"at\", \"size\" .25, \"even\" .1 "
                      ".2 .3, \"odd\" .6 .7 .8 ) material \"m\" \"mib_illum_lambert\" ( "
                      "\"ambience\" 1 1 1, \"ambient\" = \"c\", \"diffuse\" 0 0 0 ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  // The square is 16 wide: four units of the view are one field.
  const Rgb even(.1f, .2f, .3f), odd(.6f, .7f, .8f);
  expect_near(scene.pixel(1, 1), even, 1e-5f);
  expect_near(scene.pixel(5, 1), odd, 1e-5f);
  expect_near(scene.pixel(2, 6), odd, 1e-5f);
  expect_near(scene.pixel(7, 7), even, 1e-5f);
}

TEST(Examples, BeaconTurnsWithTheFrames) {
  Example example("light", "ex_beacon.c");
  const auto lit = [&](int frame, int x) {
    UserScene scene(example.folder,
                    example.declaration +
                        "light \"lamp\" \"ex_beacon\" ( \"color\" 9 9 9, \"frames\" 4, "
                        "\"sharpness\" 2 ) origin 0 0 3 end light "
                        "instance \"lamp_i\" \"lamp\" end instance " +
                        kLambert + UserScene::square("m"),
                    "\"lamp_i\" \"square_i\"", "", fmt::format("frame {} 0", frame));
    scene.indirect = false;
    return scene.pixel(x, 4, 1024).x;
  };
  // At first the beam lies along x, after two of four frames along -x.
  const auto wanted = [](double x, double y) {
    const double d = std::sqrt(x * x + y * y + 9), cosine = x / d;
    return 9 * cosine * cosine / (d * d) * 3 / d;
  };
  const auto there = static_cast<float>(mean_over_pixel(6, 4, wanted));
  EXPECT_NEAR(lit(0, 6), there, .02f * there);
  EXPECT_EQ(lit(0, 1), 0);
  EXPECT_NEAR(lit(2, 1), there, .02f * there);
  EXPECT_EQ(lit(2, 6), 0);
}

TEST(Examples, HighlightOnlyShinesOnOtherMaterialsAsAnyLight) {
  Example example("light", "ex_highlight_only.c");
  UserScene scene(example.folder,
                  example.declaration +
                      "light \"lamp\" \"ex_highlight_only\" ( \"color\" 9 18 27 ) origin 0 0 3 end "
                      "light instance \"lamp_i\" \"lamp\" end instance " +
                      kLambert + UserScene::square("m"),
                  "\"lamp_i\" \"square_i\"");
  scene.indirect = false;
  const double wanted = mean_over_pixel(
      6, 6, [](double x, double y) { return 9 * 3 / std::pow(x * x + y * y + 9, 1.5); });
  expect_near(scene.pixel(6, 6, 1024), Rgb(1, 2, 3) * float(wanted), .01f);
}

TEST(Examples, StainedGlassTintsTheLightByItsWayThroughThePane) {
  Example example("shadow", "ex_stained_glass.c");
  for (const char* mode : {"on", "sort", "segments"}) {
    UserScene scene(
        example.folder,
        example.declaration +
            "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 3 "
            "end light instance \"lamp_i\" \"lamp\" end instance "
            "material \"glass\" \"mib_illum_lambert\" ( ) shadow \"ex_stained_glass\" ( \"stain\" "
            ".9 .5 .1 ) end material object \"pane\" visible shadow trace group -8 -8 2 8 -8 2 8 8 "
            "2 -8 8 2 v 0 v 1 v 2 v 3 c 0 1 2 3 end group end object instance \"pane_i\" \"pane\" "
            "visible off shadow on material \"glass\" end instance " +
            kLambert + UserScene::square("m"),
        "\"lamp_i\" \"square_i\" \"pane_i\"", std::string("shadow ") + mode);
    scene.indirect = false;
    const auto passes = [](double stain) {
      return static_cast<float>(mean_over_pixel(6, 5, [&](double x, double y) {
        const double cosine = 3 / std::sqrt(x * x + y * y + 9);
        return cosine * std::pow(stain, 1 / cosine);
      }));
    };
    SCOPED_TRACE(mode);
    expect_near(scene.pixel(6, 5, 1024), Rgb(passes(.9), passes(.5), passes(.1)), 3e-3f);
  }
}

TEST(Examples, DuskHasAGradientAndEmits) {
  Example example("environment", "ex_dusk.c");
  UserScene scene(
      example.folder, example.declaration + kGlow + UserScene::square("m"), "", "",
      "environment \"ex_dusk\" ( \"zenith\" 0 0 1, \"horizon\" 1 0 0, \"glow\" 0 1 0 )");
  // A view along -z with y up; on the plane z = 0 the view is x, y, -4.
  const auto view = [](double x, double y) { return std::sqrt(x * x + y * y + 16); };
  const auto blue = static_cast<float>(
      mean_over_pixel(6, 6, [&](double x, double y) { return std::sqrt(y / view(x, y)); }));
  const auto glow = static_cast<float>(
      mean_over_pixel(6, 6, [&](double x, double y) { return std::pow(4 / view(x, y), 16); }));
  expect_near(scene.pixel(6, 6, 1024), Rgb(1 - blue, glow, blue), 4e-3f);
}

TEST(Examples, FisheyeMapsDistancesToAngles) {
  Example example("lens", "ex_fisheye.c");
  UserScene scene(example.folder, example.declaration + kWhere + UserScene::square("m"),
                  "\"square_i\"", "", "lens \"ex_fisheye\" ( \"angle\" 120 )");
  const auto wanted = [&](int axis) {
    return static_cast<float>(mean_over_pixel(5, 4, [&](double x, double y) {
      const double r = std::hypot(x, y) / 4, at = axis == 0 ? x : y;
      return 4 * std::tan(r * kPi / 3) * at / 4 / r;
    }));
  };
  expect_near(scene.pixel(5, 4, 1024), Rgb(wanted(0), wanted(1), 0), .02f);
}

TEST(Examples, GroundFogDimsByTheIntegratedDensity) {
  Example example("volume", "ex_ground_fog.cpp");
  UserScene scene(example.folder, example.declaration + kGlow + UserScene::square("m"),
                  "\"square_i\"", "",
                  "volume \"ex_ground_fog\" ( \"color\" 0 1 0, \"density\" .2, \"height\" 1.5 )");
  // The density summed up along the way from (0, 0, 4), y up.
  const auto kept = static_cast<float>(mean_over_pixel(5, 5, [](double x, double y) {
    const double length = std::sqrt(x * x + y * y + 16);
    double depth = 0;
    for (int i = 0; i < 100; ++i) depth += .2 * std::exp(-y * (i + .5) / 100 / 1.5) * length / 100;
    return std::exp(-depth);
  }));
  expect_near(scene.pixel(5, 5, 1024), Rgb(.5f * kept, .5f * kept + 1 - kept, .5f * kept), 4e-3f);
}

TEST(Examples, RipplesMoveTheSurfaceUpAndDownWithTheFrames) {
  Example example("displacement", "ex_ripples.c");
  const auto height = [&](int frame) {
    UserScene scene(example.folder,
                    example.declaration +
                        "material \"m\" \"where\" ( ) displace \"ex_ripples\" ( \"centre\" 0 0 0, "
                        "\"length\" 8, \"height\" .5, \"speed\" .25 ) end material " +
                        UserScene::square("m"),
                    "\"square_i\"", "max displace 2", fmt::format("frame {} 0", frame));
    return scene.pixel(4, 4, 16).z;
  };
  // All four corners are as far from the middle, so that the square stays flat.
  const double waves = std::sqrt(128.0) / 8;
  const auto wanted = [&](int frame) {
    return static_cast<float>(.5 * std::cos(kTwoPi * (waves - .25 * frame)) / (1 + waves));
  };
  for (const int frame : {0, 1, 2}) EXPECT_NEAR(height(frame), wanted(frame), 1e-4f) << frame;
}

TEST(Examples, StairsRiseStepByStep) {
  Example example("geometry", "ex_stairs.cpp");
  UserScene scene(example.folder,
                  example.declaration + kWhere +
                      "instance \"stairs\" geometry \"ex_stairs\" ( \"steps\" 3, \"rise\" 1.6, "
                      "\"going\" .1, \"width\" 3 ) material \"m\" end instance ",
                  "\"stairs\"");
  // Seen from the front: the first riser up to 1.6, the second a going behind it.
  EXPECT_NEAR(scene.pixel(4, 4).z, 0, 1e-5f);
  EXPECT_NEAR(scene.pixel(4, 6).z, -.1f, 1e-5f);
  EXPECT_NEAR(scene.pixel(5, 6, 512).y, 2.5f * 4.1f / 4, .02f);
  // As wide as specified, and nothing below the ground.
  expect_near(scene.pixel(7, 4), Rgb(0), 0);
  expect_near(scene.pixel(4, 3), Rgb(0), 0);
}

TEST(Examples, VignetteDarkensByTheCosineToTheFourth) {
  Example example("output", "ex_vignette.c");
  UserScene scene(example.folder, example.declaration + kGlow + UserScene::square("m"),
                  "\"square_i\"", "", "output \"ex_vignette\" ( )");
  const UserPicture picture(scene, 1);
  const scene::Camera* camera = find_camera(scene.scene, scene.scene.renders.back());
  const NodeList shaders = camera_output_shaders(*camera, scene.scene, scene.host->registry(),
                                                 *scene.world, scene.diagnostics);
  const Image shown = shown_image(*picture.session, shaders, nullptr);
  for (const auto& [x, y] : {std::pair(0, 0), {4, 4}, {7, 2}}) {
    const double u = (x + .5) / 4 - 1, v = (y + .5) / 4 - 1;
    const double cosine2 = 1 / (1 + u * u + v * v);
    EXPECT_NEAR(shown.at(x, y)[0], .5 * cosine2 * cosine2, 1e-4) << x << " " << y;
  }
}

}  // namespace examples_test
}  // namespace oriel
