// SPDX-License-Identifier: Apache-2.0
// Maya's textures, their placement and bumps: shaders/maya/maya_texture.cpp.
#include <algorithm>
#include <cmath>

#include "cases.h"
#include "maya_stages.h"
#include "prepare/testing/prepared_scene.h"

namespace oriel::effects {
namespace maya_texture {
namespace {

/// "gradient": a picture whose red is u and whose green is v, times kSteepness; linear from the
/// centres of its first texels to those of its last.
constexpr int kTexels = 20;
constexpr float kSteepness = 200 / 255.0f;
std::string gradient() {
  std::string text = fmt::format("color texture \"gradient\" [{0} {0} 3]\n", kTexels);
  const auto byte = [](int i) { return (2 * i + 1) * 200 / (2 * kTexels); };
  for (int y = 0; y < kTexels; ++y) {
    text += " '";
    for (int x = 0; x < kTexels; ++x) text += fmt::format("{:02x}{:02x}00", byte(x), byte(y));
    text += "'\n";
  }
  return text;
}
Rgb texel_at(const Vec2& uv) {
  const auto within = [](float x) { return (x - std::floor(x)) * kSteepness; };
  return Rgb(within(uv.x), within(uv.y), 0);
}

/// The placement shader, measured by the colour that a connected file shows of the gradient.
Stage by_file(const Vec2& at) {
  return [=](const std::string& call) {
    return member(
        "outColor", kMayaPlaces + gradient() + "shader \"place\" " + call + "\n",
        place_of(at.x, at.y))(call_of("maya_file",
                                      "fileTextureName \"gradient\", uvCoord = \"place.outUV\", "
                                      "defaultColor 0 0 1"));
  };
}

/// Where a point of the surface is looked up, by a parameter of a placement.
struct Lookup {
  const char *parameter, *others;
  Vec2 at;
  std::vector<std::pair<const char*, Vec2>> values;
};

/// A placement cuts a frame out of the surface: turned, moved, of the size `coverage`. In it are
/// tiles: repeated, moved, every other one mirrored or shifted, turned.
std::vector<Lookup> lookups() {
  const Vec2 at(.3f, .6f), right(.7f, .6f), upper(.3f, .7f);
  return {
      {"coverage", "", at, {{"1 1 0", at}, {".5 .8 0", {.6f, .75f}}, {"2 4 0", {.15f, .15f}}}},
      {"translateFrame", "", at, {{"0 0 0", at}, {".1 .2 0", {.2f, .4f}}}},
      {"rotateFrame",
       "translateFrame .1 0 0",
       at,
       {{"0", {.2f, .6f}}, {"1.5707963", {.3f, .3f}}, {"90", {.3f, .3f}}, {"180", {.6f, .4f}}}},
      {"mirrorU", "repeatUV 2 1 0", right, {{"off", {1.4f, .6f}}, {"on", {1.6f, .6f}}}},
      {"mirrorU", "repeatUV 2 1 0", at, {{"off", {.6f, .6f}}, {"on", {.6f, .6f}}}},
      {"mirrorV", "repeatUV 1 2 0", upper, {{"off", {.3f, 1.4f}}, {"on", {.3f, 1.6f}}}},
      {"mirrorV", "repeatUV 1 1.5 0", at, {{"off", {.3f, .9f}}, {"on", {.3f, .9f}}}},
      {"stagger", "repeatUV 1 2 0", upper, {{"off", {.3f, 1.4f}}, {"on", {.8f, 1.4f}}}},
      {"stagger", "repeatUV 1 1.5 0", at, {{"off", {.3f, .9f}}, {"on", {.3f, .9f}}}},
      {"repeatUV", "", at, {{"1 1 0", at}, {"3 .5 0", {.9f, .3f}}}},
      {"offset", "repeatUV 2 1 0", at, {{"0 0 0", {.6f, .6f}}, {".1 .2 0", {.7f, .8f}}}},
      {"rotateUV", "offset .1 0 0", at, {{"0", {.4f, .6f}}, {"1.5707963", {.4f, .4f}}}},
      {"rotateUV", "offset .1 0 0", at, {{"180", {.6f, .4f}}, {"-90", {.6f, .6f}}}},
  };
}

/// The placement's rows of a shader, measured on the gradient. `call`: further parameters.
void add_placement(Cases& all, const std::string& shader, const std::string& call,
                   const std::function<Stage(const Vec2&)>& stage) {
  for (const Lookup& lookup : lookups()) {
    std::vector<Given> values;
    for (const auto& [text, uv] : lookup.values) values.push_back({text, texel_at(uv)});
    add_or_join(all,
                gives(shader + lookup.parameter, stage(lookup.at), call + lookup.others, values));
  }
  // A frame over the left, or lower, half of each unit; the point is in the next one, at .3.
  for (const bool u : {true, false}) {
    const std::string frame =
        u ? "coverage .5 1 0, translateFrame -1 0 0" : "coverage 1 .5 0, translateFrame 0 -1 0";
    add_or_join(
        all, gives(shader + (u ? "wrapU" : "wrapV"), stage(Vec2(.3f)), call + frame,
                   {{"on", texel_at(u ? Vec2(.6f, .3f) : Vec2(.3f, .6f))}, {"off", Rgb(0, 0, 1)}}));
  }
  const std::string wobbling = shader + "noiseUV";
  add_or_join(all, shows(wobbling, [=] {
                const auto moved = [&](const Vec2& at, const char* strength) {
                  const std::string name = shader.substr(0, shader.find('.'));
                  const Rgb c = stage(at)(call_of(name, call + "noiseUV " + strength)).mean;
                  return (Vec2(c.x, c.y) - Vec2(texel_at(at).x, texel_at(at).y)) * (1 / kSteepness);
                };
                Vec2 most(0);
                for (int i = 0; i < 8; ++i) {
                  const Vec2 at(.35f + .04f * float(i), .62f - .03f * float(i));
                  const Vec2 once = moved(at, ".1 .1 0"), twice = moved(at, ".2 .2 0");
                  const Vec2 along_u = moved(at, ".1 0 0");
                  // Proportional to the strength, along each direction on its own.
                  EXPECT_NEAR(twice.x, 2 * once.x, 1e-3f);
                  EXPECT_NEAR(twice.y, 2 * once.y, 1e-3f);
                  EXPECT_NEAR(along_u.x, once.x, 1e-3f);
                  EXPECT_NEAR(along_u.y, 0, 1e-3f);
                  most =
                      Vec2(std::max(most.x, std::abs(once.x)), std::max(most.y, std::abs(once.y)));
                }
                EXPECT_GT(most.x, .01f);
                EXPECT_GT(most.y, .01f);
                EXPECT_LT(std::max(most.x, most.y), .1f);
              }));
}

void add_place2d(Cases& all) {
  const std::string name = "maya_place2dtex.";
  // An unconnected value is ignored: the surface's coordinate counts.
  add_or_join(all, gives(name + "uvCoord", by_file(Vec2(.3f, .6f)), "",
                         {{".9 .9 0", texel_at(Vec2(.3f, .6f))},
                          {"= \"there\"", texel_at(Vec2(.2f, .4f))}}));
  add_placement(all, name, "", by_file);
  // The coordinate distinguishes the tiles.
  Cases exact;
  for (const Lookup& lookup : lookups()) {
    std::vector<Given> values;
    for (const auto& [text, uv] : lookup.values) values.push_back({text, Rgb(uv.x, uv.y, 0)});
    exact.push_back(gives(name + lookup.parameter,
                          member("outUV", {}, place_of(lookup.at.x, lookup.at.y)), lookup.others,
                          values));
  }
  for (Case& c : all)
    for (const Case& further : exact)
      if (c.parameter == further.parameter) c = both(c, further);
}

/// A texture, and the parameters with which it is of one colour and alpha.
struct Uniform {
  std::string shader, call;
  Rgb color;
  float alpha;
};
const std::string kPlain = "color texture \"plain\" [1 1 4] '336699cc'\n";

/// The rows of the colour's balance.
void add_balance(Cases& all, const Uniform& t) {
  const std::string name = t.shader + ".";
  const std::string elements = kMayaSources + kMayaPlaces + kPlain;
  const Stage color = member("outColor", elements), alpha = member("outAlpha", elements);
  const Stage transparency = member("outTransparency", elements);
  const Rgb gain(2, .5f, 1), offset(.1f, 0, .2f);
  add_or_join(
      all, gives(name + "invert", color, t.call + "colorGain 2 .5 1, colorOffset .1 0 .2",
                 {{"off", t.color * gain + offset}, {"on", (Rgb(1) - t.color) * gain + offset}}));
  const float luminance = .3f * t.color.x + .59f * t.color.y + .11f * t.color.z;
  add_or_join(all, gives(name + "alphaIsLuminance", alpha, t.call + "alphaGain 2, alphaOffset .1",
                         {{"off", Rgb(t.alpha * 2 + .1f)}, {"on", Rgb(luminance * 2 + .1f)}}));
  add_or_join(all, gives(name + "colorGain", color, t.call + "colorOffset .1 0 .2",
                         {{"1 1 1", t.color + offset},
                          {"2 .5 1", t.color * gain + offset},
                          {"= \"tint\"", t.color * kMayaTint + offset}}));
  add_or_join(all, gives(name + "colorOffset", color, t.call + "colorGain 2 .5 1",
                         {{"0 0 0", t.color * gain},
                          {".1 0 .2", t.color * gain + offset},
                          {"= \"tint\"", t.color * gain + kMayaTint}}));
  const std::string gained = t.call + "alphaGain 2", moved = t.call + "alphaOffset .1";
  add_or_join(all, gives(name + "alphaGain", alpha, moved,
                         {{"1", Rgb(t.alpha + .1f)}, {"2", Rgb(2 * t.alpha + .1f)}}));
  add_or_join(all, gives(name + "alphaGain", transparency, moved,
                         {{".25", Rgb(.9f - .25f * t.alpha)}, {".5", Rgb(.9f - .5f * t.alpha)}}));
  add_or_join(all, gives(name + "alphaOffset", alpha, gained,
                         {{"0", Rgb(2 * t.alpha)}, {".1", Rgb(2 * t.alpha + .1f)}}));
  add_or_join(all, gives(name + "alphaOffset", transparency, t.call + "alphaGain .5",
                         {{"0", Rgb(1 - .5f * t.alpha)}, {".1", Rgb(.9f - .5f * t.alpha)}}));
  add_or_join(all, gives(name + "defaultColor", color, t.call + "uvCoord = \"outside.outUV\"",
                         {{"1 0 .5", Rgb(1, 0, .5f)}, {"= \"tint\"", kMayaTint}}));
  add_or_join(all, gives(name + "defaultColor", color, t.call + "uvCoord = \"inside.outUV\"",
                         {{"1 0 .5", t.color}, {"= \"tint\"", t.color}}));
}

void add_file(Cases& all) {
  const std::string name = "maya_file.";
  const std::string call = "fileTextureName \"gradient\", defaultColor 0 0 1, ";
  const auto stage = [](const Vec2& at) {
    return member("outColor", kMayaPlaces + gradient(), place_of(at.x, at.y));
  };
  add_or_join(all, gives(name + "uvCoord", stage(Vec2(.3f, .6f)), call,
                         {{".9 .9 0", texel_at(Vec2(.3f, .6f))},
                          {"= \"there\"", texel_at(Vec2(.2f, .4f))}}));
  // The file's own placement acts only on the surface's coordinate.
  add_or_join(all, gives(name + "uvCoord", stage(Vec2(.3f, .6f)), call + "repeatUV 2 1.5 0",
                         {{".9 .9 0", texel_at(Vec2(.6f, .9f))},
                          {"= \"there\"", texel_at(Vec2(.2f, .4f))}}));
  add_placement(all, name, call, stage);
  add_balance(all, {"maya_file", "fileTextureName \"plain\", ", Rgb(.2f, .4f, .6f), .8f});
  add_or_join(all, gives(name + "fileTextureName",
                         member("outColor", kPlain + "color texture \"red\" [1 1 3] 'ff0000'\n"),
                         "", {{"\"plain\"", Rgb(.2f, .4f, .6f)}, {"\"red\"", Rgb(1, 0, 0)}}));
}

void add_checker(Cases& all) {
  const std::string name = "maya_checker.";
  const auto at = [](float u, float v) {
    return member("outColor", kMayaSources + kMayaPlaces, place_of(u, v));
  };
  const Rgb one(1, 0, .5f), two(0, .5f, .25f);
  const std::string colors = "color1 1 0 .5, color2 0 .5 .25, ";
  // The surface's own coordinate is in a field of the second colour, "there" in one of the first.
  add_or_join(
      all, gives(name + "uvCoord", at(.6f, .4f), colors, {{".2 .4 0", two}, {"= \"there\"", one}}));
  add_balance(all, {"maya_checker", "color1 .2 .4 .6, color2 .2 .4 .6, ", Rgb(.2f, .4f, .6f), 1});
  const struct {
    float u, v;
    bool first;
  } fields[] = {{.4f, .4f, true}, {.6f, .6f, true}, {.6f, .4f, false}, {.4f, .6f, false}};
  for (const char* row : {"color1", "color2", "contrast"})
    for (const auto& field : fields) {
      const Stage stage = at(field.u, field.v);
      // With a contrast of .5 a field has three quarters of its own colour.
      const bool its_own = field.first == (std::string(row) == "color1");
      const float share = its_own ? .75f : .25f;
      const Rgb here = field.first ? one : two, there = field.first ? two : one;
      const Rgb other = (its_own ? there : here) * (1 - share);
      if (std::string(row) == "contrast")
        add_or_join(
            all,
            gives(name + row, stage, colors,
                  {{"0", (one + two) * .5f}, {".5", here * .75f + there * .25f}, {"1", here}}));
      else
        add_or_join(all, gives(name + row, stage, colors + "contrast .5",
                               {{"0 0 0", other},
                                {"1 2 4", other + Rgb(1, 2, 4) * share},
                                {"= \"tint\"", other + kMayaTint * share}}));
    }
}

/// Red of the texture at those coordinates of the surface.
std::vector<float> reds(const std::string& call, const std::vector<Vec2>& places) {
  const Probe probe(testing::scene_text("shader \"seen\" " + call +
                                        "\nmaterial \"m\" \"maya_surfaceshader\" ( \"outColor\" = "
                                        "\"seen.outColor\" ) end material\n"),
                    testing::test_registry());
  std::vector<float> found;
  for (const Vec2& place : places) {
    const Vec2 at = place_of(place.x, place.y), raster(at.x * 16, at.y * 12);
    found.push_back(
        probe
            .over(1, [&](sampling::Sampler&,
                         int) { return std::pair(probe.world().camera.ray(raster), raster); })
            .mean.x);
  }
  return found;
}

/// How much values change over `step` along u, in standard deviations of all values.
float fineness(const std::string& call, float step) {
  std::vector<Vec2> places;
  constexpr int kAlong = 12;
  for (int i = 0; i < kAlong * kAlong; ++i) {
    // Over the visible part of the square.
    const Vec2 at(.4f + .2f * float(i % kAlong) / kAlong, .42f + .15f * float(i / kAlong) / kAlong);
    places.push_back(at);
    places.push_back(at + Vec2(step, 0));
  }
  const std::vector<float> values = reds(call, places);
  double sum = 0, squares = 0, changes = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += values[i];
    squares += values[i] * values[i];
    if (i % 2) changes += (values[i] - values[i - 1]) * (values[i] - values[i - 1]);
  }
  const double n = double(values.size()), variance = squares / n - sum / n * (sum / n);
  EXPECT_GT(variance, 1e-4) << "no noise";
  return static_cast<float>(std::sqrt(changes / (n / 2) / variance));
}

/// The texture gets finer from value to value.
Case finer(const std::string& parameter, const std::string& others,
           const std::vector<std::string>& values) {
  return shows(parameter, [=] {
    const std::size_t dot = parameter.find('.');
    float before = 0;
    for (const std::string& each : values) {
      const float now = fineness(
          call_of(parameter.substr(0, dot), others + ", " + parameter.substr(dot + 1) + " " + each),
          .004f);
      EXPECT_GT(now, 1.1f * before) << parameter << ' ' << each;
      before = now;
    }
  });
}

/// `fixed`: the value at an amplitude of 0.
void add_noise(Cases& all, const std::string& shader, const std::string& sizes, float fixed) {
  const std::string name = shader + ".";
  add_or_join(all, shows(name + "uvCoord", [shader] {
                const auto at = [&](const std::string& coordinate, float u, float v) {
                  return member("outColor", kMayaPlaces,
                                place_of(u, v))(call_of(shader, "uvCoord " + coordinate));
                };
                const Measured there = at("0 0 0", .2f, .4f), here = at("0 0 0", .55f, .53f);
                EXPECT_GT(std::abs(there.mean.x - here.mean.x), .01f);
                EXPECT_NEAR(at("= \"there\"", .55f, .53f).mean.x, there.mean.x, 1e-3f);
              }));
  add_balance(all,
              {shader, fmt::format("amplitude 0, threshold {}, ", .6f - fixed), Rgb(.6f), .6f});
  add_or_join(all, gives(name + "threshold", member("outColor"), "amplitude 0",
                         {{"0", Rgb(fixed)},
                          {".2", Rgb(fixed + .2f)},
                          {"-.3", Rgb(std::max(0.0f, fixed - .3f))},
                          {"2", Rgb(1)}}));
  // Maya's help: of the noise it scales all values about their average, of the fractal all values.
  add_or_join(
      all, shows(name + "amplitude", [shader, fixed] {
        const std::vector<Vec2> places = {{.45f, .5f}, {.51f, .47f}, {.54f, .52f}, {.57f, .55f}};
        const auto with = [&](const char* x) {
          return reds(call_of(shader, std::string("amplitude ") + x), places);
        };
        const std::vector<float> none = with("0"), some = with(".2"), twice = with(".4");
        for (std::size_t i = 0; i < places.size(); ++i) {
          EXPECT_NEAR(none[i], fixed, 1e-5f);
          EXPECT_NEAR(twice[i] - fixed, 2 * (some[i] - fixed), 1e-5f);
        }
        // Brighter and darker places than the mean, at a fifth of the amplitude.
        const float mean = fixed + .2f * (.5f - fixed);
        EXPECT_GT(*std::max_element(some.begin(), some.end()), mean + .005f);
        EXPECT_LT(*std::min_element(some.begin(), some.end()), mean - .005f);
      }));
  // Each size is weaker by the ratio: with 0 only the first is left.
  add_or_join(all, finer(name + "ratio", sizes + " 4", {"0", ".4", ".8"}));
  add_or_join(all, shows(name + "ratio", [=] {
                const auto with = [&](const std::string& list) {
                  return reds(call_of(shader, list), {{.52f, .53f}, {.47f, .51f}});
                };
                EXPECT_EQ(with("ratio 0, " + sizes + " 4"), with(sizes + " 1"));
              }));
  add_or_join(all, finer(name + "frequencyRatio", sizes + " 2, ratio .8", {"1.2", "2", "4"}));
  add_or_join(all, finer(name + "frequency", sizes + " 2", {"4", "8", "16"}));
  // A grain is 1 / frequency wide.
  add_or_join(all, shows(name + "frequency", [=] {
                const auto at = [&](const char* frequency, float u, float v) {
                  return reds(call_of(shader, sizes + " 2, frequency " + frequency), {{u, v}})[0];
                };
                EXPECT_NEAR(at("16", .26f, .27f), at("8", .52f, .54f), 1e-3f);
                EXPECT_NEAR(at("5", .5f, .6f), at("10", .25f, .3f), 1e-3f);
              }));
  add_or_join(all, finer(name + sizes, "ratio .8", {"1", "2", "3", "5"}));
}

void add_bump(Cases& all) {
  const std::string name = "maya_bump2d.";
  // Heights that fall by 1 over the 20 units of the square, along u or along v.
  std::string elements =
      "shader \"tilted\" \"maya_xyz_to_vector\" ( \"x\" .6, \"y\" 0, \"z\" .8 )\n";
  for (const bool u : {true, false})
    elements += fmt::format(
        "shader \"{}\" \"maya_ramp\" ( \"type\" {}, \"colorEntryList\" [ {{ \"position\" 0, "
        "\"color\" 1 1 1 }}, {{ \"position\" 1, \"color\" 0 0 0 }} ] )\n",
        u ? "along_u" : "along_v", u ? 1 : 0);
  const Stage stage = value(elements);
  const auto normal = [](float x, float y) { return normalize(Vec3(x, y, 1)); };
  const auto is = [=](const std::string& row, const std::string& others, const std::string& text,
                      const Vec3& expected) {
    return shows(name + row, [=] {
      const Rgb n = stage(call_of("maya_bump2d", others + ", " + row + " " + text)).mean;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(n[k], expected[k], 2e-4f) << row << ' ' << text;
    });
  };
  add_or_join(all, is("bumpValue", "bumpDepth 10", "5", normal(0, 0)));
  add_or_join(all, is("bumpValue", "bumpDepth 10", "= \"along_u.outAlpha\"", normal(.5f, 0)));
  add_or_join(all, is("bumpValue", "bumpDepth 10", "= \"along_v.outAlpha\"", normal(0, .5f)));
  for (const int depth : {0, 1, 5, 20})
    add_or_join(all, is("bumpDepth", "bumpValue = \"along_u.outAlpha\"", std::to_string(depth),
                        normal(float(depth) / 20, 0)));
  add_or_join(all, is("normalCamera", "", "1 1 1", normal(0, 0)));
  add_or_join(all, is("normalCamera", "", "= \"tilted\"", Vec3(.6f, 0, .8f)));
  // Over the other bump: that normal, turned by 45 degrees toward v.
  add_or_join(all, is("normalCamera", "bumpDepth 20, bumpValue = \"along_v.outAlpha\"",
                      "= \"tilted\"", normalize(Vec3(.6f, 1, .8f))));
}

}  // namespace
}  // namespace maya_texture

Cases maya_texture_cases() {
  using namespace maya_texture;
  Cases all;
  add_place2d(all);
  add_file(all);
  add_checker(all);
  add_noise(all, "maya_noise", "depthMax", .5f);
  add_noise(all, "maya_fractal", "levelMax", 0);
  add_bump(all);
  return all;
}

}  // namespace oriel::effects
