// SPDX-License-Identifier: Apache-2.0
// One material for each side of a surface; the state is turned for the call and turned back.
#include <shader.h>

struct cp_sides {
  miTag front, back;
};

namespace {
struct Turned {
  Turned(miState* state, bool turn) : state_(state), turned_(turn) { flip(); }
  ~Turned() { flip(); }

 private:
  void flip() {
    if (!turned_) return;
    mi_vector_neg(&state_->normal);
    mi_vector_neg(&state_->normal_geom);
    state_->dot_nd = -state_->dot_nd;
    state_->inv_normal = !state_->inv_normal;
  }
  miState* state_;
  bool turned_;
};
}  // namespace

extern "C" DLLEXPORT int cp_sides_version(void) { return 1; }

// The material of the back sees the normal of the surface; the state is as before afterwards.
extern "C" DLLEXPORT miBoolean cp_sides(miColor* result, miState* state, cp_sides* paras) {
  const bool back = state->inv_normal;
  const miScalar before = state->normal.z;
  miBoolean answer;
  {
    Turned turned(state, back);
    answer = mi_call_shader(result, miSHADER_MATERIAL, state,
                            *mi_eval_tag(back ? &paras->back : &paras->front));
  }
  return answer && state->normal.z == before;
}
