// SPDX-License-Identifier: Apache-2.0
// Templates around the state, between blocks of extern "C".
#include <shader.h>

extern "C" {
struct cp_blocks {
  miColor tint;
  miVector scale;
  miBoolean flip;
};
}

namespace {

template <typename T> struct ParamTraits;
template <> struct ParamTraits<miScalar> { enum { type = miTYPE_SCALAR }; };
template <> struct ParamTraits<miInteger> { enum { type = miTYPE_INTEGER }; };
template <> struct ParamTraits<miColor> { enum { type = miTYPE_COLOR }; };
template <> struct ParamTraits<miVector> { enum { type = miTYPE_VECTOR }; };

/// The state of a shader with parameters P.
template <class P>
class Context {
 public:
  Context(miState* state, P* paras) : state_(state), paras_(paras) {}

  template <class T>
  const T& operator()(T P::*member) const {
    typedef char known[ParamTraits<T>::type >= 0 ? 1 : -1];
    (void)sizeof(known);
    return *static_cast<T*>(mi_eval(state_, &(paras_->*member)));
  }
  miState* operator->() const { return state_; }

  template <class F>
  miVector in_object(F transform, const miVector& v) const {
    miVector out;
    transform(state_, &out, &v);
    return out;
  }

 private:
  miState* state_;
  P* paras_;
};

template <int N>
struct Power {
  static miScalar of(miScalar x) { return x * Power<N - 1>::of(x); }
};
template <>
struct Power<0> {
  static miScalar of(miScalar) { return 1; }
};

}  // namespace

extern "C" {

DLLEXPORT int cp_blocks_version(void) { return 1; }

DLLEXPORT miBoolean cp_blocks(miColor* result, miState* state, struct cp_blocks* paras) {
  const Context<struct cp_blocks> c(state, paras);
  const miColor& tint = c(&cp_blocks::tint);
  const miVector& scale = c(&cp_blocks::scale);
  const miVector p = c.in_object(&mi_point_to_object, c->point);
  miScalar u = p.x * scale.x;
  if (c(&cp_blocks::flip) != miFALSE) u = -u;
  result->r = tint.r * Power<2>::of(u);
  result->g = tint.g * Power<1>::of(u);
  result->b = tint.b * Power<0>::of(u);
  result->a = 1;
  return miTRUE;
}

}

extern "C" {
DLLEXPORT miBoolean cp_blocks_init(miState*, struct cp_blocks*, miBoolean* again) {
  *again = miFALSE;
  return miTRUE;
}
}
