// SPDX-License-Identifier: Apache-2.0
// Shaders in C++98: classes over the state, templates, containers with the lifetime of the frame.
#include <cmath>

#include "corpus.h"

namespace oriel {
namespace corpus_cpp98_test {

using testing::corpus_square;
using testing::corpus_surface;
using testing::corpus_two_lamps;
using testing::CorpusRow;
using testing::CorpusScene;
using testing::kCorpusLamp;
using testing::lamp_cosine;

std::vector<CorpusRow> illumination() {
  std::vector<CorpusRow> rows;
  for (const char* mode : {"0", "1", "2", "4"}) {
    const std::string parameters = std::string(
                                       "\"diffuse\" .6 .4 .2, \"specular\" .5 .6 .7, \"exponent\" "
                                       "12, \"lights\" [\"side_i\"], \"mode\" ") +
                                   mode;
    CorpusRow row{std::string("loop/mode ") + mode,
                  corpus_two_lamps("\"cp_loop\" ( " + parameters + ")")};
    row.equivalent =
        corpus_two_lamps("\"mib_illum_phong\" ( \"ambience\" 0 0 0, " + parameters + ")");
    rows.push_back(row);
  }
  for (const char* lights : {"\"lights\" [\"lamp_i\"]", "\"color\" .8 .4 .2"})
    rows.push_back(corpus_surface(
        std::string("iterator/") + lights,
        std::string("\"cp_iterator\" ( \"wrap\" .5, \"color\" .8 .4 .2, ") + lights + " )",
        [](double x, double y) {
          return Rgb(.8f, .4f, .2f) * static_cast<float>((lamp_cosine(x, y) + .5) / 1.5);
        }));
  return rows;
}

/// A mirror, and above the camera a ceiling that shows its inherited user data.
CorpusScene under_a_ceiling() {
  return {corpus_square("\"cp_carry\" ( \"share\" .5 )") +
              "material \"above\" \"cp_carried\" ( ) end material object \"ceiling\" visible trace "
              "group -90 -90 6 -90 90 6 90 90 6 90 -90 6 v 0 v 1 v 2 v 3 c 0 1 2 3 end group end "
              "object instance \"ceiling_i\" \"ceiling\" material \"above\" end instance ",
          "\"square_i\" \"ceiling_i\""};
}

std::vector<CorpusRow> caches() {
  std::vector<CorpusRow> rows = {
      corpus_surface("palette", "\"cp_palette\" ( \"text\" \"rgbw\", \"columns\" 8 )",
                     [](double x, double) {
                       const int n = int((x / 16 + .5) * 8) % 4;
                       return Rgb(n == 0 || n == 3, n == 1 || n == 3, n == 2 || n == 3);
                     }),
      corpus_surface("scratch", "\"cp_scratch\" ( \"values\" [ .3, .9, .1, .5, .2 ] )",
                     [](double, double) { return Rgb(.3f, .9f, 0); }),
      corpus_surface("pattern",
                     "\"cp_pattern\" ( \"kind\" 1, \"first\" .1 .2 .3, \"second\" .9 .5 .1 )",
                     [](double x, double y) {
                       const double t = .5 + .5 * std::sin((x + y) * std::sqrt(.5));
                       return Rgb(.1f, .2f, .3f) * float(1 - t) + Rgb(.9f, .5f, .1f) * float(t);
                     }),
      corpus_surface("pattern/none", "\"cp_pattern\" ( \"kind\" 7, \"second\" .9 .5 .1 )",
                     [](double, double) { return Rgb(.9f, .5f, .1f); }),
      {"labels",
       {kCorpusLamp +
        "material \"m\" \"cp_labels\" ( ) end material object \"square\" visible tag 4 group -8 -8 "
        "0 8 -8 0 8 8 0 -8 8 0 v 0 v 1 v 2 v 3 c 0 1 2 3 end group end object instance "
        "\"square_i\" \"square\" material \"m\" tag 8 end instance "},
       [](double, double) { return Rgb(.25f, .5f, .5f); }},
      {"carry", under_a_ceiling(), [](double x, double y) {
         return Rgb(.5f, .5f, static_cast<float>(6 * std::sqrt(x * x + y * y + 16) / 32));
       }}};
  // Each call has a table of its own: the product of two.
  rows.push_back(
      {"palette/two calls",
       {"shader \"a\" \"cp_palette\" ( \"text\" \"r g b w\" ) shader \"b\" \"cp_palette\" ( "
        "\"text\" \"gw\", \"columns\" 8 ) " +
        corpus_square("\"mib_illum_lambert\" ( \"ambience\" = \"a\", \"ambient\" = \"b\", "
                      "\"diffuse\" 0 0 0 )")},
       [](double x, double) {
         const int a = int((x / 16 + .5) * 4), b = int((x / 16 + .5) * 8) % 2;
         return Rgb(b && (a == 0 || a == 3), a == 1 || a == 3, b && (a == 2 || a == 3));
       }});
  return rows;
}

// acceptance: I4
TEST(CorpusCpp98, ClassesAndContainersServeShaders) {
  std::vector<CorpusRow> rows = illumination();
  for (CorpusRow& row : caches()) rows.push_back(std::move(row));
  testing::run_corpus("cpp98", rows, "--flag=-std=c++98");
}

}  // namespace corpus_cpp98_test
}  // namespace oriel
