// SPDX-License-Identifier: Apache-2.0
// What shaders written for Maya ask of its translator.
#ifndef ORIEL_SDK_MAYAAPI_H
#define ORIEL_SDK_MAYAAPI_H

// Conventions
//   Only mayabase_stateitem_get has answers. All other functions return miFALSE, and shaders then
//   use their own defaults.

#include "shader.h"

#ifdef __cplusplus
extern "C" {
#endif

/// State items, each a miBoolean of the thread. The light items are set to miTRUE before a light
/// shader runs, which may change them; after a light sample they tell whether that light lights
/// diffusely and makes highlights.
typedef enum MbStateItem {
  MBSI_NULL = 0,  ///< ends the list
  MBSI_LIGHTDIFFUSE,
  MBSI_LIGHTSPECULAR
} MbStateItem;

/// Items and addresses of pointers in turn, MBSI_NULL at the end: each pointer is set to its item.
/// miFALSE, and the pointers from there on as they were, at an item that is not known.
miBoolean mayabase_stateitem_get(miState* state, ...);
/// Lights linked to the object; none are known.
miBoolean mayabase_lightlink_get(miState* state, ...);
/// Whether a light is linked to the object.
miBoolean mayabase_lightlink_check(miState* state, ...);
/// Whether texture coordinates were given.
miBoolean mayabase_texcoords_check(miState* state, ...);
/// What a parameter is connected to.
miBoolean mayabase_parm_connection(miState* state, ...);

#ifdef __cplusplus
}
#endif

#endif
