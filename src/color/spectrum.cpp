// SPDX-License-Identifier: Apache-2.0
#include "color/spectrum.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "color/black_body.h"
#include "color/cie_daylight.h"

namespace oriel {
namespace {

// CIE 15:2004, table T.2, 400 to 700 nm by 10 nm.
constexpr float kDaylight[kSpectrumBands][3] = {
    {94.8f, 43.4f, -1.1f},  {104.8f, 46.3f, -0.5f}, {105.9f, 43.9f, -0.7f}, {96.8f, 37.1f, -1.2f},
    {113.9f, 36.7f, -2.6f}, {125.6f, 35.9f, -2.9f}, {125.5f, 32.6f, -2.8f}, {121.3f, 27.9f, -2.6f},
    {121.3f, 24.3f, -2.6f}, {113.5f, 20.1f, -1.8f}, {113.1f, 16.2f, -1.5f}, {110.8f, 13.2f, -1.3f},
    {106.5f, 8.6f, -1.2f},  {108.8f, 6.1f, -1.0f},  {105.3f, 4.2f, -0.5f},  {104.4f, 1.9f, -0.3f},
    {100.0f, 0.0f, 0.0f},   {96.0f, -1.6f, 0.2f},   {95.1f, -3.5f, 0.5f},   {89.1f, -3.5f, 2.1f},
    {90.5f, -5.8f, 3.2f},   {90.3f, -7.2f, 4.1f},   {88.4f, -8.6f, 4.7f},   {84.0f, -9.5f, 5.1f},
    {85.1f, -10.9f, 6.7f},  {81.9f, -10.7f, 7.3f},  {82.6f, -12.0f, 8.6f},  {84.9f, -14.0f, 9.8f},
    {81.3f, -13.6f, 10.2f}, {71.9f, -12.0f, 8.3f},  {74.3f, -13.3f, 9.6f}};

float band_nm(int band) { return kSpectrumFirstNm + kSpectrumStepNm * static_cast<float>(band); }

/// Contribution of each band to X, Y and Z.
std::array<Vec3, kSpectrumBands> matching_bands() {
  std::array<Vec3, kSpectrumBands> bands;
  float y = 0;
  for (int i = 0; i < kSpectrumBands; ++i) {
    bands[static_cast<std::size_t>(i)] = cie_1931_matching(band_nm(i));
    y += bands[static_cast<std::size_t>(i)].y;
  }
  for (Vec3& band : bands) band /= y;
  return bands;
}

const std::array<Vec3, kSpectrumBands>& bands_of_xyz() {
  static const std::array<Vec3, kSpectrumBands> bands = matching_bands();
  return bands;
}

/// Solves a x = b for three right-hand sides by Gaussian elimination with pivoting; modifies both.
/// In double, because the matrix combines slopes of 1 with matching functions near 0.01.
void solve(std::vector<std::vector<double>>& a, std::vector<std::array<double, 3>>& b) {
  const std::size_t n = a.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    std::swap(a[c], a[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double factor = a[r][c] / a[c][c];
      for (std::size_t k = c; k < n; ++k) a[r][k] -= factor * a[c][k];
      for (std::size_t k = 0; k < 3; ++k) b[r][k] -= factor * b[c][k];
    }
  }
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t k = 0; k < 3; ++k) b[r][k] /= a[r][r];
}

/// Smoothest spectra of unit X, Y and Z: minimum slope with the colour as a constraint (Lagrange
/// multipliers).
std::array<Vec3, kSpectrumBands> smooth_bands() {
  constexpr std::size_t kBands = kSpectrumBands, kAll = kBands + 3;
  std::vector<std::vector<double>> a(kAll, std::vector<double>(kAll, 0));
  std::vector<std::array<double, 3>> b(kAll, {0, 0, 0});
  for (std::size_t i = 0; i + 1 < kBands; ++i) {
    a[i][i] += 1, a[i + 1][i + 1] += 1;
    a[i][i + 1] -= 1, a[i + 1][i] -= 1;
  }
  for (std::size_t i = 0; i < kBands; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = bands_of_xyz()[i][static_cast<int>(k)];
      a[i][kBands + k] = a[kBands + k][i] = weight;
    }
  for (std::size_t k = 0; k < 3; ++k) b[kBands + k][k] = 1;
  solve(a, b);
  std::array<Vec3, kSpectrumBands> bands;
  for (std::size_t i = 0; i < kBands; ++i)
    bands[i] =
        Vec3(static_cast<float>(b[i][0]), static_cast<float>(b[i][1]), static_cast<float>(b[i][2]));
  return bands;
}

}  // namespace

Vec3 spectrum_xyz(const Spectrum& spectrum) {
  Vec3 xyz(0);
  for (std::size_t i = 0; i < spectrum.size(); ++i) xyz += bands_of_xyz()[i] * spectrum[i];
  return xyz;
}

Spectrum smooth_spectrum(const Vec3& xyz) {
  static const std::array<Vec3, kSpectrumBands> bands = smooth_bands();
  Spectrum s;
  for (std::size_t i = 0; i < s.size(); ++i) s[i] = dot(bands[i], xyz);
  return s;
}

Spectrum black_body_spectrum(float kelvin) {
  Spectrum s;
  // 0 below about 290 K, where the exponential overflows; the spectrum is then black.
  const double middle = black_body_spectral_radiance(560, kelvin);
  for (int i = 0; i < kSpectrumBands; ++i) {
    const double radiance = black_body_spectral_radiance(band_nm(i), kelvin);
    s[static_cast<std::size_t>(i)] = middle > 0 ? static_cast<float>(radiance / middle) : 0.0f;
  }
  return s;
}

Spectrum daylight_spectrum(float kelvin) {
  const Vec2 c = cie_daylight_chromaticity(kelvin);
  const float below = 0.0241f + 0.2562f * c.x - 0.7341f * c.y;
  const float m1 = (-1.3515f - 1.7703f * c.x + 5.9114f * c.y) / below;
  const float m2 = (0.0300f - 31.4424f * c.x + 30.0717f * c.y) / below;
  Spectrum s;
  for (std::size_t i = 0; i < s.size(); ++i)
    s[i] = kDaylight[i][0] + m1 * kDaylight[i][1] + m2 * kDaylight[i][2];
  return s;
}

int spectrum_band(float nm) {
  const float band = (nm - kSpectrumFirstNm) / kSpectrumStepNm + 0.5f;
  return band >= 0 && band < static_cast<float>(kSpectrumBands) ? static_cast<int>(band) : -1;
}

Spectrum with_luminance(Spectrum spectrum, float luminance) {
  const float y = spectrum_xyz(spectrum).y;
  for (float& band : spectrum) band = y > 0 ? band * (luminance / y) : 0.0f;
  return spectrum;
}

std::optional<Spectrum> cie_illuminant(std::string_view name) {
  constexpr std::pair<std::string_view, float> kDaylights[] = {
      {"D50", 5003}, {"D55", 5503}, {"D65", 6504}, {"D75", 7504}};
  for (const auto& [known, kelvin] : kDaylights)
    if (name == known) return daylight_spectrum(kelvin);
  if (name == "A") return black_body_spectrum(2856);
  if (name != "E") return {};
  Spectrum flat;
  flat.fill(1);
  return flat;
}

}  // namespace oriel
