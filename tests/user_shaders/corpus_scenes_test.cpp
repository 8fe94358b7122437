// SPDX-License-Identifier: Apache-2.0
// Output, state and geometry shaders, and phenomena of shaders in C.
#include <cmath>

#include "corpus.h"

namespace oriel {
namespace corpus_scenes_test {

using testing::corpus_emitter;
using testing::corpus_square;
using testing::CorpusRow;
using testing::CorpusScene;
using testing::kCorpusLamp;
using testing::lamp_cosine;
using testing::UserScene;

CorpusRow finished(const std::string& name, const std::string& outputs,
                   std::function<Rgb(double, double)> wanted) {
  CorpusRow row{name,
                {corpus_square("\"cp_extra\" ( \"pass\" 0 )"), "\"lamp_i\" \"square_i\"",
                 "frame buffer 0 \"+rgba_fp\" ", outputs},
                std::move(wanted)};
  row.shown = true;
  return row;
}

// acceptance: I4
TEST(CorpusPictures, OutputAndStateShadersChangeThem) {
  const auto red = [](double y) { return y / 16 + .5; };
  std::vector<CorpusRow> rows = {
      finished("contrast", "output \"cp_contrast\" ( \"amount\" 2, \"pivot\" .25 )",
               [=](double, double y) { return Rgb(float(2 * red(y) - .25), -.25f, -.25f); }),
      finished("upside", "output \"cp_upside\" ( )",
               [=](double, double y) { return Rgb(float(red(-y)), 0, 0); }),
      finished("upside/then contrast",
               "output \"cp_upside\" ( ) output \"cp_contrast\" ( \"amount\" 2, \"pivot\" 0 )",
               [=](double, double y) { return Rgb(float(2 * red(-y)), 0, 0); }),
      finished("tones", "output \"cp_tones\" ( \"extra\" 0, \"white\" 2 )",
               [=](double, double y) {
                 const double l = (red(y) + .5) / 3;
                 return Rgb(float(red(y)), .5f, 0) * float((1 + l / 4) / (1 + l));
               }),
      {"extra",
       {corpus_square("\"cp_extra\" ( \"pass\" 0 )")},
       [=](double, double y) { return Rgb(float(red(y)), 0, 0); }},
      {"meter",
       {corpus_square("\"cp_counted\" ( )") + "object \"floor\" visible trace group -90 -90 -2 90 "
                                              "-90 -2 90 90 -2 -90 90 -2 v 0 v 1 v "
                                              "2 v 3 c 0 1 2 3 end group end object instance "
                                              "\"floor_i\" \"floor\" material \"m\" end "
                                              "instance ",
        "\"lamp_i\" \"square_i\" \"floor_i\"", "state \"cp_meter\" ( ) "},
       [](double x, double y) {
         return Rgb(.5f, .5f, float(.15 * std::sqrt(x * x + y * y + 16)));
       }}};
  testing::run_corpus("pictures", rows);
}

CorpusScene made(const std::string& shader, int what) {
  return {"material \"m\" \"cp_seen\" ( \"what\" " + std::to_string(what) +
              " ) end material instance \"made\" geometry " + shader +
              " material \"m\" end instance ",
          "\"made\""};
}

/// The square with a displacement.
CorpusScene displaced(const std::string& shaders, const std::string& body = "") {
  return {body + kCorpusLamp + "material \"m\" \"cp_seen\" ( \"what\" 0 ) displace " + shaders +
              " end material " + UserScene::square("m"),
          "\"square_i\"", "max displace 4"};
}

/// Where the view meets the plane z = slope x + height.
Rgb slope(double x, double rise, double height) {
  const double t = (4 - height) / (4 + rise * x), at = x * t;
  return Rgb(float(.25 * (4 - 4 * t)), float(at / 16 + .5), float(1 / std::sqrt(1 + rise * rise)));
}

/// The square of cp_seen at that height, moved by dx.
Rgb pushed(double x, double height, double dx) {
  const double at = x * (4 - height) / 4;
  return Rgb(float(.25 * height), float((at - dx) / 16 + .5), 1);
}

/// What cp_seen shows of cp_single, which lies around (1, -.5).
Rgb single(double x, double y) {
  if (std::abs(x - 1) > 1.5 || std::abs(y + .5) > 1.5) return Rgb(0);
  return Rgb(float(.25 * (x - 1) + .25), 0, 0);
}

// acceptance: I4
TEST(CorpusGeometry, ShadersMakeAndMoveIt) {
  CorpusRow ball{"ball", made("\"cp_ball\" ( \"radius\" 2, \"rings\" 48 )", 1),
                 [](double x, double y) {
                   // |(0, 0, 4) + t (x, y, -4)| = 2, the first.
                   const double a = x * x + y * y + 16, d = 256 - 12 * a;
                   if (d < 0) return Rgb(0);
                   const double t = (16 - std::sqrt(d)) / a;
                   return Rgb(float(.25 * x * t + .5), float(.25 * y * t + .5), float(2 - 2 * t));
                 }};
  ball.tolerance = .01f;  // flat triangles
  std::vector<CorpusRow> rows = {
      {"grid", made("\"cp_grid\" ( \"n\" 5, \"slope\" .25 )", 0),
       [](double x, double) { return slope(x, .25, 0); }},
      {"copies", made("\"cp_copies\" ( \"x\" [ -2.5, 0, 2.5 ] )", 2),
       [](double x, double y) {
         if (std::abs(y) > 3) return Rgb(0);
         const double from = x + 3.5, n = std::floor(from / 2.5);
         return n < 0 || n > 2 || from - 2.5 * n > 2 ? Rgb(0)
                                                     : Rgb(float(.25 * (from - 2.5 * n)), 0, 0);
       }},
      ball,
      {"lift", displaced("\"cp_lift\" ( \"height\" 2 )"),
       [](double x, double) { return slope(x, .125, 1); }},
      {"lift/list",
       displaced("\"cp_lift\" ( \"height\" .5 ) \"cp_lift\" ( \"height\" "
                 "1.5 )"),
       [](double x, double) { return slope(x, .125, 1); }},
      {"push", displaced("\"cp_push\" ( \"height\" 2, \"way\" .6 0 .8 )"),
       [](double x, double) { return pushed(x, 1.6, 1.2); }},
      {"push/from a point",
       displaced("\"cp_push\" ( \"height\" .5, \"way\" -.6 0 .8, \"rise\" .8 )"),
       [](double x, double) { return pushed(x, 1.2, -.3); }},
      {"lantern",
       {"material \"m\" \"cp_seen\" ( \"what\" 3 ) end material instance \"made\" geometry "
        "\"cp_lantern\" ( \"color\" .5 1 .25, \"place\" 1 0 3 ) end instance " +
            UserScene::square("m"),
        "\"made\" \"square_i\""},
       [](double x, double y) { return Rgb(.5f, 1, .25f) * float(lamp_cosine(x - 1, y)); }},
      {"single", made("\"cp_single\" ( \"half\" 1.5, \"at\" 1 -.5 0 )", 2), single},
      {"single/listed", made("\"cp_single\" ( \"half\" 1.5, \"at\" 1 -.5 0, \"listed\" on )", 2),
       single},
      {"seen/lit",
       {kCorpusLamp + "material \"m\" \"cp_seen\" ( \"what\" 3 ) end material " +
        UserScene::square("m")},
       [](double x, double y) { return Rgb(float(lamp_cosine(x, y))); }},
      {"seen",
       {"material \"m\" \"cp_seen\" ( ) end material " + UserScene::square("m"), "\"square_i\""},
       [](double x, double) { return slope(x, 0, 0); }},
  };
  testing::run_corpus("geometry", rows);
}

// acceptance: I4
TEST(CorpusPhenomena, CombineShadersInC) {
  testing::run_corpus(
      "phenomena",
      {{"parts/struct and array",
        {corpus_square("\"cp_both\" ( \"paint\" .2 .3 .4 1, \"strength\" .5 )")},
        [](double, double) { return Rgb(.5f); }},
       {"parts/default", {corpus_square("\"cp_both\" ( )")}, [](double, double) { return Rgb(1); }},
       {"parts/lens",
        {corpus_square("\"cp_root\" ( \"color\" .2 .4 .6 )"), "\"square_i\"", "",
         "lens \"cp_dyed\" ( \"tint\" 1 .5 0 1 )"},
        [](double, double) { return Rgb(.2f, .2f, 0); }},
       {"parts/two lenses",
        {corpus_square("\"cp_root\" ( \"color\" .2 .4 .6 )"), "\"square_i\"", "",
         "lens \"cp_dyed\" ( \"tint\" 1 .5 0 1 ) lens \"cp_gel\" ( \"gel\" .5 .5 1 1 )"},
        [](double, double) { return Rgb(.1f, .1f, 0); }},
       {"parts/in a built-in material",
        {"shader \"dyed\" \"cp_both\" ( \"strength\" .25 ) " +
         corpus_square(corpus_emitter("= \"dyed\""))},
        [](double, double) { return Rgb(.25f); }}});
}

}  // namespace corpus_scenes_test
}  // namespace oriel
