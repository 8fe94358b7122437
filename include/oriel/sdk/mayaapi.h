// SPDX-License-Identifier: Apache-2.0
// What shaders written for Maya ask; here there is no Maya behind it.
#ifndef ORIEL_SDK_MAYAAPI_H
#define ORIEL_SDK_MAYAAPI_H

// Conventions
//   Every function answers miFALSE: shaders then take their own defaults.

#include "shader.h"

#ifdef __cplusplus
extern "C" {
#endif

/// State items; only the end of the list is known here.
typedef enum MbStateItem { MBSI_NULL = 0 } MbStateItem;

/// Items and addresses for their values in turn, MBSI_NULL at the end; none is there.
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
