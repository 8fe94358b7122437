// SPDX-License-Identifier: Apache-2.0
// Shaders that compute with spectra: wrapper classes, filters, dispersion and lights.
#include <cmath>

#include "color/black_body.h"
#include "color/srgb.h"
#include "corpus.h"

namespace oriel {
namespace corpus_spectra_test {

using testing::corpus_emitter;
using testing::corpus_surface;
using testing::CorpusRow;
using testing::UserScene;

/// Colour of light that has a value at each wavelength, by the CIE's matching functions in steps of
/// 1 nm. The value 1 has luminance 1.
Rgb colour_of(const std::function<double(double nm)>& value) {
  Vec3 xyz(0);
  float white = 0;
  for (int nm = 395; nm <= 705; ++nm) {
    const Vec3 matching = cie_1931_matching(static_cast<float>(nm));
    xyz += matching * static_cast<float>(value(nm));
    white += matching.y;
  }
  return xyz_to_linear_srgb(xyz / white);
}

std::string text_of(const Rgb& c) {
  return std::to_string(c.x) + " " + std::to_string(c.y) + " " + std::to_string(c.z);
}

/// Reflectance of an edge of glass.
double fresnel(double cosine, double ior) {
  const double sine = std::sqrt(1 - cosine * cosine) / ior, t = std::sqrt(1 - sine * sine);
  const double s = (cosine - ior * t) / (cosine + ior * t),
               p = (t - ior * cosine) / (t + ior * cosine);
  return .5 * (s * s + p * p);
}

/// A white square that a light of that shader lights from (0, 0, 3).
testing::CorpusScene lit_by(const std::string& light) {
  return {"light \"l\" " + light +
              " origin 0 0 3 end light instance \"l_i\" \"l\" end instance material \"m\" "
              "\"mib_illum_lambert\" ( \"diffuse\" 1 1 1, \"lights\" [\"l_i\"] ) end material " +
              UserScene::square("m"),
          "\"l_i\" \"square_i\""};
}

// acceptance: I4
TEST(CorpusSpectra, HaveTheColoursThatTheirFormulasGive) {
  const Rgb flat = colour_of([](double) { return 1; });
  const Rgb dyed =
      colour_of([](double nm) { return std::exp(-.5 * (.2 + (2 - .2) * (nm - 400) / 300)); });
  CorpusRow filter{
      "filter",
      {"shader \"white\" " + corpus_emitter(text_of(flat)) + " " +
       testing::corpus_square("\"cp_filter\" ( \"behind\" \"white\", \"thickness\" .5, "
                              "\"blue\" .2, \"red\" 2 )")},
      [=](double, double) { return dyed; }};
  filter.tolerance = .01f;
  CorpusRow disperse = corpus_surface(
      "disperse", "\"cp_disperse\" ( \"a\" 1.2, \"b\" 200000, \"light\" 2 )",
      [](double x, double y) {
        const double cosine = 4 / std::sqrt(x * x + y * y + 16);
        return colour_of([=](double nm) { return 2 * fresnel(cosine, 1.2 + 200000 / (nm * nm)); });
      });
  disperse.tolerance = .01f;
  CorpusRow kelvin{"kelvin", lit_by("\"cp_kelvin\" ( \"kelvin\" 4000, \"intensity\" .8 )")};
  const Vec3 body = black_body_xyz(4000);
  kelvin.equivalent =
      lit_by("\"mib_light_point\" ( \"color\" " +
             text_of(xyz_to_linear_srgb(body * (.8f / body.y))) + ", \"shadow\" on )");
  kelvin.tolerance = .01f;
  testing::run_corpus("spectra",
                      {filter,
                       disperse,
                       kelvin,
                       {"mixture",
                        {"shader \"mixed\" \"cp_mixture\" ( \"first\" .1 .2 .3, \"second\" .5 .2 "
                         ".1, \"at\" .25 ) " +
                         testing::corpus_square(corpus_emitter("= \"mixed\""))},
                        [](double, double) { return Rgb(.4f, .4f, .5f); }}},
                      "--flag=-std=c++98");
}

}  // namespace corpus_spectra_test
}  // namespace oriel
