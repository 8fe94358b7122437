// SPDX-License-Identifier: Apache-2.0
// Probe rays of limited length, and the origin of rays.
#ifndef ORIEL_SDK_PROBE_H
#define ORIEL_SDK_PROBE_H

// Conventions
//   As in trace.h.
//   The signatures are specific to Oriel, because no description of them was available.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Like mi_trace_probe, for hits up to a distance; 0 = unlimited.
miBoolean mi_trace_probe_x(miState* state, const miVector* direction, const miVector* origin,
                           double distance);
/// Sets state->pri, the primitive that rays start from; NULL = empty space.
void mi_state_set_pri(miState* state, void* pri);

#ifdef __cplusplus
}
#endif

#endif
