// SPDX-License-Identifier: Apache-2.0
// Probe rays of limited length, and ray origins.
#include "oriel/sdk/shader/probe.h"

#include "oriel/sdk/shader/trace.h"

extern "C" {

miBoolean mi_trace_probe_x(miState* state, const miVector* direction, const miVector* origin,
                           double distance) {
  if (!mi_trace_probe(state, direction, origin)) return miFALSE;
  // Only the nearest hit can be within the distance.
  miState* child = state->child;
  if (!child || !(distance > 0) || child->dist <= distance) return miTRUE;
  child->dist = 0;
  child->pri = nullptr;
  child->material = child->instance = miNULLTAG;
  return miFALSE;
}

void mi_state_set_pri(miState* state, void* pri) {
  if (state) state->pri = static_cast<decltype(state->pri)>(pri);
}

}  // extern "C"
