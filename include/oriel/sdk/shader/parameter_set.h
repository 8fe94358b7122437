// SPDX-License-Identifier: Apache-2.0
// Was a parameter of the running shader given a value?
#ifndef ORIEL_SDK_PARAMETER_SET_H
#define ORIEL_SDK_PARAMETER_SET_H

// Conventions
//   s: the state. p: the address of a member of the running shader's own parameters.

#include "eval.h"
#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Whether a shader, or a parameter of a phenomenon that is a shader, gives the parameter its
/// value.
miBoolean oriel_parameter_is_connected(const miState* state, const void* parameter);
/// Whether a parameter is connected or has another value than its default: a scene that writes the
/// default cannot be told from one that writes nothing.
miBoolean oriel_parameter_is_set(const miState* state, const void* parameter);

/// Whether anything is connected to the running shader.
#define mi_has_ghosts(s) ((s)->shader && (s)->shader->ghost_offs != 0)
/// Whether the parameter gets its value from another shader.
#define mi_is_connected(s, p) oriel_parameter_is_connected((s), (p))
/// Whether the parameter is connected or differs from its default.
#define mi_is_set(s, p) oriel_parameter_is_set((s), (p))
/// As mi_eval; NULL where mi_is_set is miFALSE.
#define mi_eval_set(s, p) (mi_is_set(s, p) ? mi_eval(s, p) : (void*)0)

#ifdef __cplusplus
}
#endif

#endif
