// SPDX-License-Identifier: Apache-2.0
// Two shaders of a kit: a gradient whose ends are read once, and one that hands a vector on.
#include "kit.h"

struct GradientParas {
  miScalar from, to;
  miVector at;
};

class Gradient : public ShaderKit<Gradient, GradientParas> {
 public:
  Gradient() : from_(0), slope_(0) {}
  void init(miState* state, GradientParas* paras) {
    from_ = *mi_eval_scalar(&paras->from);
    slope_ = *mi_eval_scalar(&paras->to) - from_;
  }
  miBoolean operator()(miColor* result, miState* state, GradientParas* paras) const {
    const miVector at = *mi_eval_vector(&paras->at);
    result->r = result->g = result->b = from_ + slope_ * at.x;
    result->a = 1;
    return miTRUE;
  }

 private:
  miScalar from_, slope_;
};

struct TurnedParas {
  miBoolean swap;
};

class Turned : public ShaderKit<Turned, TurnedParas> {
 public:
  miBoolean operator()(miVector* result, miState* state, TurnedParas* paras) const {
    const miVector& uv = state->tex_list[0];
    result->x = *mi_eval_boolean(&paras->swap) ? uv.y : uv.x;
    result->y = *mi_eval_boolean(&paras->swap) ? uv.x : uv.y;
    result->z = 0;
    return miTRUE;
  }
};

KIT_EXPOSE(cp_kit, Gradient, miColor, 1)
KIT_EXPOSE(cp_kit_turned, Turned, miVector, 1)
