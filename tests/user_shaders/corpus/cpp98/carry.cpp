// SPDX-License-Identifier: Apache-2.0
// A mirror hands a structure down to what its rays meet, and counts what comes back.
#include "view.h"

struct cp_carry {
  miScalar share;
};

namespace {

struct Load {
  miUint magic;
  int bounces;
  const Load* before;
};
const miUint kMagic = 0x0A71E1u;

// Restores what the state held, whichever way the function ends.
class Carried {
 public:
  Carried(miState* state, Load* load) : state_(state), user_(state->user), size_(state->user_size) {
    state->user = load;
    state->user_size = sizeof(*load);
  }
  ~Carried() {
    state_->user = user_;
    state_->user_size = size_;
  }

 private:
  miState* state_;
  void* user_;
  int size_;
};

const Load* load_of(const miState* state) {
  const Load* load = static_cast<const Load*>(state->user);
  return load && state->user_size == (int)sizeof(Load) && load->magic == kMagic ? load : NULL;
}

}  // namespace

extern "C" {

DLLEXPORT int cp_carry_version(void) { return 1; }

DLLEXPORT miBoolean cp_carry(miColor* result, miState* state, cp_carry* paras) {
  const corpus::View view(state);
  const Load* before = load_of(state);
  Load mine = {kMagic, before ? before->bounces + 1 : 1, before};
  miColor seen = {0, 0, 0, 0};
  miVector dir;
  mi_reflection_dir(&dir, state);
  {
    Carried carried(state, &mine);
    if (!mi_trace_reflection(&seen, state, &dir)) mi_trace_environment(&seen, state, &dir);
  }
  const miScalar share = view(paras->share);
  result->r = seen.r * share;
  result->g = seen.g * share;
  // An eighth of how far the ray went, when it met something.
  result->b = state->child && state->child->dist > 0 ? miScalar(state->child->dist) / 8 : 0;
  result->a = 1;
  return miTRUE;
}

DLLEXPORT int cp_carried_version(void) { return 1; }

// Red: mirrors on the way. Green: whether the first of them is still known.
DLLEXPORT miBoolean cp_carried(miColor* result, miState* state, void*) {
  const Load* load = load_of(state);
  result->r = load ? miScalar(load->bounces) : 0;
  while (load && load->before) load = load->before;
  result->g = load && load->bounces == 1 ? 1 : 0;
  result->b = 0;
  result->a = 1;
  return miTRUE;
}

}
