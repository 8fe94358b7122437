// SPDX-License-Identifier: Apache-2.0
// Sources that are hard to compile: old definitions, templates, helper libraries, foreign paths.
#include <algorithm>
#include <cmath>

#include "corpus.h"

namespace oriel {
namespace corpus_stress_test {

using testing::corpus_emitter;
using testing::corpus_square;
using testing::corpus_surface;
using testing::corpus_two_lamps;
using testing::CorpusRow;

/// A row that shows the same colour everywhere.
CorpusRow even(const std::string& name, const std::string& material, const Rgb& color) {
  return corpus_surface(name, material, [=](double, double) { return color; });
}

std::vector<CorpusRow> languages() {
  const auto wave = [](double x, double y) {
    const double r = std::hypot(x, y),
                 v = std::sin(x) + std::cos(r / 2) + (y > 0 ? std::cos(r / .5) : 0);
    return v > 0 ? Rgb(float(.125 * v), 0, 0) : Rgb(0, float(-.125 * v), 0);
  };
  return {
      corpus_surface("knr", "\"cp_knr\" ( \"size\" 2 )",
                     [](double x, double y) {
                       static const double table[4][3] = {
                           {.1, .2, .3}, {.9, .8, .7}, {.4, .5, .6}, {1, 0, .5}};
                       const int i = int(std::floor(x / 2)) + 8, j = int(std::floor(y / 2)) + 9;
                       const double v = table[i % 4][j % 3];
                       return Rgb(float(v), float(.5 * v), 0);
                     }),
      corpus_surface("blocks", "\"cp_blocks\" ( \"tint\" .1 0 .3, \"scale\" .5 1 1 )",
                     [](double x, double) { return Rgb(float(.025 * x * x), 0, .3f); }),
      corpus_surface("ladder",
                     "\"cp_ladder\" ( \"wave\" [ { \"kind\" \"sine\" }, { \"kind\" \"rings\", "
                     "\"size\" 2 }, { \"kind\" \"half rings\", \"size\" .5 } ] )",
                     wave),
      even("exports", "\"cp_exports\" ( \"nth\" 0 )", Rgb(.1f)),
      even("exports/last", "\"cp_exports\" ( \"nth\" 4 )", Rgb(.5f)),
      {"exports/connected",
       {"shader \"fourth\" \"cp_exports_fourth\" ( ) shader \"fifth\" \"cp_exports_fifth\" ( ) " +
        corpus_square("\"cp_kit\" ( \"from\" = \"fourth\", \"to\" = \"fifth\" )")},
       [](double, double) { return Rgb(.4f); }},
      even("exports_cc", "\"cp_exports_cc\" ( \"value\" .25 )", Rgb(.25f, .5f, 0)),
      {"kit",
       {"shader \"turned\" \"cp_kit_turned\" ( \"swap\" on ) " +
        corpus_square("\"cp_kit\" ( \"from\" .2, \"to\" .8, \"at\" = \"turned\" )")},
       [](double, double y) { return Rgb(float(.2 + .6 * (y / 16 + .5))); }},
  };
}

std::vector<CorpusRow> libraries() {
  const auto share = [](double x) {
    const double t = std::clamp((x + 2) / 4, 0.0, 1.0);
    return .5 * t * t * (3 - 2 * t);
  };
  const auto shared = [](const std::string& mode) {
    return "\"cp_shared\" ( \"base\" .2 .4 .6 1, \"layer\" 1 .5 0 .5, \"mode\" " + mode + " )";
  };
  return {corpus_surface("shared", shared("0"),
                         [=](double x, double) {
                           const double w = share(x);
                           return Rgb(float(.2 * (1 - w) + w), float(.4 * (1 - w) + .5 * w),
                                      float(.6 * (1 - w)));
                         }),
          corpus_surface("shared/multiplied", shared("2"),
                         [=](double x, double) {
                           const double w = share(x);
                           return Rgb(.2f, float(.4 * (1 - .5 * w)), float(.6 * (1 - w)));
                         }),
          corpus_surface("shared_cc", "\"cp_shared_cc\" ( \"low\" .1, \"high\" .9 )",
                         [](double, double y) { return Rgb(float(std::clamp(y, .1, .9))); }),
          even("paths", "\"cp_paths\" ( \"value\" .5 )", Rgb(.5f, .375f, .25f))};
}

std::vector<CorpusRow> interface() {
  std::vector<CorpusRow> rows = {
      corpus_surface("vectors", "\"cp_vectors\" ( \"axis\" 4 0 0 )",
                     [](double x, double y) {
                       return Rgb(float(.25 * std::max(x, 0.0)),
                                  float(.125 * std::hypot(std::min(x, 0.0), std::min(y, 0.0))),
                                  float(.125 * std::max(y, 0.0) + .25));
                     }),
      even("asserts", "\"cp_asserts\" ( \"value\" .5 )", Rgb(.5f, .25f, 0)),
      {"evals",
       {"color texture \"t\" [1 1 3] 'ffffff' shader \"blue\" \"mib_color_mix\" ( \"num\" 0, "
        "\"color_base\" 0 0 .1 1 ) material \"other\" " +
        corpus_emitter("1 1 1") + " end material " +
        corpus_square(
            "\"cp_evals\" ( \"on\" on, \"number\" 2, \"scalar\" .1, \"vector\" 0 1 0, \"color\" .2 "
            ".3 .4, \"transform\" 1 0 0 0 0 1 0 0 0 0 1 0 0 1 0 1, \"text\" \"text\", \"texture\" "
            "\"t\", \"shader\" \"blue\", \"light\" \"lamp_i\", \"material\" \"other\", \"one\" { "
            "\"weight\" .05 }, \"part\" [ { \"weight\" .5, \"shift\" .2 0 0 }, { \"weight\" 1, "
            "\"shift\" .1 0 0 } ], \"tag\" [\"lamp_i\"] )")},
       [](double, double) { return Rgb(.5f, .675f, .3375f); }},
      corpus_surface(
          "words", "\"cp_words\" ( \"value\" .5 )",
          [](double x, double) { return Rgb(.5f, .9375f, float(.125 * std::max(x, 0.0))); }),
  };
  for (const char* mode : {"0", "1", "2", "4"}) {
    const std::string parameters =
        std::string(" .6 .4 .2, \"lights\" [\"side_i\"], \"mode\" ") + mode + " )";
    CorpusRow row{std::string("host/mode ") + mode,
                  corpus_two_lamps("\"cp_host\" ( \"color\"" + parameters)};
    row.equivalent = corpus_two_lamps("\"mib_illum_lambert\" ( \"diffuse\"" + parameters);
    rows.push_back(row);
  }
  return rows;
}

// acceptance: I4
TEST(CorpusStress, DifficultSourcesCompileAndRenderCorrectly) {
  std::vector<CorpusRow> rows;
  for (const auto& part : {languages(), libraries(), interface()})
    rows.insert(rows.end(), part.begin(), part.end());
  const std::string common = ORIEL_SOURCE_DIR "/tests/user_shaders/corpus/stress/common";
  testing::run_corpus("stress", rows,
                      "--std=gnu89 --std=c++98 --helper " + common + " -I " + common + "/include");
}

}  // namespace corpus_stress_test
}  // namespace oriel
