// SPDX-License-Identifier: Apache-2.0
// Films on surfaces, against another method and known coatings.
#include "bsdf/thin_film.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <complex>

namespace oriel::bsdf {
namespace thin_film_test {

/// By characteristic matrices (Born, Wolf, 1.6.3) of both polarisations.
double by_matrices(double cosine, double film, double base, double thickness, double wavelength) {
  using Complex = std::complex<double>;
  const double sine = std::sqrt(1 - cosine * cosine);
  const double inside = std::sqrt(1 - sine * sine / (film * film));
  const double deep = std::sqrt(1 - sine * sine / (base * base));
  const double delta = 2 * M_PI / wavelength * film * thickness * inside;
  double sum = 0;
  for (const bool s : {true, false}) {
    const double air = s ? cosine : 1 / cosine, in = s ? film * inside : film / inside,
                 out = s ? base * deep : base / deep;
    const Complex i(0, 1);
    const Complex b = std::cos(delta) + i * std::sin(delta) / in * out;
    const Complex c = i * in * std::sin(delta) + std::cos(delta) * out;
    sum += std::norm((air * b - c) / (air * b + c));
  }
  return sum / 2;
}

TEST(ThinFilm, AgreesWithCharacteristicMatrices) {
  for (const float cosine : {1.f, .8f, .5f, .2f, .05f})
    for (const float film : {1.2f, 1.3f, 1.8f})
      for (const float base : {1.5f, 2.4f, 8.f})
        for (const float thickness : {0.f, 100.f, 270.f, 800.f})
          for (const float wavelength : {420.f, 550.f, 680.f})
            EXPECT_NEAR(thin_film_reflectance(cosine, film, base, thickness, wavelength),
                        by_matrices(cosine, film, base, thickness, wavelength), 1e-4)
                << cosine << ' ' << film << ' ' << base << ' ' << thickness << ' ' << wavelength;
}

TEST(ThinFilm, AQuarterWaveOfTheRootOfTheIndexReflectsNothing) {
  const float film = std::sqrt(2.25f);
  EXPECT_NEAR(thin_film_reflectance(1, film, 2.25f, 550 / (4 * film), 550), 0, 1e-6);
  EXPECT_NEAR(thin_film_reflectance(1, film, 2.25f, 550 / (2 * film), 550),
              std::pow(1.25f / 3.25f, 2), 1e-5)
      << "half a wave is not there";
}

TEST(ThinFilm, ColorWithoutAFilmIsThatOfTheBase) {
  for (const Rgb& base : {Rgb(.04f), Rgb(.9f, .6f, .2f)})
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(thin_film_color(1, 1.3f, base, 0)[c], base[c], 2e-3) << c;
      EXPECT_NEAR(thin_film_color(1, 1, base, 400)[c], base[c], 2e-3) << c;
    }
}

TEST(ThinFilm, ColorIsTheMeanOverTheSpectrum) {
  const Rgb color = thin_film_color(.9f, 1.33f, Rgb(.2f), 300);
  EXPECT_GT(max_component(color), 1.3f * std::min({color.x, color.y, color.z})) << "is coloured";
  // Bells about the wavelengths that the primaries are most sensitive to are near to their weights.
  const auto mean = [&](float center, float width) {
    double sum = 0, weight = 0;
    for (float nm = 400; nm <= 700; nm += 1) {
      const double w = std::exp(-.5 * std::pow((nm - center) / width, 2));
      const double root = std::sqrt(.2);
      weight += w;
      sum += w * by_matrices(.9, 1.33, (1 + root) / (1 - root), 300, nm);
    }
    return sum / weight;
  };
  EXPECT_NEAR(color.y, mean(540, 35), .25 * mean(540, 35));
  EXPECT_NEAR(color.z, mean(450, 22), .25 * mean(450, 22));
}

}  // namespace thin_film_test
}  // namespace oriel::bsdf
