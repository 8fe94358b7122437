// SPDX-License-Identifier: Apache-2.0
// Functions of Maya's translator for shaders.
#ifndef ORIEL_SDK_MAYAAPI_H
#define ORIEL_SDK_MAYAAPI_H

// Conventions
//   Only mayabase_stateitem_get is supported. All other functions return miFALSE, and shaders then
//   use their own defaults.

#include "shader.h"

#ifdef __cplusplus
extern "C" {
#endif

/// State items, each a miBoolean per thread. The light items are set to miTRUE before a light
/// shader runs and may be changed by it. After a light sample they state whether the light affects
/// diffuse reflection and highlights.
typedef enum MbStateItem {
  MBSI_NULL = 0,  ///< terminates the list
  MBSI_LIGHTDIFFUSE,
  MBSI_LIGHTSPECULAR
} MbStateItem;

/// Alternating items and addresses of pointers, terminated by MBSI_NULL: each pointer is set to its
/// item. At an unknown item it returns miFALSE and leaves the remaining pointers unchanged.
miBoolean mayabase_stateitem_get(miState* state, ...);
/// Lights linked to the object; unsupported.
miBoolean mayabase_lightlink_get(miState* state, ...);
/// Whether a light is linked to the object.
miBoolean mayabase_lightlink_check(miState* state, ...);
/// Whether texture coordinates are given.
miBoolean mayabase_texcoords_check(miState* state, ...);
/// Connection of a parameter.
miBoolean mayabase_parm_connection(miState* state, ...);

#ifdef __cplusplus
}
#endif

#endif
