// SPDX-License-Identifier: Apache-2.0
// Maya's utilities: shaders/maya/maya_arithmetic.cpp, maya_conversions.cpp, maya_surroundings.cpp.
#include <cmath>

#include "cases.h"
#include "maya_stages.h"
#include "prepare/testing/prepared_scene.h"
#include "runtime/color_mapping.h"

namespace oriel::effects {
namespace maya_arithmetic {
namespace {

/// With the sources to connect.
Case gives_tint(const std::string& parameter, const std::string& others,
                const std::vector<Given>& values) {
  return gives(parameter, value(kMayaSources), others, values);
}

void add_products(Cases& all) {
  all.push_back(gives_tint("maya_reverse.input", "",
                           {{".25 1 0", Rgb(.75f, 0, 1)}, {"= \"tint\"", Rgb(.8f, .6f, .4f)}}));
  const std::string name = "maya_multdiv.";
  all.push_back(gives(name + "operation", value(), "input1 .5 1 2, input2 2 4 .5",
                      {{"0", Rgb(.5f, 1, 2)},
                       {"1", Rgb(1, 4, 1)},
                       {"2", Rgb(.25f, .25f, 4)},
                       {"3", Rgb(.25f, 1, std::sqrt(2.0f))}}));
  all.push_back(gives_tint(name + "input1", "operation 2, input2 2 4 .5",
                           {{"1 2 3", Rgb(.5f, .5f, 6)}, {"= \"tint\"", Rgb(.1f, .1f, 1.2f)}}));
  all.push_back(
      gives_tint(name + "input2", "operation 2, input1 2 4 6",
                 {{"1 2 4", Rgb(2, 2, 1.5f)}, {"= \"tint\"", Rgb(10)}, {"0 1 1", Rgb(0, 4, 6)}}));
}

/// The term (x, 2x, 3x) of one, two or three components, as text and as it is shown.
std::string text_of_term(int size, float x) {
  return size == 1 ? fmt::format("{}", x)
                   : fmt::format("{} {} {}", x, 2 * x, size == 3 ? 3 * x : 0);
}
Rgb shown_term(int size, float x) {
  return size == 1 ? Rgb(x) : Rgb(x, 2 * x, size == 3 ? 3 * x : 0);
}

void add_sums(Cases& all) {
  const std::string name = "maya_plusminusavg.";
  std::vector<Case> operations;
  for (int size = 1; size <= 3; ++size) {
    const Stage out = member(fmt::format("output{}D", size));
    const auto term = [&](float x) { return text_of_term(size, x); };
    const auto sum = [&](float x) { return shown_term(size, x); };
    const std::string list = fmt::format("input{}D", size);
    const std::string three =
        fmt::format("{0}[0] {1}, {0}[1] {2}, {0}[2] {3}", list, term(4), term(.5f), term(1.5f));
    operations.push_back(gives(name + "operation", out, three + ", " + list + "[] 3",
                               {{"0", sum(4)}, {"1", sum(6)}, {"2", sum(2)}, {"3", sum(2)}}));
    const Case count = gives(name + list + "[]", out, three,
                             {{"0", sum(0)}, {"1", sum(4)}, {"2", sum(4.5f)}, {"3", sum(6)}});
    const std::string array =
        fmt::format("{} [ {}, {}, {} ]", list, term(4), term(.5f), term(1.5f));
    all.push_back(both(count, shows(count.parameter, [out, array, sum = sum(6)] {
                         analytic::expect_exact("array", out(call_of("maya_plusminusavg", array)),
                                                sum);
                       })));
    // The last of i + 1 terms, the first of which is 4, in the sum, the difference and the mean.
    for (int i = 0; i < 16; ++i) {
      const std::string row = fmt::format("{}{}[{}]", name, list, i);
      const std::string others =
          fmt::format("{}[] {}, {}[0] {}, operation ", list, i + 1, list, term(i == 0 ? 0 : 4));
      const float first = i == 0 ? 0 : 4, sign = i == 0 ? 1 : -1, share = 1 / float(i + 1);
      const auto values = [&](float factor, float all_of) {
        return std::vector<Given>{{term(1), sum((first + factor) * all_of)},
                                  {term(3), sum((first + 3 * factor) * all_of)}};
      };
      all.push_back(both(gives(row, out, others + "1", values(1, 1)),
                         both(gives(row, out, others + "2", values(sign, 1)),
                              gives(row, out, others + "3", values(1, share)))));
    }
  }
  all.push_back(both(operations[0], both(operations[1], operations[2])));
}

void add_mapping(Cases& all) {
  all.push_back(gives("maya_blend.blender", value(kMayaSources), "color1 1 0 .5, color2 0 1 .25",
                      {{"0", Rgb(0, 1, .25f)},
                       {".25", Rgb(.25f, .75f, .3125f)},
                       {"1", Rgb(1, 0, .5f)},
                       {"= \"half\"", Rgb(.5f, .5f, .375f)}}));
  all.push_back(gives_tint("maya_blend.color1", "blender .25, color2 0 0 0",
                           {{"1 2 4", Rgb(.25f, .5f, 1)}, {"= \"tint\"", kMayaTint * .25f}}));
  all.push_back(gives_tint("maya_blend.color2", "blender .25, color1 0 0 0",
                           {{"1 2 4", Rgb(.75f, 1.5f, 3)}, {"= \"tint\"", kMayaTint * .75f}}));
  all.push_back(gives_tint(
      "maya_gamma.value", "gamma 2 1 .5",
      {{".25 .25 .25", Rgb(.5f, .25f, .0625f)}, {"= \"tint\"", Rgb(std::sqrt(.2f), .4f, .36f)}}));
  all.push_back(gives("maya_gamma.gamma", value(), "value .25 .25 .25",
                      {{"1 1 1", Rgb(.25f)}, {"2 .5 1", Rgb(.5f, .0625f, .25f)}}));
  all.push_back(gives_tint("maya_clamp.input", "min .1 .5 .2, max .5 .8 .4",
                           {{".3 .6 .3", Rgb(.3f, .6f, .3f)},
                            {"-1 0 9", Rgb(.1f, .5f, .4f)},
                            {"= \"tint\"", Rgb(.2f, .5f, .4f)}}));
  all.push_back(gives("maya_clamp.min", value(), "input .3 .4 .5, max 1 1 1",
                      {{"0 0 0", Rgb(.3f, .4f, .5f)}, {".1 .6 .7", Rgb(.3f, .6f, .7f)}}));
  all.push_back(gives("maya_clamp.max", value(), "input .3 .4 .5",
                      {{"1 1 1", Rgb(.3f, .4f, .5f)}, {"1 .2 .1", Rgb(.3f, .2f, .1f)}}));
  // The range 2 to 6 is mapped to 10 to 20: 3 lies at a quarter.
  const std::string name = "maya_setrange.";
  const std::string ranges = "value 3 3 3, oldMin 2 2 2, oldMax 6 6 6, min 10 10 10, max 20 20 20";
  all.push_back(gives(name + "value", value(), ranges,
                      {{"2 3 4", Rgb(10, 12.5f, 15)}, {"5 6 3", Rgb(17.5f, 20, 12.5f)}}));
  all.push_back(gives(name + "min", value(), ranges,
                      {{"10 10 10", Rgb(12.5f)}, {"0 20 12", Rgb(5, 20, 14)}}));
  all.push_back(gives(name + "max", value(), ranges,
                      {{"20 20 20", Rgb(12.5f)}, {"10 50 0", Rgb(10, 20, 7.5f)}}));
  all.push_back(gives(name + "oldMin", value(), ranges,
                      {{"2 2 2", Rgb(12.5f)}, {"3 0 -9", Rgb(10, 15, 18)}}));
  all.push_back(gives(name + "oldMax", value(), ranges,
                      {{"6 6 6", Rgb(12.5f)}, {"4 3 12", Rgb(15, 20, 11)}}));
  // "Luminance = 0.3 red + 0.59 green + 0.11 blue": Maya's help.
  all.push_back(gives_tint("maya_luminance.value", "",
                           {{"1 0 0", Rgb(.3f)},
                            {"0 1 0", Rgb(.59f)},
                            {"0 0 1", Rgb(.11f)},
                            {"= \"tint\"", Rgb(.2f * .3f + .4f * .59f + .6f * .11f)}}));
}

void add_condition(Cases& all) {
  const std::string name = "maya_condition.";
  const Rgb yes(.1f, .2f, .3f), no(.7f, .8f, .9f);
  const std::string colors = "colorIfTrue .1 .2 .3, colorIfFalse .7 .8 .9, ";
  // Equal, not equal, greater, greater or equal, less, less or equal.
  const auto operation = [&](const std::string& terms, std::vector<bool> holds) {
    std::vector<Given> values;
    for (std::size_t i = 0; i < 6; ++i)
      values.push_back({fmt::format("{}", i), holds[i] ? yes : no});
    return gives(name + "operation", value(), colors + terms, values);
  };
  all.push_back(
      both(operation("firstTerm 2, secondTerm 1", {false, true, true, true, false, false}),
           both(operation("firstTerm 2, secondTerm 2", {true, false, false, true, false, true}),
                operation("firstTerm 1, secondTerm 2", {false, true, false, false, true, true}))));
  all.push_back(gives(name + "firstTerm", value(kMayaSources), colors + "operation 2, secondTerm 1",
                      {{".5", no}, {"1", no}, {"1.5", yes}, {"= \"half\"", no}}));
  all.push_back(gives(name + "secondTerm", value(kMayaSources), colors + "operation 2, firstTerm 1",
                      {{".5", yes}, {"1", no}, {"1.5", no}, {"= \"half\"", yes}}));
  all.push_back(gives_tint(name + "colorIfTrue", "operation 0",
                           {{"1 0 2", Rgb(1, 0, 2)}, {"= \"tint\"", kMayaTint}}));
  all.push_back(gives_tint(name + "colorIfFalse", "operation 1",
                           {{"1 0 2", Rgb(1, 0, 2)}, {"= \"tint\"", kMayaTint}}));
}

void add_conversions(Cases& all) {
  const struct {
    const char *join, *part, *whole;
    const char* names[3];
  } pairs[] = {{"maya_rgb_to_color", "maya_color_to_rgb", "color", {"r", "g", "b"}},
               {"maya_xyz_to_vector", "maya_vector_to_xyz", "vector", {"x", "y", "z"}},
               {"maya_uvw_to_vector", "maya_vector_to_uvw", "vector", {"u", "v", "w"}}};
  for (const auto& each : pairs) {
    const std::string parted = fmt::format("{}.{}", each.part, each.whole);
    std::vector<Case> parts;
    for (int i = 0; i < 3; ++i) {
      const auto with = [&](float x) {
        Rgb c(.1f, .2f, .3f);
        c[i] = x;
        return c;
      };
      all.push_back(
          gives(fmt::format("{}.{}", each.join, each.names[i]), value(kMayaSources),
                fmt::format("{} .1, {} .2, {} .3", each.names[0], each.names[1], each.names[2]),
                {{"0", with(0)}, {"2", with(2)}, {"= \"half\"", with(.5f)}}));
      parts.push_back(gives(parted, member(each.names[i], kMayaSources), "",
                            {{"1 2 3", Rgb(float(i + 1))}, {"= \"tint\"", Rgb(kMayaTint[i])}}));
    }
    all.push_back(both(parts[0], both(parts[1], parts[2])));
  }
}

/// The colour (.0025, .25, .8) mapped by the shader as a lens shader.
Measured through_lens(const std::string& call) {
  const testing::PreparedScene s(
      testing::scene_text("material \"m\" \"maya_lambert\" ( ) end material", "", "lens " + call));
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  Measured m;
  m.mean = map_color(s.world->lens, *s.world, Vec2(.5f), Rgb(.0025f, .25f, .8f));
  return m;
}

void add_surroundings(Cases& all) {
  for (const std::string shader : {"maya_displace.", "maya_material_displace."}) {
    all.push_back(gives(shader + "displacement", value(kMayaSources), "scale 3",
                        {{"0", Rgb(0)}, {"2", Rgb(6)}, {"= \"half\"", Rgb(1.5f)}}));
    all.push_back(gives(shader + "scale", value(kMayaSources), "displacement 2",
                        {{"1", Rgb(2)}, {"3", Rgb(6)}, {"= \"half\"", Rgb(1)}}));
  }
  const auto around = [](const Vec3& direction) {
    return gives("maya_envcolor.color", environment(direction), "",
                 {{".2 .4 .6", kMayaTint}, {"1 0 2", Rgb(1, 0, 2)}});
  };
  all.push_back(both(around(Vec3(0, 0, 1)), around(Vec3(1, -2, 0))));
  // 0 is the curve of sRGB: IEC 61966-2-1, linear below .0031308.
  const auto curve = [](float x) { return 1.055f * std::pow(x, 1 / 2.4f) - .055f; };
  const auto power = [](float gamma) {
    return Rgb(std::pow(.0025f, 1 / gamma), std::pow(.25f, 1 / gamma), std::pow(.8f, 1 / gamma));
  };
  all.push_back(gives("maya_colormanagement.gamma", through_lens, "",
                      {{"0", Rgb(12.92f * .0025f, curve(.25f), curve(.8f))},
                       {"1", power(1)},
                       {"2.2", power(2.2f)}}));
}

}  // namespace
}  // namespace maya_arithmetic

Cases maya_arithmetic_cases() {
  using namespace maya_arithmetic;
  Cases all;
  add_products(all);
  add_sums(all);
  add_mapping(all);
  add_condition(all);
  add_conversions(all);
  add_surroundings(all);
  return all;
}

}  // namespace oriel::effects
