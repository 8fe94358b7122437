// SPDX-License-Identifier: Apache-2.0
// Functions of Maya's translator; only the state items of lights are supported.
#include "oriel/sdk/mayaapi.h"

#include <cstdarg>

#include "sdk/maya_items.h"

namespace oriel::sdk {

LightItems& light_items() {
  thread_local LightItems items;
  return items;
}

}  // namespace oriel::sdk

extern "C" {

miBoolean mayabase_stateitem_get(miState* state, ...) {
  oriel::sdk::LightItems& items = oriel::sdk::light_items();
  miBoolean known = miTRUE;
  std::va_list list;
  va_start(list, state);
  for (int item = va_arg(list, int); item != MBSI_NULL; item = va_arg(list, int)) {
    known = item == MBSI_LIGHTDIFFUSE || item == MBSI_LIGHTSPECULAR;
    if (!known) break;
    auto* pointer = va_arg(list, miBoolean**);
    if (pointer) *pointer = item == MBSI_LIGHTDIFFUSE ? &items.diffuse : &items.specular;
  }
  va_end(list);
  return known;
}
miBoolean mayabase_lightlink_get(miState*, ...) { return miFALSE; }
miBoolean mayabase_lightlink_check(miState*, ...) { return miFALSE; }
miBoolean mayabase_texcoords_check(miState*, ...) { return miFALSE; }
miBoolean mayabase_parm_connection(miState*, ...) { return miFALSE; }

}  // extern "C"
