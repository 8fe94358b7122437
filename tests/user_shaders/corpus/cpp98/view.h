// SPDX-License-Identifier: Apache-2.0
// A class over the state, vectors with operators, parameters as templates.
#ifndef CORPUS_VIEW_H
#define CORPUS_VIEW_H

#include <shader.h>

#undef EVAL

namespace corpus {

template <typename T>
struct Evaluated;
template <>
struct Evaluated<miColor> {
  static miColor of(miState* state, miColor* p) { return *mi_eval_color(p); }
};
template <>
struct Evaluated<miScalar> {
  static miScalar of(miState* state, miScalar* p) { return *mi_eval_scalar(p); }
};
template <>
struct Evaluated<int> {
  static int of(miState* state, int* p) { return *mi_eval_integer(p); }
};
template <>
struct Evaluated<miTag> {
  static miTag of(miState* state, miTag* p) { return *mi_eval_tag(p); }
};

struct Vec : public miVector {
  Vec(miScalar x_, miScalar y_, miScalar z_) { x = x_; y = y_; z = z_; }
  Vec(const miVector& v) { x = v.x; y = v.y; z = v.z; }
  Vec operator-(const Vec& b) const { return Vec(x - b.x, y - b.y, z - b.z); }
  Vec operator+(const Vec& b) const { return Vec(x + b.x, y + b.y, z + b.z); }
  Vec operator*(miScalar f) const { return Vec(x * f, y * f, z * f); }
  miScalar operator*(const Vec& b) const { return mi_vector_dot(this, &b); }
  Vec unit() const {
    Vec r(*this);
    mi_vector_normalize(&r);
    return r;
  }
};

struct Color : public miColor {
  Color() { r = g = b = 0; a = 1; }
  Color(miScalar v) { r = g = b = v; a = 1; }
  Color(const miColor& c) { r = c.r; g = c.g; b = c.b; a = c.a; }
  Color& operator+=(const Color& c) { r += c.r; g += c.g; b += c.b; return *this; }
  Color& operator/=(miScalar f) { r /= f; g /= f; b /= f; return *this; }
};
inline Color operator*(Color a, const Color& b) { a.r *= b.r; a.g *= b.g; a.b *= b.b; return a; }

class View {
 public:
  explicit View(miState* state) : state_(state) {}
  template <typename T>
  T operator()(T& parameter) const { return Evaluated<T>::of(state_, &parameter); }
  Vec point() const { return state_->point; }
  Vec normal() const { return state_->normal; }
  bool is_shadow() const { return state_->type == miRAY_SHADOW; }
  miState* operator->() const { return state_; }
  operator miState*() const { return state_; }

 private:
  miState* state_;
};

/// Lights of the usual parameters: mode, start, number, elements.
class LightLoop {
 public:
  LightLoop(const View& view, int mode, int start, int number, miTag* lights)
      : view_(view), lights_(lights + start), left_(number), samples_(0) {
    if (mode == 1) mi_inclusive_lightlist(&left_, &lights_, view_);
    if (mode == 2) mi_exclusive_lightlist(&left_, &lights_, view_);
    if (mode == 4) { left_ = 0; mi_instance_lightlist(&left_, &lights_, view_); }
  }
  bool done() const { return left_ <= 0; }
  void next() { --left_; ++lights_; samples_ = 0; }
  bool sample() {
    return mi_sample_light(&color, &direction, &cosine, view_, *lights_, &samples_) == miTRUE;
  }
  int samples() const { return samples_; }

  Color color;
  miVector direction;
  miScalar cosine;

 private:
  View view_;
  miTag* lights_;
  int left_, samples_;
};

}  // namespace corpus

#endif
