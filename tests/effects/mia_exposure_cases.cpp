// SPDX-License-Identifier: Apache-2.0
// Exposures and their reverse: shaders/architectural/mia_exposure.cpp and mia_exposure_rev.cpp.
#include <fmt/format.h>

#include "base/math.h"
#include "cases.h"
#include "color/luminance.h"
#include "mia_stages.h"
#include "output/camera_output.h"
#include "prepare/testing/prepared_scene.h"
#include "render/session.h"
#include "runtime/color_mapping.h"

namespace oriel::effects {
namespace mia_exposure {

const std::string kPhotographic = "mia_exposure_photographic";
/// A plain gain of 1.
const std::string kLinear =
    "cm2_factor 1, film_iso 0, vignetting 0, burn_highlights 1, crush_blacks 0, gamma 1";
/// Sunny 16, else linear: 1 / kSunny of the input (ISO 12232, saturation-based speed).
const std::string kSixteen = kLinear + ", film_iso 100, camera_shutter 100, f_number 16";
constexpr float kSunny = 1.2f * 16 * 16 * 100;

const Rgb kColor(.8f, .5f, .2f);
/// Of the Rec. 709 weights.
const float kLuminance = .2126f * .8f + .7152f * .5f + .0722f * .2f;

/// Half of the picture's width, or height, from the optical axis: the tangent is 1 / 2.
const Vec2 kEdge(1, .5f);
const float kCosine = 1 / std::sqrt(1.25f);

Rgb saturated(const Rgb& c, float by) { return Rgb(luminance(c)) * (1 - by) + c * by; }
Rgb power(const Rgb& c, float exponent) {
  return Rgb(math::pow(c.x, exponent), math::pow(c.y, exponent), math::pow(c.z, exponent));
}

/// Each value of the exposure with the factor by which it shows a colour.
struct Factor {
  const char *parameter, *value;
  float factor;
};
/// In photographic mode, against ISO 100, 1/100 s and f/16.
const Factor kCamera[] = {
    {"cm2_factor", "1", 1},      {"cm2_factor", "3", 3},          {"film_iso", "100", 1},
    {"film_iso", "50", .5f},     {"film_iso", "400", 4},          {"camera_shutter", "100", 1},
    {"camera_shutter", "50", 2}, {"camera_shutter", "400", .25f}, {"f_number", "16", 1},
    {"f_number", "8", 4},        {"f_number", "32", .25f},
};

/// Cases of the parameters that make the exposure a factor.
template <class F>
void add_camera(Cases& all, const F& add) {
  for (const char* parameter : {"cm2_factor", "film_iso", "camera_shutter", "f_number"}) {
    std::vector<std::pair<std::string, float>> values;
    for (const Factor& f : kCamera)
      if (f.parameter == std::string(parameter)) values.emplace_back(f.value, f.factor);
    all.push_back(add(parameter, values));
  }
}

/// What the exposure makes of a colour, and its reverse of the result: the same figures.
struct Row {
  const char* parameter;
  std::string value;
  Rgb scene, shown;
  Vec2 place = Vec2(.5f);
};
const std::vector<Row>& rows() {
  static const std::vector<Row> all = [] {
    const Rgb grey(.25f);
    std::vector<Row> r = {
        // The white point's hue is shown as grey, its brightness stays.
        {"whitepoint", "1 1 1", kColor, kColor},
        {"whitepoint", "2 2 2", kColor, kColor},
        {"whitepoint", ".8 .5 .2", kColor, Rgb(kLuminance)},
        {"whitepoint", ".8 .5 .2", Rgb(1), Rgb(kLuminance) / kColor},
        // The reference's table, and the manual's ends: linear, and never above 1.
        {"burn_highlights", "1", Rgb(.1f, 1, 4), Rgb(.1f, 1, 4)},
        {"burn_highlights", ".5", Rgb(.1f, 1, 4), Rgb(.105f / 1.1f, .75f, 2.4f)},
        {"burn_highlights", ".25", Rgb(.1f, 1, 4), Rgb(.1025f / 1.1f, .625f, 1.6f)},
        {"burn_highlights", "0", Rgb(.1f, 1, 4), Rgb(.1f / 1.1f, .5f, .8f)},
        {"crush_blacks", "0", grey, grey},
        {"crush_blacks", ".2", grey, Rgb((math::pow(.25f, 1.4f) + .25f) / 2)},
        {"crush_blacks", "1", grey, Rgb((math::pow(.25f, 3.0f) + .25f) / 2)},
        {"crush_blacks", "1", Rgb(1), Rgb(1)},
        {"saturation", "1", kColor, kColor},
        {"saturation", ".5", kColor, saturated(kColor, .5f)},
        {"saturation", "1.4", kColor, saturated(kColor, 1.4f)},
        {"gamma", "1", kColor, kColor},
        {"gamma", "2", kColor, power(kColor, .5f)},
        {"gamma", ".5", kColor, power(kColor, 2)},
    };
    for (const float v : {0.0f, 1.0f, 3.0f, 6.0f})
      r.push_back(
          {"vignetting", fmt::format("{}", v), kColor, kColor * math::pow(kCosine, v), kEdge});
    return r;
  }();
  return all;
}

/// One case for each parameter of rows(), by a check of one row.
template <class F>
void add_rows(Cases& all, const std::string& shader, const F& check) {
  for (const char* parameter :
       {"whitepoint", "burn_highlights", "crush_blacks", "saturation", "gamma", "vignetting"})
    all.push_back(shows(shader + "." + parameter, [=] {
      for (const Row& row : rows()) {
        SCOPED_TRACE(fmt::format("{} {}", row.parameter, row.value));
        if (row.parameter == std::string(parameter)) check(row);
      }
    }));
}

/// The shader as lens and as output shader: displayed value for a film value of `color`.
Rgb after_output(const std::string& lens, const std::string& output, const Rgb& color) {
  const testing::PreparedScene scene(
      testing::scene_text("material \"m\" \"test_show\" ( ) end material", {},
                          (lens.empty() ? "" : "lens " + lens) + " output " + output),
      known_shaders());
  Diagnostics diagnostics;
  const NodeList shaders =
      camera_output_shaders(*find_camera(scene.scene, scene.scene.renders.back()), scene.scene,
                            known_shaders(), *scene.world, diagnostics);
  const Vec2 middle(8, 6);
  return map_output(shaders, *scene.world, middle,
                    map_color(scene.world->lens, *scene.world, middle, color), color);
}

/// The lens' copy multiplies by 9, the output's by 1/2.
Rgb side_by_side(const std::string& lens, const std::string& output) {
  return after_output(call_of(kPhotographic, kLinear + ", cm2_factor 9, " + lens),
                      call_of(kPhotographic, kLinear + ", cm2_factor .5, " + output), kColor);
}

void add_side_channel(Cases& all) {
  all.push_back(shows(kPhotographic + ".side_channel_mode", [] {
    const auto with = [](int mode) {
      const std::string both = fmt::format("side_channel \"raw\", side_channel_mode {}", mode);
      return side_by_side(both, both);
    };
    expect_about(with(0), kColor * 4.5f, 1e-4f);  // one after the other
    expect_about(with(1), kColor * .5f, 1e-4f);   // the output's copy maps what the lens was given
    expect_about(with(2), kColor, 1e-4f);         // it puts that back
    // The lens' copy shows its own while rendering.
    for (const char* mode : {"0", "1", "2"})
      expect_about(measured_with(kPhotographic + ".side_channel_mode", lens_map(kColor),
                                 kLinear + ", cm2_factor 9, side_channel \"raw\"", mode)
                       .mean,
                   kColor * 9.0f, 1e-4f);
  }));
  all.push_back(shows(kPhotographic + ".side_channel", [] {
    // Of another name it is not filled: the output's copy maps the picture.
    const std::string of = "side_channel_mode 1, side_channel ";
    expect_about(side_by_side(of + "\"a\"", of + "\"a\""), kColor * .5f, 1e-4f);
    expect_about(side_by_side(of + "\"a\"", of + "\"b\""), kColor * 4.5f, 1e-4f);
  }));
}

/// A picture of a glowing square (.25 of grey), and how many rays that took.
struct Shown {
  Rgb shown;
  std::uint64_t rays;
};
Shown rendered(const std::string& lens) {
  const testing::PreparedScene scene(
      testing::scene_text("color texture \"green\" [1 1 3] '00ff00' "
                          "color texture \"blue\" [1 1 3] '0000ff' "
                          "material \"m\" \"test_show\" ( \"scalar\" .25 ) end material",
                          {}, "lens " + lens),
      known_shaders());
  RenderSession session(*scene.world, {.budget = {.samples = 1}});
  session.run();
  return {session.film().shown(8, 6), session.rays().rays()};
}

/// A picture is mapped in place of a rendering.
void add_preview(Cases& all, const std::string& shader, const std::string& twice) {
  all.push_back(shows(shader + ".preview", [=] {
    for (const auto& [picture, color] : {std::pair("green", Rgb(0, 2, 0)), {"blue", Rgb(0, 0, 2)}})
      expect_about(rendered(call_of(shader, fmt::format("{}, use_preview on, preview \"{}\"", twice,
                                                        picture)))
                       .shown,
                   color, 1e-4f);
  }));
  all.push_back(shows(shader + ".use_preview", [=] {
    const auto with = [&](const std::string& on) {
      return rendered(call_of(shader, twice + ", preview \"green\", use_preview " + on));
    };
    const Shown off = with("off"), on = with("on");
    expect_about(off.shown, Rgb(.5f), 1e-4f);
    EXPECT_GT(off.rays, 0u);
    expect_about(on.shown, Rgb(0, 2, 0), 1e-4f);
    EXPECT_EQ(on.rays, 0u);
  }));
}

void add_photographic(Cases& all) {
  const std::string name = kPhotographic + ".";
  add_camera(all, [&](const std::string& parameter, const auto& factors) {
    std::vector<Given> values;
    for (const auto& [value, factor] : factors) values.push_back({value, kColor * factor});
    return gives(name + parameter, lens_map(kColor * kSunny), kSixteen, values);
  });
  // ISO 0 is the arbitrary mode: cm2_factor alone multiplies, the camera's numbers do nothing.
  const Stage plain = lens_map(kColor);
  for (Case& c : all) {
    const auto also = [&](std::vector<Given> values, const std::string& others) {
      c = both(c, gives(c.parameter, plain, others, values));
    };
    if (c.parameter == name + "cm2_factor")
      also({{"1", kColor}, {"3", kColor * 3.0f}}, kLinear + ", camera_shutter 7, f_number 2");
    else if (c.parameter == name + "film_iso")
      also({{"0", kColor}, {"100", kColor / kSunny}}, kSixteen);
    else
      also({{"2", kColor}, {"70", kColor}}, kLinear);
  }
  add_rows(all, kPhotographic, [](const Row& row) {
    expect_about(measured_with(kPhotographic + "." + row.parameter, lens_map(row.scene, row.place),
                               kLinear, row.value)
                     .mean,
                 row.shown, 1e-4f);
  });
  for (Case& c : all)
    if (c.parameter == name + "vignetting")
      c = both(c, gives(c.parameter, lens_map(kColor, kEdge, "focal infinity"), kLinear,
                        {{"0", kColor}, {"6", kColor}}));
  add_side_channel(all);
  add_preview(all, kPhotographic, kLinear + ", cm2_factor 2");
}

void add_simple(Cases& all) {
  const std::string shader = "mia_exposure_simple", name = shader + ".";
  const std::string linear = "compression 0, gamma 1";
  const Stage stage = lens_map(kColor);
  all.push_back(
      gives(name + "pedestal", stage, linear + ", gain 2",
            {{"0", kColor * 2.0f}, {".1", (kColor + Rgb(.1f)) * 2.0f}, {"-.3", Rgb(1, .4f, 0)}}));
  all.push_back(
      gives(name + "gain", stage, linear, {{"0", Rgb(0)}, {"1", kColor}, {"3", kColor * 3.0f}}));
  // After the gain: values above the knee are compressed by the ratio, others are unchanged.
  const auto squashed = [](float knee, float ratio) {
    Rgb c = kColor * 2.0f;
    for (int k = 0; k < 3; ++k)
      if (c[k] > knee) c[k] = knee + (c[k] - knee) / (1 + ratio);
    return c;
  };
  all.push_back(gives(name + "knee", stage, "gain 2, gamma 1, compression 2",
                      {{".2", squashed(.2f, 2)},
                       {".5", squashed(.5f, 2)},
                       {"1.2", squashed(1.2f, 2)},
                       {"9", kColor * 2.0f}}));
  all.push_back(gives(name + "compression", stage, "gain 2, gamma 1, knee .75",
                      {{"0", kColor * 2.0f}, {"2", squashed(.75f, 2)}, {"5", squashed(.75f, 5)}}));
  all.push_back(gives(name + "gamma", stage, "compression 0",
                      {{"1", kColor}, {"2", power(kColor, .5f)}, {"4", power(kColor, .25f)}}));
  add_preview(all, shader, linear + ", gain 2");
}

void add_reverse(Cases& all) {
  const std::string shader = kPhotographic + "_rev", name = shader + ".";
  SceneText scene;
  scene.statement("shader \"blue\" \"test_show\" ( \"color\" 0 .2 1 )");
  const Stage ahead = seen_by(RayKind::Eye, Vec3(0, 0, -1), scene);
  const std::string input = ", input " + text_of(Vec3(kColor));
  all.push_back(gives(name + "input", ahead, kLinear + ", cm2_factor 2",
                      {{".8 .5 .2 1", kColor * .5f},
                       {"0 1 .3 1", Rgb(0, .5f, .15f)},
                       {"= \"blue\"", Rgb(0, .1f, .5f)}}));
  add_camera(all, [&](const std::string& parameter, const auto& factors) {
    std::vector<Given> values;
    for (const auto& [value, factor] : factors) values.push_back({value, kColor * kSunny / factor});
    if (parameter == "film_iso") values.push_back({"0", kColor});
    return gives(name + parameter, ahead, kSixteen + input, values);
  });
  add_rows(all, shader, [=](const Row& row) {
    const Vec3 direction(row.place.x - .5f, row.place.y - .5f, -1);
    expect_about(measured_with(name + row.parameter, seen_by(RayKind::Eye, direction),
                               kLinear + ", input " + text_of(Vec3(row.shown)), row.value)
                     .mean,
                 row.scene, 1e-3f);
  });
}

}  // namespace mia_exposure

Cases mia_exposure_cases() {
  Cases all;
  mia_exposure::add_photographic(all);
  mia_exposure::add_simple(all);
  mia_exposure::add_reverse(all);
  return all;
}

}  // namespace oriel::effects
