// SPDX-License-Identifier: Apache-2.0
#include "oriel/sdk/shader/connection.h"

#include "sdk/current.h"
#include "sdk/host.h"

extern "C" miBoolean oriel_is_shader_tag(miTag tag) {
  const oriel::sdk::Host* host = oriel::sdk::current_host();
  return host && host->type_of(tag) == miSCENE_FUNCTION ? miTRUE : miFALSE;
}
