// SPDX-License-Identifier: Apache-2.0
// Does a ray hit something within a distance, and where do rays start?
#ifndef ORIEL_SDK_PROBE_H
#define ORIEL_SDK_PROBE_H

// Conventions
//   As in trace.h.
//   The arguments are Oriel's choice: no description of them was available.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// As mi_trace_probe, for hits up to a distance; 0 = any.
miBoolean mi_trace_probe_x(miState* state, const miVector* direction, const miVector* origin,
                           double distance);
/// Sets state->pri: what rays from here start on; NULL = empty space.
void mi_state_set_pri(miState* state, void* pri);

#ifdef __cplusplus
}
#endif

#endif
