// SPDX-License-Identifier: Apache-2.0
// What shaders written for Maya ask its translator for: there is none here.
#include "oriel/sdk/mayaapi.h"

extern "C" {

miBoolean mayabase_stateitem_get(miState*, ...) { return miFALSE; }
miBoolean mayabase_lightlink_get(miState*, ...) { return miFALSE; }
miBoolean mayabase_lightlink_check(miState*, ...) { return miFALSE; }
miBoolean mayabase_texcoords_check(miState*, ...) { return miFALSE; }
miBoolean mayabase_parm_connection(miState*, ...) { return miFALSE; }

}  // extern "C"
