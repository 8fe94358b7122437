// SPDX-License-Identifier: Apache-2.0
// Whether a parameter of the running shader was set.
#ifndef ORIEL_SDK_PARAMETER_SET_H
#define ORIEL_SDK_PARAMETER_SET_H

// Conventions
//   s: the state. p: the address of a member of the running shader's own parameters.

#include "eval.h"
#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Whether the parameter is connected to a shader, or to a parameter of a phenomenon that is
/// connected to a shader.
miBoolean oriel_parameter_is_connected(const miState* state, const void* parameter);
/// Whether a parameter is connected or differs from its default. A scene that sets the default is
/// indistinguishable from one that does not set the parameter.
miBoolean oriel_parameter_is_set(const miState* state, const void* parameter);

/// Whether any parameter of the running shader is connected.
#define mi_has_ghosts(s) ((s)->shader && (s)->shader->ghost_offs != 0)
/// Whether the parameter is connected to another shader.
#define mi_is_connected(s, p) oriel_parameter_is_connected((s), (p))
/// Whether the parameter is connected or differs from its default.
#define mi_is_set(s, p) oriel_parameter_is_set((s), (p))
/// Like mi_eval; NULL if mi_is_set is miFALSE.
#define mi_eval_set(s, p) (mi_is_set(s, p) ? mi_eval(s, p) : (void*)0)

#ifdef __cplusplus
}
#endif

#endif
