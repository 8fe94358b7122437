// SPDX-License-Identifier: Apache-2.0
// Shaders in C89: old definitions, macros, line ends of other systems.
#include <cmath>

#include "corpus.h"
#include "oriel/sdk/shader/sample.h"

namespace oriel {
namespace corpus_c89_test {

using testing::corpus_emitter;
using testing::corpus_square;
using testing::corpus_surface;
using testing::corpus_two_lamps;
using testing::CorpusRow;
using testing::CorpusScene;
using testing::kCorpusLamp;

/// A shader that has the parameters of a built-in one.
CorpusRow as_built_in(const std::string& name, const std::string& own, const std::string& built_in,
                      const std::string& parameters) {
  CorpusRow row{name, corpus_two_lamps("\"" + own + "\" ( " + parameters + " )")};
  row.equivalent = corpus_two_lamps("\"" + built_in + "\" ( " + parameters + " )");
  return row;
}

Rgb grey(double value) { return Rgb(static_cast<float>(value)); }

/// -1 to 1 over the picture is .25 to .75 of the square's coordinates.
double coordinate(double at) { return at / 16 + .5; }

std::vector<CorpusRow> illumination() {
  std::vector<CorpusRow> rows;
  for (const char* mode : {"0", "1", "2", "4"})
    rows.push_back(as_built_in(std::string("lambert/mode ") + mode, "cp_lambert",
                               "mib_illum_lambert",
                               std::string("\"ambience\" .5 .5 .5, \"ambient\" .1 .2 .3, "
                                           "\"diffuse\" .8 .4 .2, \"lights\" [\"side_i\"], "
                                           "\"mode\" ") +
                                   mode));
  rows.push_back(as_built_in("phong", "cp_phong", "mib_illum_phong",
                             "\"ambience\" .5 .5 .5, \"ambient\" .1 .1 .1, \"diffuse\" .6 .4 .2, "
                             "\"specular\" .5 .6 .7, \"exponent\" 12, \"mode\" 4"));
  rows.push_back(as_built_in("gloss", "cp_gloss", "mib_illum_cooktorr",
                             "\"diffuse\" .3 .2 .1, \"specular\" .9 .8 .7, \"roughness\" .3, "
                             "\"ior\" 5 3 2, \"mode\" 0, \"lights\" [\"side_i\", \"lamp_i\"]"));
  return rows;
}

std::vector<CorpusRow> patterns() {
  const std::string matrix = "2 0 0 0 0 1 0 0 0 0 1 0 .25 0 0 1";
  return {
      corpus_surface("tint", "\"cp_tint\" ( \"color\" .1 .2 .3 1, \"gain\" 2 )",
                     [](double, double) { return Rgb(.2f, .4f, .6f); }),
      corpus_surface("tint/one channel", "\"cp_tint\" ( \"color\" .1 .2 .3 1, \"only\" 2 )",
                     [](double, double) { return Rgb(0, .2f, 0); }),
      corpus_surface("cells",
                     "\"cp_cells\" ( \"size\" 2 4 1, \"even\" .1 .2 .3, \"odd\" .7 .6 .5 )",
                     [](double x, double y) {
                       const int n = int(std::floor(x / 2 + .5)) + int(std::floor(y / 4 + .5));
                       return n % 2 ? Rgb(.7f, .6f, .5f) : Rgb(.1f, .2f, .3f);
                     }),
      {"stripes",
       {"shader \"uv\" \"cp_uvmatrix\" ( \"transform\" " + matrix +
        ", \"torus\" on ) shader \"s\" \"cp_stripes\" ( \"coord\" = \"uv\", \"number\" 3, "
        "\"duty\" .25, \"on\" 1 .5 0, \"off\" 0 .25 .5 ) " +
        corpus_square(corpus_emitter("= \"s\""))},
       [](double x, double) {
         const double u = 2 * coordinate(x) + .25, at = 3 * (u - std::floor(u));
         return at - std::floor(at) < .25 ? Rgb(1, .5f, 0) : Rgb(0, .25f, .5f);
       }},
      {"uvmatrix",
       {"shader \"uv\" \"cp_uvmatrix\" ( \"transform\" " + matrix +
        " ) shader \"s\" \"mib_texture_remap\" ( \"input\" = \"uv\" ) shader \"c\" "
        "\"cp_stripes\" ( \"coord\" = \"s\", \"duty\" .7, \"on\" .2 .2 .2, \"off\" .6 .6 .6 ) " +
        corpus_square(corpus_emitter("= \"c\""))},
       [](double x, double) {
         const double u = 2 * coordinate(x) + .25;
         return grey(u - std::floor(u) < .7 ? .2 : .6);
       }},
      corpus_surface("facing", "\"cp_facing\" ( \"front\" 1 .5 .25, \"side\" 0 0 1, \"power\" .5 )",
                     [](double x, double y) {
                       const double f = std::sqrt(1 - 4 / std::sqrt(x * x + y * y + 16));
                       return Rgb(float(1 - f), float(.5 * (1 - f)), float(.25 * (1 - f) + f));
                     }),
      {"stack",
       {"shader \"half\" \"cp_coordinate\" ( \"axis\" 0 ) " +
        corpus_square("\"cp_stack\" ( \"base\" .2 .2 .2, \"layers\" [ { \"color\" 1 0 0, "
                      "\"weight\" = \"half\", \"mode\" 0 }, { \"color\" 0 1 1, \"weight\" .25, "
                      "\"mode\" 1 }, { \"color\" .5 .5 1, \"mode\" 2 } ] )")},
       [](double x, double) {
         const double u = coordinate(x);
         const double red = .2 * (1 - u) + u, other = .2 * (1 - u) + .25;
         return Rgb(float(.5 * red), float(.5 * other), float(other));
       }},
      {"ramp",
       {"shader \"v\" \"cp_coordinate\" ( \"axis\" 1 ) " +
        corpus_square("\"cp_ramp\" ( \"at\" = \"v\", \"key\" [.4, .5, .7], \"color\" [ .1 .1 .1, "
                      ".9 0 0, 0 .9 0 ] )")},
       [](double, double y) {
         const double v = coordinate(y), a = std::min(std::max((v - .4) / .1, 0.0), 1.0),
                      b = std::min(std::max((v - .5) / .2, 0.0), 1.0);
         return Rgb(float((.1 + .8 * a) * (1 - b)), float(.1 * (1 - a) + .9 * b),
                    float(.1 * (1 - a)));
       }},
      corpus_surface(
          "table", "\"cp_table\" ( \"n\" 512, \"exponent\" 2 )",
          [](double x, double) { return Rgb(float(coordinate(x) * coordinate(x)), .5f, 0); }),
      {"table/two uses",
       {"shader \"a\" \"cp_table\" ( \"n\" 512, \"exponent\" 2 ) shader \"b\" \"cp_table\" ( "
        "\"n\" 512, \"exponent\" .5 ) " +
        corpus_square("\"mib_illum_lambert\" ( \"ambience\" = \"a\", \"ambient\" = \"b\", "
                      "\"diffuse\" 0 0 0 )")},
       [](double x, double) { return Rgb(float(std::pow(coordinate(x), 2.5)), .25f, 0); }},
      corpus_surface("names", "\"cp_names\" ( \"name\" \"Kupfer\" )",
                     [](double, double) { return Rgb(.8f, .5f, .3f); }),
      corpus_surface("where/world", "\"cp_where\" ( \"space\" 0, \"scale\" .1 )",
                     [](double x, double y) { return Rgb(float(.1 * x), float(.1 * y), 0); }),
      corpus_surface("where/camera", "\"cp_where\" ( \"space\" 1, \"scale\" -.1 )",
                     [](double x, double y) { return Rgb(float(-.1 * x), float(-.1 * y), .4f); }),
      {"where/object",
       {kCorpusLamp +
        "material \"m\" \"cp_where\" ( \"space\" 2, \"scale\" .1 ) end material object \"square\" "
        "visible trace group -8 -8 0 8 -8 0 8 8 0 -8 8 0 v 0 v 1 v 2 v 3 c 0 1 2 3 "
        "end group end object instance \"square_i\" \"square\" material \"m\" "
        "transform 2 0 0 0 0 1 0 0 0 0 1 0 0 -.5 0 1 end instance "},
       [](double x, double y) { return Rgb(float(.2 * x), float(.1 * y - .05), 0); }},
      corpus_surface(
          "where/raster", "\"cp_where\" ( \"space\" 3, \"scale\" .03125 )",
          [](double x, double y) { return Rgb(float(x + 4) / 8, float(y + 4) / 8, -.125f); }),
      corpus_surface(
          "noise", "\"cp_noise\" ( \"scale\" .5 .25 1, \"octaves\" 3, \"gain\" .5 )",
          [](double x, double y) {
            float sum = 0;
            for (int i = 0; i < 3; ++i) {
              const miVector p = {float(x * .5) * float(1 << i), float(y * .25) * float(1 << i), 0};
              sum += mi_unoise_3d(&p) / float(1 << i);
            }
            return Rgb(sum / 1.75f);
          }),
  };
}

// acceptance: I4
TEST(CorpusC89, ShadersInC89RenderCorrectly) {
  std::vector<CorpusRow> rows = illumination();
  for (CorpusRow& row : patterns()) rows.push_back(std::move(row));
  testing::run_corpus("c89", rows, "--flag=-std=gnu89");
}

}  // namespace corpus_c89_test
}  // namespace oriel
