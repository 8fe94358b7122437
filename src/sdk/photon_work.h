// SPDX-License-Identifier: Apache-2.0
// The photon that a users' shader has in its hands.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel::sdk {

struct PhotonWork {
  PhotonNext* next = nullptr;          ///< photon shaders
  PhotonEmission* emission = nullptr;  ///< emitters
  bool caustic = false;                ///< the pass makes caustics alone
};

}  // namespace oriel::sdk
