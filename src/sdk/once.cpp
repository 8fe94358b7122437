// SPDX-License-Identifier: Apache-2.0
#include "sdk/once.h"

#include "oriel/sdk/shader/system.h"
#include "sdk/current.h"
#include "sdk/host.h"

namespace oriel::sdk {

void warn_once(const char* function, const char* text) {
  Host* host = current_host();
  if (!host || host->is_first(function)) mi_warning("%s: %s", function, text);
}

}  // namespace oriel::sdk
