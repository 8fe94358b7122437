// SPDX-License-Identifier: Apache-2.0
// Maya's ramp: shaders/maya/maya_ramp.cpp.
#include <algorithm>
#include <cmath>

#include "cases.h"
#include "maya_stages.h"

namespace oriel::effects {
namespace maya_ramp {
namespace {

constexpr int kEntries = 16;
const std::string kName = "maya_ramp.";

/// outColor at that coordinate.
Stage at_coordinate(float u, float v, const std::string& result = "outColor") {
  return [=](const std::string& call) {
    const std::string elements =
        kMayaSources + kMayaPlaces +
        fmt::format("shader \"here\" \"maya_uvw_to_vector\" ( \"u\" {}, \"v\" {} )\n", u, v);
    // A case may connect a coordinate of its own.
    const std::string own = call.find("uvCoord") == std::string::npos
                                ? call.substr(0, call.size() - 1) + ", \"uvCoord\" = \"here\" )"
                                : call;
    return member(result, elements)(own);
  };
}

/// Colours at places, and between them the mixture of the nearest two.
using Entries = std::vector<std::pair<float, Rgb>>;
Rgb mixed(Entries entries, float t) {
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  if (t <= entries.front().first) return entries.front().second;
  for (std::size_t i = 1; i < entries.size(); ++i) {
    const auto& [from, below] = entries[i - 1];
    const auto& [to, above] = entries[i];
    if (t <= to) return below + (above - below) * ((t - from) / (to - from));
  }
  return entries.back().second;
}
Entries rainbow() {
  Entries all;
  for (int i = 0; i < kEntries; ++i)
    all.emplace_back(float(i) / (kEntries - 1),
                     Rgb(.05f * float(i), 1 - .06f * float(i), i % 2 ? .75f : .25f));
  return all;
}
/// Those entries as parameters.
std::string text_of_entries(const Entries& entries) {
  std::string text = fmt::format("colorEntryList[] {}", entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i)
    text += fmt::format(", colorEntryList[{0}].position {1}, colorEntryList[{0}].color {2}", i,
                        entries[i].first, text_of(entries[i].second));
  return text;
}

void add_entries(Cases& all) {
  const Entries entries = rainbow();
  const std::string list = text_of_entries(entries);
  for (std::size_t i = 0; i < kEntries; ++i) {
    const std::string row = fmt::format("{}colorEntryList[{}].", kName, i);
    // A quarter of an interval above its own place, the last one a quarter below.
    const float step = 1.0f / (kEntries - 1), side = i + 1 < kEntries ? 1 : -1;
    const float t = entries[i].first + side * step / 4;
    std::vector<Given> positions, colors;
    for (const float moved : {0.0f, .1f * step, .6f * step}) {
      Entries with = entries;
      with[i].first += side * moved;
      positions.push_back({fmt::format("{}", with[i].first), mixed(with, t)});
    }
    for (const auto& [text, color] : std::initializer_list<std::pair<const char*, Rgb>>{
             {"1 2 4", Rgb(1, 2, 4)}, {"0 0 0", Rgb(0)}, {"= \"tint\"", kMayaTint}}) {
      Entries with = entries;
      with[i].second = color;
      colors.push_back({text, mixed(with, t)});
    }
    all.push_back(gives(row + "position", at_coordinate(.5f, t), list, positions));
    all.push_back(gives(row + "color", at_coordinate(.5f, t), list, colors));
  }
  std::vector<Given> counts;
  for (const int count : {1, 2, 7, 8, kEntries})
    counts.push_back(
        {std::to_string(count), mixed(Entries(entries.begin(), entries.begin() + count), .45f)});
  const Case count = gives(kName + "colorEntryList[]", at_coordinate(.5f, .45f), list, counts);
  all.push_back(both(count, shows(count.parameter, [] {
                       // As scenes write it, in any order.
                       const std::string call =
                           "\"maya_ramp\" ( \"colorEntryList\" [ "
                           "{ \"position\" 1, \"color\" 1 0 0 }, "
                           "{ \"position\" 0, \"color\" 0 1 0 }, "
                           "{ \"position\" .5, \"color\" 0 0 1 } ] )";
                       const auto at = [&](float t) { return at_coordinate(.5f, t)(call); };
                       analytic::expect_exact("lower half", at(.25f), Rgb(0, .5f, .5f));
                       analytic::expect_exact("upper half", at(.75f), Rgb(.5f, 0, .5f));
                     })));
}

}  // namespace
}  // namespace maya_ramp

Cases maya_ramp_cases() {
  using namespace maya_ramp;
  Cases all;
  const std::string grey = text_of_entries({{0, Rgb(0)}, {1, Rgb(1)}});
  all.push_back(both(gives(kName + "uvCoord", member("outColor", kMayaPlaces, place_of(.3f, .6f)),
                           grey, {{".9 .9 0", Rgb(.6f)}, {"= \"there\"", Rgb(.4f)}}),
                     gives(kName + "uvCoord", member("outColor", kMayaPlaces, place_of(.3f, .6f)),
                           grey + ", type 1", {{".9 .9 0", Rgb(.3f)}, {"= \"there\"", Rgb(.2f)}})));
  // V ramp, U ramp, diagonal, radial, circular, box; (.3, .6) is (-.2, .1) from the middle.
  all.push_back(gives(kName + "type", at_coordinate(.3f, .6f), grey,
                      {{"0", Rgb(.6f)},
                       {"1", Rgb(.3f)},
                       {"2", Rgb(.45f)},
                       {"3", Rgb(.5f + std::atan2(.1f, -.2f) / kTwoPi)},
                       {"4", Rgb(std::sqrt(2 * (.04f + .01f)))},
                       {"5", Rgb(.4f)}}));
  all.push_back(gives(kName + "interpolation", at_coordinate(.3f, .6f), grey,
                      {{"0", Rgb(0)},
                       {"1", Rgb(.6f)},
                       {"2", Rgb(.36f)},
                       {"3", Rgb(1 - .16f)},
                       {"4", Rgb(3 * .36f - 2 * .216f)}}));
  const std::string one = text_of_entries({{0, Rgb(.5f, .25f, 1)}}) + ", ";
  const Rgb color(.5f, .25f, 1), gain(2, .5f, 1), offset(.1f, 0, .2f);
  const Stage here = at_coordinate(.5f, .5f), alpha = at_coordinate(.5f, .5f, "outAlpha");
  const auto luminance = [](const Rgb& c) { return Rgb(.3f * c.x + .59f * c.y + .11f * c.z); };
  all.push_back(both(gives(kName + "colorGain", here, one + "colorOffset .1 0 .2",
                           {{"1 1 1", color + offset},
                            {"2 .5 1", color * gain + offset},
                            {"= \"tint\"", color * kMayaTint + offset}}),
                     gives(kName + "colorGain", alpha, one,
                           {{"1 1 1", luminance(color)}, {"2 .5 1", luminance(color * gain)}})));
  all.push_back(both(gives(kName + "colorOffset", here, one + "colorGain 2 .5 1",
                           {{"0 0 0", color * gain},
                            {".1 0 .2", color * gain + offset},
                            {"= \"tint\"", color * gain + kMayaTint}}),
                     gives(kName + "colorOffset", alpha, one,
                           {{"0 0 0", luminance(color)}, {".1 0 .2", luminance(color + offset)}})));
  all.push_back(both(gives(kName + "defaultColor", here, one + "uvCoord = \"outside.outUV\"",
                           {{"1 0 .5", Rgb(1, 0, .5f)}, {"= \"tint\"", kMayaTint}}),
                     gives(kName + "defaultColor", here, one + "uvCoord = \"inside.outUV\"",
                           {{"1 0 .5", color}, {"= \"tint\"", color}})));
  add_entries(all);
  return all;
}

}  // namespace oriel::effects
