// SPDX-License-Identifier: Apache-2.0
// Parameter evaluation, and the functions of a shader that the renderer calls.
#ifndef ORIEL_SDK_EVAL_H
#define ORIEL_SDK_EVAL_H

// Conventions
//   A shader NAME is `miBoolean NAME(T* result, miState* state, struct NAME* paras)` with an
//   optional fourth argument void*. It is found by name: extern "C" in C++. NAME_version(void)
//   returns the version of its declaration. NAME_init(state, NULL, &req) runs once before its first
//   call and, if it sets req, NAME_init(state, paras, &req) once for each instance;
//   NAME_exit(state, paras) and finally NAME_exit(state, NULL) end it. miFALSE means: no light,
//   nothing found.

#include "state.h"
#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct miShader_state_arg {
  miShader_state_op op;
  miBoolean shader_return;  ///< return value of the shader of the sample
} miShader_state_arg;

/// Mesh that a lightmap shader is called for; opaque.
typedef struct miRclm_mesh_render miRclm_mesh_render;

typedef miBoolean (*miShader)(void* result, miState* state, void* paras);
typedef miBoolean (*miShaderx)(void* result, miState* state, void* paras, void* arg);
typedef miBoolean (*miShader_init)(miState* state, void* paras, miBoolean* inst_init_req);
typedef miBoolean (*miShader_exit)(miState* state, void* paras);
typedef int (*miShader_version)(void);
typedef miBoolean (*miShader_state)(void* result, miState* state, void* paras,
                                    miShader_state_arg* arg);

/// Value of the parameter at `parm`: its address, or the result of the connected shader.
void* mi_phen_eval(miState* state, void* parm);
/// Like mi_phen_eval, but runs the connected shader at each call.
void* mi_phen_call(miState* state, void* parm);

/// Address of the value of the parameter at `p` of the running shader; runs a connected shader.
#define mi_eval(s, p) mi_phen_eval((s), (void*)(p))

// The typed macros use the variable `state` of the enclosing scope.
/// Value of a boolean parameter.
#define mi_eval_boolean(p) ((miBoolean*)mi_eval(state, p))
/// Value of an integer parameter.
#define mi_eval_integer(p) ((miInteger*)mi_eval(state, p))
/// Value of a scalar parameter.
#define mi_eval_scalar(p) ((miScalar*)mi_eval(state, p))
/// Value of a vector parameter.
#define mi_eval_vector(p) ((miVector*)mi_eval(state, p))
/// Value of a transform parameter, 16 scalars.
#define mi_eval_transform(p) ((miScalar*)mi_eval(state, p))
/// Value of a color parameter.
#define mi_eval_color(p) ((miColor*)mi_eval(state, p))
/// Value of a parameter that is a tag: shader, texture, light, string.
#define mi_eval_tag(p) ((miTag*)mi_eval(state, p))
/// Value of a spectrum parameter.
#define mi_eval_spectrum(p) ((miSpectrum*)mi_eval(state, p))

/// Like mi_eval_boolean, without cache.
#define mi_call_boolean(p) ((miBoolean*)mi_phen_call(state, (void*)(p)))
/// Like mi_eval_integer, without cache.
#define mi_call_integer(p) ((miInteger*)mi_phen_call(state, (void*)(p)))
/// Like mi_eval_scalar, without cache.
#define mi_call_scalar(p) ((miScalar*)mi_phen_call(state, (void*)(p)))
/// Like mi_eval_vector, without cache.
#define mi_call_vector(p) ((miVector*)mi_phen_call(state, (void*)(p)))
/// Like mi_eval_transform, without cache.
#define mi_call_transform(p) ((miScalar*)mi_phen_call(state, (void*)(p)))
/// Like mi_eval_color, without cache.
#define mi_call_color(p) ((miColor*)mi_phen_call(state, (void*)(p)))
/// Like mi_eval_tag, without cache.
#define mi_call_tag(p) ((miTag*)mi_phen_call(state, (void*)(p)))

#ifdef __cplusplus
}
#endif

#endif
