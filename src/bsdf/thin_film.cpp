// SPDX-License-Identifier: Apache-2.0
#include "bsdf/thin_film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "color/black_body.h"
#include "color/srgb.h"

namespace oriel::bsdf {
namespace {

constexpr int kWavelengths = 32;
constexpr float kFirst = 390, kStep = 10;  // nm

/// A film at one angle: amplitudes of both polarisations at both interfaces.
class Film {
 public:
  Film(float cosine, float film, float base) {
    const float sine2 = std::max(0.0f, 1 - cosine * cosine);
    inside_ = std::sqrt(std::max(0.0f, 1 - sine2 / (film * film)));
    const float deep = std::sqrt(std::max(0.0f, 1 - sine2 / (base * base)));
    upper_ = {amplitude(cosine, film * inside_), amplitude(film * cosine, inside_)};
    lower_ = {amplitude(film * inside_, base * deep), amplitude(base * inside_, film * deep)};
    path_ = 4 * kPi * film * inside_;
  }
  /// Cosine of the phase between beams.
  float phase(float thickness, float wavelength) const {
    return math::cos(path_ * thickness / wavelength);
  }
  float reflectance(float phase) const {
    float sum = 0;
    for (int p = 0; p < 2; ++p) {
      const float a = upper_[p], b = lower_[p], both = 2 * a * b * phase;
      const float all = 1 + a * a * b * b + both;
      sum += all > 0 ? (a * a + b * b + both) / all : 1;
    }
    return sum / 2;
  }

 private:
  static float amplitude(float x, float y) { return x + y > 0 ? (x - y) / (x + y) : 1; }

  float inside_, path_;
  std::array<float, 2> upper_, lower_;
};

/// Weights of the wavelengths for a linear sRGB colour; the sum of each channel is 1.
const std::array<Rgb, kWavelengths>& weights() {
  static const std::array<Rgb, kWavelengths> table = [] {
    std::array<Rgb, kWavelengths> w;
    Rgb sum(0);
    for (int i = 0; i < kWavelengths; ++i)
      sum += w[i] = xyz_to_linear_srgb(cie_1931_matching(kFirst + kStep * static_cast<float>(i)));
    for (Rgb& color : w) color /= sum;
    return w;
  }();
  return table;
}

}  // namespace

float thin_film_reflectance(float cosine, float film, float base, float thickness,
                            float wavelength) {
  const Film layer(cosine, film, base);
  return layer.reflectance(layer.phase(thickness, wavelength));
}

Rgb thin_film_color(float cosine, float film, const Rgb& base, float thickness) {
  const auto layer = [&](float reflectance) {
    const float root = std::sqrt(clamp(reflectance, 0, .998f));
    return Film(cosine, film, (1 + root) / (1 - root));
  };
  const std::array<Film, 3> films = {layer(base.x), layer(base.y), layer(base.z)};
  Rgb color(0);
  for (int i = 0; i < kWavelengths; ++i) {
    // The beams' paths within the film do not depend on the base.
    const float phase = films[0].phase(thickness, kFirst + kStep * static_cast<float>(i));
    for (int c = 0; c < 3; ++c) color[c] += weights()[i][c] * films[c].reflectance(phase);
  }
  return Rgb(clamp01(color.x), clamp01(color.y), clamp01(color.z));
}

}  // namespace oriel::bsdf
