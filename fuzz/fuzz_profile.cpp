// SPDX-License-Identifier: Apache-2.0
// Any bytes as a light profile of either format.
#include <stdexcept>

#include "file.h"
#include "fuzzers.h"
#include "photometry/profile_file.h"

int oriel::fuzz::fuzz_profile(const std::uint8_t* data, std::size_t size) {
  const oriel::fuzz::MemoryFile file(data, size);
  try {
    oriel::photometry::read_profile(file.path());
  } catch (const std::runtime_error&) {  // a message is what is asked for
  }
  return 0;
}
