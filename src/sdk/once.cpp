// SPDX-License-Identifier: Apache-2.0
#include "sdk/once.h"

#include "oriel/sdk/shader/system.h"
#include "sdk/current.h"
#include "sdk/host.h"

namespace oriel::sdk {

void warn_no_effect(const char* function, const char* text) {
  Host* host = current_host();
  if (!host || host->is_first(function)) mi_warning("%s: %s", function, text);
}

void warn_once(const char* code, const std::string& text) {
  if (Host* host = current_host()) host->warn_once(code, text);
}

}  // namespace oriel::sdk
