// SPDX-License-Identifier: Apache-2.0
// Spectra of shaders. The picture itself is rendered in RGB.
#include "oriel/sdk/shader/spectrum.h"

#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

#include "color/spectrum.h"
#include "color/srgb.h"
#include "sdk/current.h"
#include "sdk/geometry_parts.h"
#include "sdk/host.h"
#include "sdk/once.h"
#include "sdk/spectrum_layout.h"

namespace oriel::sdk {
namespace {

/// Black if the spectrum is invalid.
Spectrum bands_of(const miSpectrum& s) {
  Spectrum bands = {};
  if (mi_spectrum_check(&s)) std::memcpy(bands.data(), s.value + kSpectrumBandsAt, sizeof bands);
  return bands;
}

/// Replaces the bands of a valid spectrum by `change` of them.
template <class F>
void change_bands(miSpectrum* s, F&& change) {
  if (!s) return;
  Spectrum bands = bands_of(*s);
  change(bands);
  set_spectrum(*s, bands);
}

/// Same, with the bands of another spectrum as second argument.
template <class F>
void combine_bands(miSpectrum* s, const miSpectrum* other, F&& change) {
  if (!s || !other) return;
  const Spectrum others = bands_of(*other);
  change_bands(s, [&](Spectrum& bands) {
    for (std::size_t i = 0; i < bands.size(); ++i) bands[i] = change(bands[i], others[i]);
  });
}

/// Sets the bands, scaled to a luminance.
void set_scaled(miSpectrum* s, const Spectrum& bands, miScalar luminance) {
  if (s) set_spectrum(*s, with_luminance(bands, luminance));
}

}  // namespace

void set_spectrum(miSpectrum& s, const Spectrum& bands) {
  std::memset(&s, 0, sizeof s);
  const Vec3 xyz = spectrum_xyz(bands);
  s.value[0] = xyz.x, s.value[1] = xyz.y, s.value[2] = xyz.z;
  s.value[3] = 1;
  std::memcpy(s.value + kSpectrumMarkAt, &kSpectrumMark, sizeof kSpectrumMark);
  std::memcpy(s.value + kSpectrumBandsAt, bands.data(), sizeof bands);
}

}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

const char* mi_spectrum_enabled(void) { return nullptr; }

miSpectrum* mi_spectrum_ensure(miSpectrum* s) {
  if (s && !mi_spectrum_check(s)) set_spectrum(*s, {});
  return s;
}

miBoolean mi_spectrum_check(const miSpectrum* s) {
  if (!s) return miFALSE;
  std::uint32_t mark = 0;
  std::memcpy(&mark, s->value + kSpectrumMarkAt, sizeof mark);
  return mark == kSpectrumMark ? miTRUE : miFALSE;
}

unsigned int mi_spectrum_size(const miSpectrum*) { return sizeof(miSpectrum); }

void mi_spectrum_range_get(const miSpectrum*, miScalar* lo, miScalar* hi) {
  mi_spectrum_visible_range(lo, hi);
}

void mi_spectrum_visible_range(miScalar* lo, miScalar* hi) {
  if (lo) *lo = kSpectrumFirstNm;
  if (hi) *hi = kSpectrumFirstNm + kSpectrumStepNm * (kSpectrumBands - 1);
}

miSpectrum* mi_spectrum_blueprint(void) {
  // per thread, because a shader may write to it
  thread_local miSpectrum black;
  set_spectrum(black, {});
  return &black;
}

miSpectrum* mi_spectrum_create(const miSpectrum*) {
  auto* s = static_cast<miSpectrum*>(std::malloc(sizeof(miSpectrum)));
  if (s) set_spectrum(*s, {});
  return s;
}

miSpectrum* mi_spectrum_create_inheap(const miSpectrum* blueprint) {
  return mi_spectrum_create(blueprint);
}

miSpectrum* mi_spectrum_clone(const miSpectrum* s) {
  miSpectrum* copy = mi_spectrum_create(nullptr);
  if (copy) mi_spectrum_assign(copy, s);
  return copy;
}

void mi_spectrum_delete(miSpectrum* s) { std::free(s); }
void mi_spectrum_delete_fromheap(miSpectrum* s) { std::free(s); }

void mi_spectrum_clear(miSpectrum* s) {
  if (s) set_spectrum(*s, {});
}
void mi_spectrum_reset(miSpectrum* s) { mi_spectrum_clear(s); }

void mi_spectrum_copy(miSpectrum* to, const miSpectrum* from) { mi_spectrum_assign(to, from); }

void mi_spectrum_assign(miSpectrum* to, const miSpectrum* from) {
  if (to) set_spectrum(*to, from ? bands_of(*from) : Spectrum{});
}

void mi_spectrum_assign_data(miSpectrum* to, const miSpectrum_data*) {
  oriel::sdk::warn_once(
      "OR-SDK-020", "spectrum elements of the scene are unsupported in shaders; they are black");
  mi_spectrum_ensure(to);
}

void mi_spectrum_add(miSpectrum* s, const miSpectrum* other) {
  combine_bands(s, other, [](float a, float b) { return a + b; });
}

void mi_spectrum_mul(miSpectrum* s, const miSpectrum* other) {
  combine_bands(s, other, [](float a, float b) { return a * b; });
}

void mi_spectrum_scale(miSpectrum* s, miScalar factor) {
  change_bands(s, [factor](Spectrum& bands) {
    for (float& band : bands) band *= factor;
  });
}

void mi_spectrum_color_add(miSpectrum* s, const miColor* color) {
  if (!color) return;
  const Spectrum added = smooth_spectrum(linear_srgb_to_xyz(Rgb(color->r, color->g, color->b)));
  change_bands(s, [&added](Spectrum& bands) {
    for (std::size_t i = 0; i < bands.size(); ++i) bands[i] += added[i];
  });
}

void mi_spectrum_lerp(miSpectrum* s, const miSpectrum* other, miScalar t) {
  combine_bands(s, other, [t](float a, float b) { return a + (b - a) * t; });
}

miScalar mi_spectrum_value_get(const miSpectrum* s, miScalar nm) {
  const int band = spectrum_band(nm);
  return band >= 0 && mi_spectrum_check(s) ? s->value[kSpectrumBandsAt + band] : 0.0f;
}

miScalar mi_spectrum_value_set(miSpectrum* s, miScalar nm, miScalar value) {
  const int band = spectrum_band(nm);
  if (band >= 0)
    change_bands(s, [&](Spectrum& bands) { bands[static_cast<std::size_t>(band)] = value; });
  return mi_spectrum_value_get(s, nm);
}

miScalar mi_spectrum_value_add(miSpectrum* s, miScalar nm, miScalar value) {
  return mi_spectrum_value_set(s, nm, mi_spectrum_value_get(s, nm) + value);
}

miScalar mi_spectrum_linewidth(const miSpectrum*, miScalar nm) {
  return spectrum_band(nm) >= 0 ? kSpectrumStepNm : 0.0f;
}

void mi_spectrum_blackbody(miSpectrum* s, miScalar kelvin, miScalar intensity) {
  set_scaled(s, kelvin > 0 ? black_body_spectrum(kelvin) : Spectrum{}, intensity);
}

void mi_spectrum_cie_sky(miSpectrum* s, miScalar kelvin, miScalar intensity) {
  set_scaled(s, daylight_spectrum(kelvin), intensity);
}

void mi_spectrum_cie(miSpectrum* s, miScalar intensity, const char* illuminant) {
  const std::string name = illuminant ? illuminant : "";
  const std::optional<Spectrum> known = cie_illuminant(name);
  if (!known) {
    oriel::sdk::warn_once("OR-SDK-020",
                          "unknown CIE illuminant \"" + name + "\"; a flat spectrum is used");
  }
  set_scaled(s, known ? *known : *cie_illuminant("E"), intensity);
}

void mi_spectrum_rgb(miColor* to, const miSpectrum* s) {
  if (!to) return;
  mi_spectrum_ciexyz(to, s);
  const Rgb c = xyz_to_linear_srgb(Vec3(to->r, to->g, to->b));
  to->r = c.x, to->g = c.y, to->b = c.z;
}

void mi_spectrum_ciexyz(miColor* to, const miSpectrum* s) {
  if (!to) return;
  *to = {0, 0, 0, 1};
  if (mi_spectrum_check(s)) to->r = s->value[0], to->g = s->value[1], to->b = s->value[2];
}

}  // extern "C"
