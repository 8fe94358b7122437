// SPDX-License-Identifier: Apache-2.0
// Preparation and tracing of any scene end with a message or an image.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "prepare/testing/prepared_scene.h"
#include "transport/path/path.h"

namespace oriel {
namespace render_robustness_test {

using testing::PreparedScene;
using testing::scene_text;

/// What became of a scene.
struct Outcome {
  bool picture = false, message = false;
  bool finite = true;
  int hits = 0;  ///< paths that saw something
  std::string messages;
};

/// Reads, prepares and traces a few paths through a coarse grid of the picture.
Outcome render(std::string_view text, int grid = 6) {
  const PreparedScene s(text);
  Outcome out;
  out.message = !s.diagnostics.all().empty();
  out.messages = s.messages();
  if (!s.world) return out;
  out.picture = true;
  const Camera& camera = s.world->camera;
  EXPECT_GT(camera.width, 0);
  EXPECT_GT(camera.height, 0);
  RayCounts counts;
  for (int y = 0; y < grid; ++y)
    for (int x = 0; x < grid; ++x)
      for (std::uint32_t sample = 0; sample < 2; ++sample) {
        const Vec2 raster((static_cast<float>(x) + .4f) / static_cast<float>(grid) *
                              static_cast<float>(camera.width),
                          (static_cast<float>(y) + .4f) / static_cast<float>(grid) *
                              static_cast<float>(camera.height));
        const Camera::Ray eye = camera.ray(raster);
        sampling::Sampler sampler(x, y, sample);
        Rgb c = trace_path(*s.world, eye, raster, {}, sampler, counts).radiance;
        for (const ShaderNode* node : s.world->lens) {
          ShadingPoint point;
          node->with_params(point, [&](const Call& call) {
            c = node->spec().lens.map_color(call, {eye.cos_to_film, camera.orthographic}, c);
          });
        }
        if (!is_finite(Vec3(c.x, c.y, c.z))) out.finite = false;
        if (!is_black(c)) ++out.hits;
      }
  return out;
}

/// A message or a picture of finite numbers.
Outcome expect_sound(std::string_view text, std::string_view what) {
  const Outcome out = render(text);
  EXPECT_TRUE(out.picture || out.message) << what;
  EXPECT_TRUE(out.finite) << what << '\n' << out.messages;
  return out;
}

constexpr std::string_view kGrey =
    "material \"m\" \"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5 ) end material\n";
constexpr std::string_view kLight =
    "light \"l\" \"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 2 0 end light\n"
    "instance \"l_inst\" \"l\" end instance\n";

std::string lit(std::string_view elements) {
  return scene_text(std::string(elements) + std::string(kLight), "\"l_inst\"");
}

TEST(RenderRobustness, BaseSceneIsValid) {
  const Outcome out = expect_sound(lit(kGrey), "plain");
  EXPECT_FALSE(out.message) << out.messages;
  EXPECT_EQ(out.hits, 72);
}

std::string object(std::string_view points, std::string_view polygons) {
  return fmt::format(
      "{}object \"bad\" visible trace shadow tagged group {} v 0 v 1 v 2 v 3 {} end group end "
      "object\n"
      "instance \"bad_inst\" \"bad\" material [ \"m\" ] end instance\n",
      kGrey, points, polygons);
}

TEST(RenderRobustness, VerticesBeyondAllNumbersDoNotHideTheRest) {
  for (const char* points :
       {"1e999 0 -3 1 0 -3 1 1 -3 0 1 -3", "3e38 0 -3 -3e38 0 -3 1 3e38 -3 0 1 -3",
        "3e38 3e38 3e38 -3e38 -3e38 -3e38 3e38 -3e38 3e38 -3e38 3e38 -3e38",
        "1e-45 0 -3 1e-45 1e-45 -3 0 1e-45 -3 0 0 -3",
        "1e20 0 -3 0 1e20 -3 -1e20 0 -3 0 -1e20 -3"}) {
    const std::string text =
        scene_text(object(points, "p 0 0 1 2 3") + std::string(kLight), "\"l_inst\" \"bad_inst\"");
    expect_sound(text, points);
  }
  // Binary vectors can hold what text cannot: NaN and infinity.
  const std::string nan("\x7f\xc0\x00\x00", 4), inf("\x7f\x80\x00\x00", 4),
      one("\x3f\x80\x00\x00", 4);
  for (const std::string& bad : {nan, inf}) {
    std::string binary = "`";
    for (int i = 0; i < 12; ++i) binary += i % 3 == 1 ? bad : one;
    binary += "`";
    expect_sound(
        scene_text(object(binary, "p 0 0 1 2 3") + std::string(kLight), "\"l_inst\" \"bad_inst\""),
        "binary");
  }
}

TEST(RenderRobustness, ZeroAreaPolygonsAreIgnored) {
  for (const char* points : {"0 0 -3 0 0 -3 0 0 -3 0 0 -3", "0 0 -3 1 0 -3 2 0 -3 3 0 -3",
                             "0 0 -3 1 0 -3 0 0 -3 1 0 -3", "0 0 -3 1 1 -3 1 0 -3 0 1 -3"})
    for (const char* polygon :
         {"p 0 0 1 2 3", "p 0 0 0 0 0", "p 0 0 1 2 3 hole 0 1 2", "c 0 0 1 2 3"}) {
      const Outcome out = expect_sound(
          scene_text(object(points, polygon) + std::string(kLight), "\"l_inst\" \"bad_inst\""),
          points);
      EXPECT_GT(out.hits, 40) << points << polygon << out.messages;
    }
}

TEST(RenderRobustness, SingularAndHugeTransformsLeaveThePicture) {
  for (const char* matrix :
       {"0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1", "1 0 0 0 1 0 0 0 1 0 0 0 0 0 0 1",
        "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 0", "1e30 0 0 0 0 1e30 0 0 0 0 1e30 0 0 0 0 1",
        "1e-30 0 0 0 0 1e-30 0 0 0 0 1e-30 0 0 0 0 1", "1 0 0 0 0 1 0 0 0 0 1 0 1e38 1e38 1e38 1",
        "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", "1e999 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"})
    for (const char* target : {"bad", "l", "cam"})
      expect_sound(
          scene_text(object("0 0 -3 1 0 -3 1 1 -3 0 1 -3", "p 0 0 1 2 3") + std::string(kLight) +
                         fmt::format("instance \"moved\" \"{}\" transform {} material [ \"m\" "
                                     "] end instance\n",
                                     target, matrix),
                     "\"l_inst\" \"moved\""),
          fmt::format("{} {}", target, matrix));
}

TEST(RenderRobustness, MissingPartsAreReported) {
  const std::string camera =
      "camera \"cam\" focal 1 aperture 1 aspect 1 resolution 8 8 end camera instance \"ci\" "
      "\"cam\" "
      "end instance ";
  const std::string options = "options \"opt\" end options ";
  for (const std::string& text : {
           std::string(""),
           std::string("render \"root\" \"cam\" \"opt\""),
           options + "instgroup \"root\" end instgroup render \"root\" \"ci\" \"opt\"",
           options + camera + "render \"nowhere\" \"ci\" \"opt\"",
           camera + "instgroup \"root\" \"ci\" end instgroup render \"root\" \"ci\" \"opt\"",
           options + camera +
               "instgroup \"root\" \"ci\" end instgroup render \"root\" \"opt\" \"ci\"",
           options + camera +
               "instgroup \"root\" \"ci\" \"gone\" end instgroup render \"root\" "
               "\"ci\" \"opt\"",
       }) {
    const Outcome out = render(text);
    EXPECT_TRUE(out.picture || out.message || text.empty()) << text;
    EXPECT_TRUE(out.finite);
  }
}

TEST(RenderRobustness, AnEmptySceneIsABlackPicture) {
  const Outcome out = expect_sound(
      "options \"opt\" end options camera \"cam\" focal 1 aperture 1 aspect 1 resolution 8 8 end "
      "camera instance \"ci\" \"cam\" end instance instgroup \"root\" \"ci\" end instgroup render "
      "\"root\" \"ci\" \"opt\"",
      "empty");
  EXPECT_TRUE(out.picture);
  EXPECT_EQ(out.hits, 0);
}

TEST(RenderRobustness, WithoutLightsThePictureIsBlack) {
  const Outcome out = expect_sound(scene_text(kGrey), "no lights");
  EXPECT_EQ(out.hits, 0);
}

TEST(RenderRobustness, InvalidCameraValuesGiveAnImage) {
  for (const char* camera : {"focal 0",
                             "focal -1",
                             "focal 1e38",
                             "focal 1e-38",
                             "aperture 0",
                             "aperture -2",
                             "aperture 1e38",
                             "aspect 0",
                             "aspect -1",
                             "aspect 1e-30",
                             "resolution 0 0",
                             "resolution -5 10",
                             "resolution 2000000000 2000000000",
                             "resolution 1 1",
                             "focal infinity",
                             "focal infinity aperture 0",
                             "clip 5 1",
                             "clip -1e38 1e38",
                             "window 5 5 1 1",
                             "window -100 -100 1000000000 1000000000",
                             "window 1e38 1e38 -1e38 -1e38",
                             "offset 1e38 -1e38",
                             "offset 0 0"})
    for (const char* size : {"", "resolution 0 7"}) {
      const std::string text =
          "options \"opt\" end options camera \"cam\" focal 1 aperture 1 aspect 1 resolution 8 8 " +
          fmt::format("{} {}", camera, size) +
          " end camera instance \"ci\" \"cam\" end instance instgroup \"root\" \"ci\" end "
          "instgroup "
          "render \"root\" \"ci\" \"opt\"";
      const PreparedScene s(text);
      ASSERT_TRUE(s.world) << camera << s.messages();
      const Camera& c = s.world->camera;
      EXPECT_GE(c.width, 1);
      EXPECT_GE(c.height, 1);
      EXPECT_TRUE(c.window[0] >= 0 && c.window[0] < c.window[2] && c.window[2] <= c.width)
          << camera;
      EXPECT_TRUE(c.window[1] >= 0 && c.window[1] < c.window[3] && c.window[3] <= c.height)
          << camera;
      expect_sound(text, camera);
    }
}

TEST(RenderRobustness, SizeOverridesApplyToAllCameras) {
  for (const char* size : {"resolution 0 0", "resolution -3 5", "resolution 8 8", ""}) {
    const std::string text =
        "options \"opt\" end options camera \"cam\" focal 1 aperture 1 " + std::string(size) +
        " offset 1 1 window 0 0 3 3 end camera instance \"ci\" \"cam\" end instance instgroup "
        "\"root\" \"ci\" end instgroup render \"root\" \"ci\" \"opt\"";
    const PreparedScene s(text, builtin_shaders(), {.width = 20, .height = 10});
    ASSERT_TRUE(s.world) << s.messages();
    const Camera::Ray ray = s.world->camera.ray(Vec2(3.5f, 3.5f));
    EXPECT_TRUE(is_finite(ray.direction)) << size;
    EXPECT_TRUE(is_finite(Vec3(s.world->camera.aspect, s.world->camera.offset.x, 0))) << size;
  }
}

TEST(RenderRobustness, MaterialsAndLightsWithoutShadersAreShownAllTheSame) {
  expect_sound(lit("material \"m\" end material\n"), "empty material");
  expect_sound(lit(""), "no material at all");
  expect_sound(lit("material \"m\" = \"nobody\" end material\n"), "dangling reference");
  expect_sound(
      lit("material \"m\" \"not_a_shader\" ( \"a\" 1 ) shadow \"nor_this\" ( ) end material\n"),
      "unknown shaders");
  expect_sound(lit("material \"m\" \"mib_light_point\" ( ) end material\n"), "a light as material");
  expect_sound(scene_text(std::string(kGrey) + "light \"l\" origin 0 2 0 end light instance "
                                               "\"li\" \"l\" end instance",
                          "\"li\""),
               "light without shader");
  expect_sound(scene_text(std::string(kGrey) + "light \"l\" \"mia_material\" ( ) origin 0 2 0 end "
                                               "light instance \"li\" \"l\" end instance",
                          "\"li\""),
               "a material as light");
}

TEST(RenderRobustness, LightsOfAnyMakeGiveFiniteLight) {
  for (const char* shape : {"origin 0 2 0",
                            "origin 0 2 0 rectangle 0 0 0 0 0 0",
                            "origin 0 2 0 rectangle 1 0 0 2 0 0",
                            "origin 0 2 0 rectangle 1e38 0 0 0 0 1e38",
                            "origin 0 2 0 disc 0 0 0 1",
                            "origin 0 2 0 disc 0 -1 0 0",
                            "origin 0 2 0 disc 0 -1 0 -1",
                            "origin 0 2 0 sphere 0",
                            "origin 0 2 0 sphere -1",
                            "origin 0 2 0 sphere 1e38",
                            "origin 0 0 -5 sphere 1",
                            "origin 0 2 0 cylinder 0 0 0 1",
                            "origin 0 2 0 cylinder 1 0 0 0",
                            "direction 0 0 0",
                            "direction 1e38 0 0",
                            "direction 0 -1 0",
                            "origin 0 0 -5",
                            "origin 1e38 0 0",
                            "origin 0 2 0 direction 0 0 0 spread .5",
                            "origin 0 2 0 direction 0 -1 0 spread -7",
                            "origin 0 2 0 direction 0 -1 0 spread 1",
                            "origin 0 2 0 sphere 1 exponent -40",
                            "origin 0 2 0 exponent 40"})
    for (const char* shader :
         {"\"mib_light_point\" ( \"color\" 1 1 1, \"atten\" on, \"start\" 5, \"stop\" 5 )",
          "\"mib_light_spot\" ( \"color\" 1 1 1, \"cone\" 2 )",
          "\"mib_light_infinite\" ( \"color\" 1 1 1 )",
          "\"physical_light\" ( \"color\" 100 100 100, \"cos_exp\" 1e30 )",
          "\"mia_physicalsun\" ( )"})
      expect_sound(
          scene_text(std::string(kGrey) + fmt::format("light \"l\" {} {} visible end light "
                                                      "instance \"li\" \"l\" end instance",
                                                      shader, shape),
                     "\"li\""),
          fmt::format("{} {}", shape, shader));
}

// Each parameter of each built-in material at values no artist writes.
TEST(RenderRobustness, MaterialsSurviveAbsurdParameters) {
  for (const ShaderSpec* spec : builtin_shaders().all()) {
    if (!spec->material.fill) continue;
    for (const ParamSpec& row : spec->params) {
      std::vector<std::string> values;
      switch (row.type) {
        case ParamType::Scalar:
        case ParamType::Integer:
          values = {"0", "-1", "1e38", "-1e38", "1e-38"};
          if (row.type == ParamType::Integer) values = {"0", "-1", "2147483647", "-2147483648"};
          break;
        case ParamType::Boolean:
          values = {"on", "off"};
          break;
        case ParamType::Color:
          values = {"-1 -1 -1", "1e38 1e38 1e38", "1e38 -1e38 0"};
          break;
        case ParamType::Vector:
          values = {"0 0 -1", "1e38 -1e38 1e38", "1e-38 0 0"};
          break;
        default:
          break;
      }
      for (const std::string& value : values)
        for (const char* base : {"",
                                 "\"transparency\" .5, \"refr_gloss\" .5, \"refl_gloss\" .5, "
                                 "\"brdf_fresnel\" on, "}) {
          const bool mia = std::string_view(spec->name).starts_with("mia_material");
          if (!mia && *base) continue;
          const Outcome out = render(
              lit(fmt::format("shader \"s\" \"{}\" ( {}\"{}\" {} )\nmaterial \"m\" = \"s\" shadow "
                              "= \"s\" end material\n",
                              spec->name, mia ? base : "\"diffuse\" .5 .5 .5, ", row.name, value)),
              3);
          EXPECT_TRUE(out.picture) << spec->name << row.name;
          // Colours that overflow may be infinite; other parameters never make them so.
          if (row.type != ParamType::Color) {
            EXPECT_TRUE(out.finite) << spec->name << '.' << row.name << ' ' << value << ' ' << base;
          }
        }
    }
  }
}

TEST(RenderRobustness, SkiesAndSunsSurviveAbsurdParameters) {
  for (const char* name : {"mia_physicalsky", "mia_physicalsun"}) {
    const ShaderSpec* spec = builtin_shaders().find(name);
    for (const ParamSpec& row : spec->params) {
      if (row.type != ParamType::Scalar && row.type != ParamType::Vector) continue;
      for (const char* value : {"0", "-100", "1e30", "-1e30"}) {
        const std::string call = fmt::format(
            "\"{}\" ( \"{}\" {} )", name, row.name,
            row.type == ParamType::Vector ? fmt::format("{0} {0} {0}", value) : std::string(value));
        const bool sky = std::string_view(name) == "mia_physicalsky";
        const Outcome out =
            render(scene_text(std::string(kGrey) +
                                  fmt::format("light \"l\" {} direction 0 -1 -1 end light "
                                              "instance \"li\" \"l\" end instance",
                                              sky ? "\"mia_physicalsun\" ( )" : call),
                              "\"li\"", sky ? fmt::format("environment {}", call) : std::string()),
                   2);
        EXPECT_TRUE(out.picture) << call;
        const bool scales = std::string_view(row.name) == "multiplier" ||
                            std::string_view(row.name).find("intensity") != std::string_view::npos;
        if (!scales) {
          EXPECT_TRUE(out.finite) << call;
        }
      }
    }
  }
}

TEST(RenderRobustness, CyclicGroupsAndShadersEnd) {
  expect_sound(
      scene_text(
          std::string(kGrey) +
              "instgroup \"a\" \"b_inst\" end instgroup instance \"a_inst\" \"a\" end instance "
              "instgroup \"b\" \"a_inst\" end instgroup instance \"b_inst\" \"b\" end "
              "instance\n",
          "\"a_inst\""),
      "groups");
  expect_sound(lit("shader \"x\" \"mib_illum_lambert\" ( \"diffuse\" = \"x\" )\n"
                   "material \"m\" = \"x\" end material\n"),
               "own");
  expect_sound(lit("shader \"x\" \"mib_texture_remap\" ( \"input\" = \"y\" )\n"
                   "shader \"y\" \"mib_texture_remap\" ( \"input\" = \"x\" )\n"
                   "material \"m\" \"mia_material\" ( \"diffuse\" = \"x\", \"bump\" \"y\" ) end "
                   "material\n"),
               "round");
  expect_sound(lit("color texture \"t\" \"mib_texture_lookup\" ( \"tex\" \"t\" )\n"
                   "material \"m\" \"mia_material\" ( \"diffuse\" = shader \"k\" "
                   "\"mib_texture_lookup\" ( \"tex\" \"t\" ) ) end material\n"),
               "texture");
  expect_sound(
      lit("declare phenomenon material \"p\" ( ) material \"i\" \"p\" ( ) end material root "
          "material \"i\" end declare material \"m\" \"p\" ( ) end material\n"),
      "root material of itself");
}

TEST(RenderRobustness, DeepPhenomenaAndLongChainsEnd) {
  std::string text =
      "declare phenomenon color \"p0\" ( color \"c\" ) root \"mib_illum_lambert\" ( \"diffuse\" = "
      "interface \"c\" ) end declare\n";
  for (int i = 1; i < 1000; ++i)
    text += fmt::format(
        "declare phenomenon color \"p{0}\" ( color \"c\" ) shader \"in\" \"p{1}\" ( \"c\" = "
        "interface "
        "\"c\" ) root = \"in\" end declare\n",
        i, i - 1);
  expect_sound(lit(text + "material \"m\" \"p999\" ( \"c\" .5 .5 .5 ) end material\n"),
               "phenomena");
  text = "shader \"n0\" \"mib_texture_vector\" ( )\n";
  for (int i = 1; i < 5000; ++i)
    text += fmt::format("shader \"n{}\" \"mib_texture_remap\" ( \"input\" = \"n{}\" )\n", i, i - 1);
  expect_sound(lit(text + "material \"m\" \"mib_illum_lambert\" ( \"diffuse\" = \"n4999\" ) end "
                          "material\n"),
               "chain, last first");
  // Bound from the other end no binding is deep, but the evaluation would be.
  std::string members;
  for (int i = 0; i < 5000; i += 100) {
    text += fmt::format(
        "material \"k{0}\" \"mib_illum_lambert\" ( \"diffuse\" = \"n{0}\" ) end material\n", i);
    text += fmt::format("instance \"ki{0}\" \"square\" material [ \"k{0}\" ] end instance\n", i);
    members += fmt::format("\"ki{}\" ", i);
  }
  const auto start = std::chrono::steady_clock::now();
  expect_sound(scene_text(text + std::string(kGrey) + std::string(kLight), members + "\"l_inst\""),
               "chain, first first");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(RenderRobustness, ListsShorterThanTheirLabelsDoNotCrash) {
  for (const char* list : {"[ ]", "[ \"m\" ]", "[ \"m\", \"nobody\" ]", "[ \"\" ]"})
    expect_sound(
        scene_text(object("-9 -9 -3 9 -9 -3 9 9 -3 -9 9 -3", "p 7 0 1 2 p 4000000000 0 2 3") +
                       std::string(kLight) +
                       fmt::format("instance \"again\" \"bad\" material {} end instance\n", list),
                   "\"l_inst\" \"again\""),
        list);
}

TEST(RenderRobustness, MissingTexturesAndProfilesLeaveAPicture) {
  const Outcome out =
      expect_sound(lit("color texture \"t\" \"/nowhere.png\"\nmaterial \"m\" \"mib_illum_lambert\" "
                       "( \"diffuse\" = "
                       "shader \"k\" \"mib_texture_lookup\" ( \"tex\" \"t\" ) ) end material\n"),
                   "texture");
  EXPECT_TRUE(out.picture && out.message);
  EXPECT_GT(out.hits, 0);
  expect_sound(scene_text(kGrey, {}, "environment \"mib_lookup_spherical\" ( \"tex\" \"gone\" )"),
               "environment");
}

TEST(RenderRobustness, LensesSurviveAbsurdParameters) {
  for (const char* name : {"mia_exposure_photographic", "mia_exposure_simple"}) {
    for (const ParamSpec& row : builtin_shaders().find(name)->params) {
      if (row.type != ParamType::Scalar) continue;
      for (const char* value : {"0", "-1", "1e38", "-1e38"})
        expect_sound(scene_text(std::string(kGrey) + std::string(kLight), "\"l_inst\"",
                                fmt::format("lens \"{}\" ( \"{}\" {} )", name, row.name, value)),
                     fmt::format("{}.{} {}", name, row.name, value));
    }
  }
}

}  // namespace render_robustness_test
}  // namespace oriel
