// SPDX-License-Identifier: Apache-2.0
// Any bytes as a compressed scene.
#include "file.h"
#include "fuzzers.h"
#include "mi/gzip.h"

int oriel::fuzz::fuzz_gzip(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  mi::SourceFault fault;
  mi::read_gzip(open_regular(file.path()), {.text = 1 << 24, .expansion = 100}, fault);
  return 0;
}
