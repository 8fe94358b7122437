// SPDX-License-Identifier: Apache-2.0
// Procedural patterns: shaders/base/mib_texture_procedural.cpp.
#include <fmt/format.h>

#include "base_stages.h"
#include "cases.h"

namespace oriel::effects {
namespace base_pattern {

/// A different colour for each of the eight boxes of a checkerboard.
Rgb color_of(int box) {
  return Rgb(.1f * float(box + 1), 1 - .1f * float(box), box % 2 ? .25f : 2);
}
/// "000" to "111": low or high side in x, y and z.
std::string digits_of(int box) {
  return fmt::format("{}{}{}", box >> 2 & 1, box >> 1 & 1, box & 1);
}
std::string text_of_color(const Rgb& c) { return text_of(Vec3(c)) + " 1"; }

void add_checkerboard(Cases& all) {
  const std::string name = "mib_texture_checkerboard.";
  std::string colors;
  for (int i = 0; i < 8; ++i)
    colors += fmt::format("color{} {}, ", digits_of(i), text_of_color(color_of(i)));
  std::vector<Given> boxes;
  const auto inside = [](int box) {
    return fmt::format("{} {} {}", box >> 2 & 1 ? .75f : .25f, box >> 1 & 1 ? .75f : .25f,
                       box & 1 ? .75f : .25f);
  };
  for (int i = 0; i < 8; ++i) boxes.push_back({inside(i), color_of(i)});
  const std::string half = colors + "xsize .5, ysize .5, zsize .5";
  all.push_back(gives(name + "coord", value(), half, boxes));
  for (int i = 0; i < 8; ++i)
    all.push_back(gives(fmt::format("{}color{}", name, digits_of(i)), value(),
                        fmt::format("{}, coord {}", half, inside(i)),
                        {{"1 .5 .25 1", Rgb(1, .5f, .25f)}, {"0 0 3 1", Rgb(0, 0, 3)}}));
  // At .4 a box is on the high side of an axis whose size is below .4.
  for (int k = 0; k < 3; ++k)
    all.push_back(gives(fmt::format("{}{}size", name, kAxes[k]), value(), half + ", coord .4 .4 .4",
                        {{"0", color_of(4 >> k)},
                         {".3", color_of(4 >> k)},
                         {".5", color_of(0)},
                         {"1", color_of(0)}}));
}

/// `solid`: the dot ends in z as well.
void add_dots(Cases& all, const std::string& shader, bool solid) {
  const std::string colors = "fgcolor .8 .4 .2 1, bgcolor .1 .2 .3 1";
  const Rgb dot(.8f, .4f, .2f), ground(.1f, .2f, .3f);
  all.push_back(gives(shader + ".coord", value(), colors + ", radius .35",
                      {{".5 .5 .5", dot},
                       {"3.5 7.7 .5", dot},
                       {"0 0 .5", ground},
                       {".9 .5 .5", ground},
                       {".5 .5 .95", solid ? ground : dot}}));
  all.push_back(gives(shader + ".radius", value(), colors + ", coord .8 .5 .5",
                      {{"0", ground}, {".25", ground}, {".35", dot}}));
  const std::vector<Given> values = {{"1 .5 .25 1", Rgb(1, .5f, .25f)}, {"0 0 3 1", Rgb(0, 0, 3)}};
  all.push_back(
      gives(shader + ".fgcolor", value(), colors + ", radius .3, coord .5 .5 .5", values));
  all.push_back(gives(shader + ".bgcolor", value(), colors + ", radius .3, coord 0 .5 .5", values));
}

float turbulence(const std::string& parameters) {
  return value()(call_of("mib_texture_turbulence", parameters)).mean.x;
}

void add_turbulence(Cases& all) {
  const std::string name = "mib_texture_turbulence.", place = "coord .37 1.21 2.6";
  // Gradient noise is 0 at whole numbers, in all octaves.
  all.push_back(shows(name + "coord", [] {
    EXPECT_EQ(turbulence("coord 1 2 3, iteration 8"), 0);
    EXPECT_GT(turbulence("coord 1.37 2.21 3.6, iteration 8"), .01f);
  }));
  all.push_back(shows(name + "spacing", [place] {
    for (const float spacing : {.5f, 2.0f, 3.0f})
      EXPECT_NEAR(turbulence(fmt::format("{}, spacing {}", place, spacing)),
                  turbulence(fmt::format("coord {}", text_of(Vec3(.37f, 1.21f, 2.6f) * spacing))),
                  1e-5f);
    EXPECT_EQ(turbulence(place + ", spacing 0"), turbulence(place + ", spacing 1"));
  }));
  all.push_back(both(scales(name + "strength", value(), place, "1", "3", 3),
                     scales(name + "strength", value(), place, "0", "1", 1)));
  // A higher power weakens the finer octaves.
  all.push_back(both(falls(name + "power", value(), place, {"1", "2", "4"}),
                     scales(name + "power", value(), place, "0", "1", 1)));
  all.push_back(rises(name + "iteration", value(), place, {"1", "2", "4", "8"}));
  for (const auto& [same, as] : {std::pair("0", "2"), {"30", "8"}})
    all.back() = both(all.back(), scales(name + "iteration", value(), place, same, as, 1));
  // Lines are constant along y, cylinders along z and on circles about the axis.
  all.push_back(shows(name + "polar_dim", [] {
    const auto at = [](int dimensions, const char* coord) {
      return turbulence(fmt::format("coord {}, polar_dim {}", coord, dimensions));
    };
    const char *here = ".6 .8 .3", *along_y = ".6 .1 .3", *along_z = ".6 .8 .9",
               *around = ".2 .6 .3";
    EXPECT_NE(at(0, here), at(0, along_y));
    EXPECT_NE(at(0, here), at(0, along_z));
    EXPECT_EQ(at(1, here), at(1, along_y));
    EXPECT_NE(at(1, here), at(1, along_z));
    EXPECT_EQ(at(2, here), at(2, along_z));
    EXPECT_NEAR(at(2, here), at(2, around), 1e-5f);
    EXPECT_NE(at(2, here), at(2, along_y));
  }));
}

void add_wave(Cases& all) {
  const std::string name = "mib_texture_wave.";
  all.push_back(gives(name + "coord", value(),
                      "amplitude_x 1, amplitude_y 2, amplitude_z 4, offset 8",
                      {{"0 0 0", Rgb(15)},
                       {".5 0 0", Rgb(13)},
                       {"0 .5 0", Rgb(11)},
                       {"0 0 .5", Rgb(7)},
                       {".25 .75 1.25", Rgb(8)},
                       {"1 2 3", Rgb(15)}}));
  for (int k = 0; k < 3; ++k)
    all.push_back(
        gives(fmt::format("{}amplitude_{}", name, kAxes[k]), value(),
              fmt::format("offset 1, coord {}", text_of(with_axis(Vec3(.25f), k, 1 / 6.0f))),
              {{"0", Rgb(1)}, {"1", Rgb(1.5f)}, {"3", Rgb(2.5f)}}));
  all.push_back(gives(name + "offset", value(), "amplitude_x 1",
                      {{"0", Rgb(1)}, {".5", Rgb(1.5f)}, {"-.5", Rgb(.5f)}}));
}

Cases cases() {
  Cases all;
  add_checkerboard(all);
  add_dots(all, "mib_texture_polkadot", false);
  add_dots(all, "mib_texture_polkasphere", true);
  add_turbulence(all);
  add_wave(all);
  return all;
}

}  // namespace base_pattern

Cases base_pattern_cases() { return base_pattern::cases(); }

}  // namespace oriel::effects
