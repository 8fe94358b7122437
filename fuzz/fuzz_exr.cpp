// SPDX-License-Identifier: Apache-2.0
// Any bytes as an EXR file, read and processed as by denoise and recombine.
#include "file.h"
#include "fuzzers.h"
#include "image/exr.h"
#include "process_layers.h"

int oriel::fuzz::fuzz_exr(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  attempt([&] {
    process_layers(
        read_exr(file.path(), {.largest_side = 4096, .most_bytes = std::size_t{64} << 20}).layers);
  });
  return 0;
}
