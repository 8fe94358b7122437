// SPDX-License-Identifier: Apache-2.0
// Colours from numbers and from other colours: shaders/base/mib_color.cpp.
#include <fmt/format.h>

#include "cases.h"
#include "color/luminance.h"

namespace oriel::effects {
namespace {

/// The three shaders that make a grey of a colour: `grey` is theirs of (.2, .4, .6, .5).
void add_grey(Cases& all, const std::string& shader, float grey) {
  const Rgb twice(2 * grey);
  all.push_back(gives(shader + ".input", value(), "factor 2",
                      {{".2 .4 .6 .5", twice}, {".4 .8 1.2 1", twice * 2.0f}}));
  all.push_back(gives(shader + ".factor", value(), "input .2 .4 .6 .5",
                      {{"0", Rgb(0)}, {"1", Rgb(grey)}, {"2", twice}}));
}

/// A different colour for each of eight places.
Rgb color_of(int i) { return Rgb(.1f * float(i + 1), .9f - .1f * float(i), i % 2 ? .75f : .25f); }
std::string text_of_color(const Rgb& c) { return fmt::format("{} {} {} 1", c.x, c.y, c.z); }

/// Eight colours, color_1 to color_6 at sevenths.
std::string ramp() {
  std::string list = "num 8";
  for (int i = 0; i < 8; ++i) list += fmt::format(", color_{} {}", i, text_of_color(color_of(i)));
  for (int i = 1; i < 7; ++i) list += fmt::format(", weight_{} {}", i, float(i) / 7);
  return list;
}

void add_interpolate(Cases& all) {
  const std::string name = "mib_color_interpolate.";
  all.push_back(gives(name + "input", value(), ramp(),
                      {{"-1", color_of(0)},
                       {"0", color_of(0)},
                       {fmt::format("{}", 1.5f / 7), (color_of(1) + color_of(2)) * .5f},
                       {"1", color_of(7)},
                       {"2", color_of(7)}}));
  all.push_back(gives(name + "num", value(), ramp() + ", input 1",
                      {{"1", color_of(0)}, {"2", color_of(1)}, {"8", color_of(7)}}));
  for (int i = 0; i < 8; ++i)
    all.push_back(gives(fmt::format("{}color_{}", name, i), value(),
                        fmt::format("{}, input {}", ramp(), float(i) / 7),
                        {{"1 .5 .25 1", Rgb(1, .5f, .25f)}, {"0 0 2 1", Rgb(0, 0, 2)}}));
  // At its own place there is its colour: elsewhere at that place, that of the interval around it.
  for (int i = 1; i < 7; ++i) {
    const float here = float(i) / 7, further = (float(i) + .5f) / 7;
    all.push_back(gives(fmt::format("{}weight_{}", name, i), value(),
                        fmt::format("{}, input {}", ramp(), here),
                        {{fmt::format("{}", here), color_of(i)},
                         {fmt::format("{}", further),
                          color_of(i - 1) + (color_of(i) - color_of(i - 1)) * (1 / 1.5f)}}));
  }
}

void add_mix(Cases& all) {
  const std::string name = "mib_color_mix.";
  const Rgb base(.5f, .25f, .75f), layer(.8f, 1, .2f);
  const std::string below = "color_base .5 .25 .75 1";
  const std::string over = "color_{0} .8 1 .2 .5, weight_{0} .5";
  all.push_back(gives(name + "color_base", value(), "num 0",
                      {{".5 .25 .75 1", base}, {"1 0 2 1", Rgb(1, 0, 2)}}));
  all.push_back(gives(name + "num", value(),
                      below + ", color_0 1 0 0 1, weight_0 1, mode_0 2, color_1 0 1 0 1, "
                              "weight_1 1, mode_1 2",
                      {{"0", base}, {"1", base + Rgb(1, 0, 0)}, {"2", base + Rgb(1, 1, 0)}}));
  for (int i = 0; i < 8; ++i) {
    // What layers before it leave alone: adding black.
    std::string list = fmt::format("{}, num {}, ", below, i + 1);
    for (int k = 0; k < i; ++k) list += fmt::format("mode_{0} 2, weight_{0} 0, ", k);
    const std::string mine = fmt::format(fmt::runtime(over), i);
    all.push_back(gives(fmt::format("{}mode_{}", name, i), value(), list + mine,
                        {{"0", base * .75f + layer * .5f},  // blend: the layer's alpha is .5
                         {"1", base * .5f + layer * .5f},
                         {"2", base + layer * .5f},
                         {"3", Rgb(.9f, .75f, .85f)},
                         {"4", base * layer * .5f},
                         {"5", base * layer * .5f},
                         {"6", base}}));
    const std::string added = fmt::format("{}, mode_{} 2", list + mine, i);
    all.push_back(gives(fmt::format("{}weight_{}", name, i), value(), added,
                        {{"0", base}, {"1", base + layer}}));
    all.push_back(gives(fmt::format("{}color_{}", name, i), value(), added,
                        {{"0 0 0 0", base}, {"1 0 2 0", base + Rgb(.5f, 0, 1)}}));
  }
  // The two that bound do so.
  all.back() = both(all.back(), gives(all.back().parameter, value(),
                                      "color_base .9 .9 .9 1, num 8, weight_7 1, mode_7 3",
                                      {{".5 .05 0 1", Rgb(1, .95f, .9f)}, {"0 0 0 1", Rgb(.9f)}}));
}

void add_spread(Cases& all) {
  const std::string name = "mib_color_spread.";
  const Rgb input(.2f, .4f, .6f);
  for (int i = 0; i < 8; ++i) {
    const Stage out = member(fmt::format("out_{}", i));
    const std::string list = fmt::format("input .2 .4 .6 .5, num 8, weight_{} 1 1 1 1", i);
    all.push_back(gives(fmt::format("{}mode_{}", name, i), out, list,
                        {{"0", input},
                         {"1", Rgb(.5f)},
                         {"2", Rgb(.4f)},
                         {"3", Rgb(luminance(input, kNtscLuminance))},
                         {"4", Rgb(.2f)}}));
    all.push_back(gives(fmt::format("{}weight_{}", name, i), out, list,
                        {{"1 1 1 1", input}, {".5 0 2 1", Rgb(.1f, 0, 1.2f)}}));
  }
  const std::string first = "num 8, weight_0 1 1 1 1, weight_7 1 1 1 1, input .2 .4 .6 .5";
  all.push_back(gives(name + "input", member("out_0"), first,
                      {{".2 .4 .6 1", input}, {"1 0 0 1", Rgb(1, 0, 0)}}));
  all.push_back(gives(name + "num", member("out_7"), first, {{"7", Rgb(0)}, {"8", input}}));
}

void add_temperatures(Cases& all) {
  for (const char* shader : {"mib_cie_d", "mib_blackbody"}) {
    const std::string name = std::string(shader) + ".";
    all.push_back(shows(name + "temperature", [shader] {
      // Warm is red, cold is blue; both of the same luminance as the standard's tables have it.
      const auto color = [&](const char* kelvin) {
        return value()(call_of(shader, fmt::format("intensity 1, temperature {}", kelvin))).mean;
      };
      const Rgb warm = color("4500"), middle = color("6500"), cold = color("12000");
      EXPECT_GT(warm.x / warm.z, middle.x / middle.z);
      EXPECT_GT(middle.x / middle.z, cold.x / cold.z);
      EXPECT_NEAR(middle.x / middle.z, 1, .12f);  // the white of sRGB is D65
    }));
    all.push_back(scales(name + "intensity", value(), "temperature 5000", "1", "3", 3));
  }
}

}  // namespace

Cases base_color_cases() {
  Cases all;
  add_grey(all, "mib_color_alpha", .5f);
  add_grey(all, "mib_color_average", .4f);
  add_grey(all, "mib_color_intensity", .2f * .299f + .4f * .587f + .6f * .114f);
  add_interpolate(all);
  add_mix(all);
  add_spread(all);
  add_temperatures(all);
  return all;
}

}  // namespace oriel::effects
