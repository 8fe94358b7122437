// SPDX-License-Identifier: Apache-2.0
// Any bytes as gather points and as photon maps.
#include <stdexcept>

#include "file.h"
#include "fuzzers.h"
#include "transport/gather/gather_map.h"
#include "transport/photon/photon_file.h"

int oriel::fuzz::fuzz_maps(const std::uint8_t* data, std::size_t size) {
  const oriel::fuzz::MemoryFile file(data, size);
  oriel::Diagnostics diagnostics;
  oriel::load_gather_map(file.path(), diagnostics);
  try {
    oriel::load_photon_maps(file.path());
  } catch (const std::runtime_error&) {  // a message is what is asked for
  }
  return 0;
}
