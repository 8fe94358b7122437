// SPDX-License-Identifier: Apache-2.0
// Shaders of environments, volumes and lenses, and materials that cast rays.
#include <cmath>

#include "corpus.h"

namespace oriel {
namespace corpus_rays_test {

using testing::corpus_emitter;
using testing::corpus_square;
using testing::CorpusRow;

const std::string kPlace = corpus_square("\"cp_place\" ( )");
const std::string kGradient =
    "environment \"cp_gradient\" ( \"below\" 1 0 0, \"horizon\" .5 .5 .5, \"above\" 0 0 1 )";

double view(double x, double y) { return std::sqrt(x * x + y * y + 16); }

/// What cp_place shows of a place on the plane.
Rgb place(double x, double y) { return Rgb(float(.1 * x), float(.1 * y), 0); }

CorpusRow through_lens(const std::string& name, const std::string& lens,
                       std::function<Rgb(double, double)> wanted) {
  return {name, {kPlace, "\"lamp_i\" \"square_i\"", "", "lens " + lens}, std::move(wanted)};
}

std::vector<CorpusRow> lenses() {
  std::vector<CorpusRow> rows = {
      through_lens("shift", "\"cp_shift\" ( \"x\" .25, \"y\" -.5, \"zoom\" 2 )",
                   [](double x, double y) { return place(x / 2 + 1, y / 2 - 2); }),
      through_lens("parallel", "\"cp_parallel\" ( \"width\" 4 )",
                   [](double x, double y) { return place(x / 2, y / 2); }),
      through_lens("fisheye", "\"cp_fisheye\" ( \"angle\" 90 )",
                   [](double x, double y) {
                     const double r = std::hypot(x, y) / 4;
                     if (r >= 1) return Rgb(0);
                     const double at = 4 * std::tan(r * kPi / 4) / (4 * r);
                     return place(x * at, y * at);
                   }),
      through_lens("thin_lens", "\"cp_thin_lens\" ( \"focus\" 4, \"radius\" .5 )", place),
      through_lens(
          "thin_lens/two lenses",
          "\"cp_thin_lens\" ( \"focus\" 8, \"radius\" .2 ) lens \"cp_shift\" ( \"x\" .25 )",
          [](double x, double y) { return place(x + 1, y); })};
  // Out of focus each place is the mean of the disc around it, here of radius .1.
  rows.back().tolerance = .01f;
  return rows;
}

std::vector<CorpusRow> environments() {
  const auto gradient = [](double up) {
    const float t = static_cast<float>(up);
    return t >= 0 ? Rgb(.5f) * (1 - t) + Rgb(0, 0, t) : Rgb(.5f) * (1 + t) + Rgb(-t, 0, 0);
  };
  CorpusRow mirror{"mirror",
                   {corpus_square("\"cp_mirror\" ( \"tint\" .5 1 1 )"), "\"lamp_i\" \"square_i\"",
                    "", kGradient},
                   [=](double x, double y) { return gradient(y / view(x, y)) * Rgb(.5f, 1, 1); }};
  CorpusRow of_surface = mirror;
  of_surface.scene.body +=
      "object \"ceiling\" visible trace group -90 -90 6 -90 90 6 90 90 6 90 -90 6 v 0 v 1 v 2 v 3 "
      "c 0 1 2 3 end group end object instance \"ceiling_i\" \"ceiling\" material \"light\" end "
      "instance material \"light\" " +
      corpus_emitter(".2 .4 .6") + " end material ";
  of_surface.scene.members += " \"ceiling_i\"";
  of_surface.wanted = [](double, double) { return Rgb(.1f, .4f, .6f); };
  of_surface.name = "mirror/of a surface";
  return {{"gradient",
           {"", "", "", kGradient},
           [=](double x, double y) { return gradient(y / view(x, y)); }},
          {"latlong",
           {"color texture \"columns\" [4 1 3] 'ff0000 00ff00 0000ff 808080' ", "", "",
            "environment \"cp_latlong\" ( \"texture\" \"columns\", \"turn\" .02 )"},
           [](double x, double) {
             // Between the middles of the second and the third column.
             const double t = 4 * (std::atan2(x, 4) / kTwoPi + .52) - 1.5;
             const auto grey = float(std::max(t - 1, 0.0)), blue = float(std::min(t, 1.0));
             return Rgb(0, 1 - blue, blue * (1 - grey)) + Rgb(grey * 128 / 255);
           }},
          mirror,
          of_surface};
}

std::vector<CorpusRow> volumes() {
  const auto haze = [](const std::string& name, const std::string& on_lights) {
    return CorpusRow{name,
                     {corpus_square(corpus_emitter(".5 .5 .5")), "\"lamp_i\" \"square_i\"", "",
                      "volume \"cp_haze\" ( \"color\" 0 .2 1, \"reach\" 8" + on_lights + " )"},
                     [](double x, double y) {
                       const float kept = static_cast<float>(std::exp(-view(x, y) / 8));
                       return Rgb(.5f) * kept + Rgb(0, .2f, 1) * (1 - kept);
                     }};
  };
  CorpusRow march{"march",
                  {corpus_square(corpus_emitter(".5 .25 0")), "\"lamp_i\" \"square_i\"", "",
                   "volume \"cp_march\" ( \"density\" .1, \"steps\" 16, \"lights\" [\"lamp_i\"] )"},
                  [](double x, double y) {
                    const auto kept = float(std::pow(1 - .1 * view(x, y) / 16, 16));
                    return Rgb(.5f, .25f, 0) * kept + Rgb(1 - kept);
                  }};
  return {haze("haze", ""), march};
}

std::vector<CorpusRow> materials() {
  const auto board = [](const std::string& name, double z, const std::string& material) {
    const std::string at = " " + std::to_string(z) + " ";
    return "object \"" + name + "\" visible trace group -90 -90" + at + "90 -90" + at + "90 90" +
           at + "-90 90" + at + " v 0 v 1 v 2 v 3 c 0 1 2 3 end group end object instance \"" +
           name + "_i\" \"" + name + "\" material \"" + material + "\" end instance ";
  };
  CorpusRow glass{
      "glass",
      {"material \"g\" \"cp_glass\" ( \"tint\" 1 1 .5 ) end material material \"p\" \"cp_place\" ( "
       ") end material object \"pane\" visible trace group -90 -90 1 90 -90 1 90 90 1 -90 90 1 -90 "
       "-90 0 90 -90 0 90 90 0 -90 90 0 v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7 c 0 1 2 3 c 7 6 5 4 end "
       "group end object instance \"pane_i\" \"pane\" material \"g\" end instance " +
           board("floor", -1, "p"),
       "\"pane_i\" \"floor_i\""},
      [](double x, double y) {
        const double r = std::hypot(x, y), sine = r / view(x, y) / 1.5;
        const double way = 4 * r / 4 + sine / std::sqrt(1 - sine * sine);
        return Rgb(float(.1 * way * x / r), float(.1 * way * y / r), .125f);
      }};
  CorpusRow open{"open_sky",
                 {corpus_square("\"cp_open_sky\" ( \"rays\" 16 )") +
                      "material \"black\" \"mib_illum_lambert\" ( ) end material object \"half\" "
                      "visible trace group 0 -900 6 900 -900 6 900 900 6 0 900 6 v 0 v 1 v 2 v 3 c "
                      "0 1 2 3 end group end object instance \"half_i\" \"half\" material "
                      "\"black\" end instance ",
                  "\"square_i\" \"half_i\""},
                 // Half of the sky and more, by the sine of the angle to the edge.
                 [](double x, double) {
                   return Rgb(static_cast<float>(.5 - .5 * x / std::sqrt(x * x + 36)));
                 }};
  open.tolerance = .1f;  // 256 directions a pixel: four deviations
  // A board at z = 0 and three below it.
  CorpusRow nested{
      "nested",
      {board("top", 0, "n") + board("one", -1, "n") + board("two", -2, "n") +
           board("three", -4, "n") +
           "material \"n\" \"cp_nested\" ( \"scale\" .125 ) end material ",
       "\"top_i\" \"one_i\" \"two_i\" \"three_i\""},
      [](double x, double y) { return Rgb(.375f, static_cast<float>(view(x, y) / 8), .5f); }};
  CorpusRow few = nested;
  few.name = "nested/two at most";
  few.scene.body.replace(few.scene.body.find("\"scale\""), 0, "\"most\" 2, ");
  few.wanted = [](double x, double y) {
    return Rgb(.25f, static_cast<float>(view(x, y) / 16), .25f);
  };
  CorpusRow loop = nested;
  loop.name = "nested/in a loop";
  loop.scene.body.replace(loop.scene.body.find("\"scale\""), 0, "\"loop\" on, ");
  return {glass, open, nested, few, loop};
}

// acceptance: I4
TEST(CorpusRays, FollowTheirShaders) {
  std::vector<CorpusRow> rows;
  for (const auto& part : {lenses(), environments(), volumes(), materials()})
    rows.insert(rows.end(), part.begin(), part.end());
  testing::run_corpus("rays", rows);
}

}  // namespace corpus_rays_test
}  // namespace oriel
