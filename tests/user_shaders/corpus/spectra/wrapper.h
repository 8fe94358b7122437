// SPDX-License-Identifier: Apache-2.0
// A spectrum as a value: every operation is one of the interface's.
#ifndef CORPUS_WRAPPER_H
#define CORPUS_WRAPPER_H

#include <shader.h>

namespace spectra {

class Spectrum {
 public:
  Spectrum() : s_(mi_spectrum_create(mi_spectrum_blueprint())) {}
  explicit Spectrum(miScalar value) : s_(mi_spectrum_create(NULL)) {
    for (miScalar nm = first(); nm <= last(); nm += step(nm)) mi_spectrum_value_set(s_, nm, value);
  }
  explicit Spectrum(const miColor& color) : s_(mi_spectrum_create(NULL)) { *this += color; }
  Spectrum(const Spectrum& other) : s_(mi_spectrum_clone(other.s_)) {}
  ~Spectrum() { mi_spectrum_delete(s_); }
  Spectrum& operator=(const Spectrum& other) {
    if (this != &other) mi_spectrum_assign(s_, other.s_);
    return *this;
  }

  Spectrum& operator+=(const Spectrum& other) { return mi_spectrum_add(s_, other.s_), *this; }
  Spectrum& operator+=(const miColor& color) { return mi_spectrum_color_add(s_, &color), *this; }
  Spectrum& operator*=(const Spectrum& other) { return mi_spectrum_mul(s_, other.s_), *this; }
  Spectrum& operator*=(miScalar factor) { return mi_spectrum_scale(s_, factor), *this; }
  Spectrum& lerp(const Spectrum& other, miScalar t) {
    return mi_spectrum_lerp(s_, other.s_, t), *this;
  }

  miScalar operator[](miScalar nm) const { return mi_spectrum_value_get(s_, nm); }
  void set(miScalar nm, miScalar value) { mi_spectrum_value_set(s_, nm, value); }
  void add(miScalar nm, miScalar value) { mi_spectrum_value_add(s_, nm, value); }
  void blackbody(miScalar kelvin, miScalar intensity) {
    mi_spectrum_blackbody(s_, kelvin, intensity);
  }
  bool valid() const { return mi_spectrum_check(s_) != miFALSE; }
  static bool rendered() { return mi_spectrum_enabled() != NULL; }

  miColor rgb() const {
    miColor c;
    mi_spectrum_rgb(&c, s_);
    c.a = 1;
    return c;
  }

  miScalar first() const { return end_of_range(true); }
  miScalar last() const { return end_of_range(false); }
  miScalar step(miScalar nm) const { return mi_spectrum_linewidth(s_, nm); }

 private:
  miScalar end_of_range(bool low) const {
    miScalar lo, hi;
    mi_spectrum_range_get(s_, &lo, &hi);
    return low ? lo : hi;
  }

  miSpectrum* s_;
};

inline Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
inline Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }

}  // namespace spectra

#endif
