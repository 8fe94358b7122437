// SPDX-License-Identifier: Apache-2.0
// Classes with virtual functions, made by a factory; what fails throws and is caught inside.
#include <cmath>
#include <memory>
#include <stdexcept>

#include "view.h"

struct cp_pattern {
  int kind;
  miScalar size;
  miColor first, second;
};

class Pattern {
 public:
  virtual ~Pattern() {}
  virtual miScalar at(const miVector& p) const = 0;
};

class Rings : public Pattern {
 public:
  virtual miScalar at(const miVector& p) const {
    return miScalar(.5 + .5 * std::cos(std::sqrt(p.x * p.x + p.y * p.y)));
  }
};

class Waves : public Pattern {
 public:
  explicit Waves(double turn) : turn_(turn) {}
  virtual miScalar at(const miVector& p) const {
    return miScalar(.5 + .5 * std::sin(p.x * std::cos(turn_) + p.y * std::sin(turn_)));
  }

 private:
  double turn_;
};

static std::auto_ptr<Pattern> make(int kind) {
  if (kind == 0) return std::auto_ptr<Pattern>(new Rings);
  if (kind == 1) return std::auto_ptr<Pattern>(new Waves(M_PI / 4));
  throw std::out_of_range("no such pattern");
}

extern "C" DLLEXPORT int cp_pattern_version(void) { return 1; }

extern "C" DLLEXPORT miBoolean cp_pattern(miColor* result, miState* state, cp_pattern* paras) {
  const corpus::View view(state);
  const corpus::Color a = view(paras->first), b = view(paras->second);
  try {
    const std::auto_ptr<Pattern> pattern = make(view(paras->kind));
    const miScalar t = pattern->at(view.point() * (1 / view(paras->size)));
    *result = a * corpus::Color(1 - t);
    result->r += b.r * t; result->g += b.g * t; result->b += b.b * t;
  } catch (const std::exception&) {
    *result = b;
  }
  return miTRUE;
}
