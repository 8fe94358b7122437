// SPDX-License-Identifier: Apache-2.0
// Black bodies: Planck's law integrated against analytic colour matching functions.
#include "color/black_body.h"

#include "base/math.h"
#include "color/srgb.h"

namespace oriel {
namespace {

// Planck's law in doubles: the constants span fifty orders of magnitude.
constexpr double kPlanck = 6.62607015e-34;        // J s, SI 2019
constexpr double kLightSpeed = 299792458.0;       // m/s, SI 2019
constexpr double kBoltzmann = 1.380649e-23;       // J/K, SI 2019
constexpr double kStefanBoltzmann = 5.670374e-8;  // W m^-2 K^-4, CODATA 2018
constexpr double kMaximumEfficacyLmPerW = 683.0;  // photopic, SI candela
constexpr double kPi64 = 3.14159265358979323846;

/// Spectral radiance, W m^-2 sr^-1 per metre of wavelength.
double planck(double wavelength_m, double kelvin) {
  const double hc = kPlanck * kLightSpeed;
  return 2 * hc * kLightSpeed / math::pow(wavelength_m, 5) /
         math::expm1(hc / (wavelength_m * kBoltzmann * kelvin));
}

/// Gaussian with one width below its centre and another above.
float lobe(float x, float centre, float below, float above) {
  const float t = (x - centre) * (x < centre ? below : above);
  return math::exp(-0.5f * t * t);
}

}  // namespace

Vec3 cie_1931_matching(float wavelength_nm) {
  const float w = wavelength_nm;
  return Vec3(
      0.362f * lobe(w, 442.0f, 0.0624f, 0.0374f) + 1.056f * lobe(w, 599.8f, 0.0264f, 0.0323f) -
          0.065f * lobe(w, 501.1f, 0.0490f, 0.0382f),
      0.821f * lobe(w, 568.8f, 0.0213f, 0.0247f) + 0.286f * lobe(w, 530.9f, 0.0613f, 0.0322f),
      1.217f * lobe(w, 437.0f, 0.0845f, 0.0278f) + 0.681f * lobe(w, 459.0f, 0.0385f, 0.0725f));
}

double black_body_spectral_radiance(double wavelength_nm, double kelvin) {
  if (!(wavelength_nm > 0) || !(kelvin > 0)) return 0;
  return planck(wavelength_nm * 1e-9, kelvin) * 1e-9;
}

double black_body_radiance(double kelvin) {
  const double t2 = kelvin * kelvin;
  return kelvin > 0 ? kStefanBoltzmann * t2 * t2 / kPi64 : 0;
}

Vec3 black_body_xyz(float kelvin) {
  constexpr int kFirstNm = 360, kLastNm = 830;
  double x = 0, y = 0, z = 0;
  for (int nm = kFirstNm; nm <= kLastNm; ++nm) {
    const double radiance = planck(nm * 1e-9, kelvin) * 1e-9;  // per nm, the step
    const Vec3 matching = cie_1931_matching(static_cast<float>(nm));
    x += radiance * matching.x;
    y += radiance * matching.y;
    z += radiance * matching.z;
  }
  const double k = kMaximumEfficacyLmPerW;
  return Vec3(static_cast<float>(k * x), static_cast<float>(k * y), static_cast<float>(k * z));
}

Rgb black_body_color(float kelvin) {
  const Vec3 xyz = black_body_xyz(kelvin);
  if (!(xyz.y > 0)) return Rgb(1, 0, 0);  // no visible light: return the red end of the scale
  // Normalise before the matrix to keep precision for very low temperatures.
  Rgb c = xyz_to_linear_srgb(xyz * (1 / xyz.y));
  c = Rgb(std::max(c.x, 0.0f), std::max(c.y, 0.0f), std::max(c.z, 0.0f));
  return c * (1 / max_component(c));
}

float black_body_efficacy(float kelvin) {
  return static_cast<float>(black_body_xyz(kelvin).y / black_body_radiance(kelvin));
}

}  // namespace oriel
