// SPDX-License-Identifier: Apache-2.0
// Any bytes as a .gltf or .glb file, converted to the form that assimp reads. Buffers in other
// files are refused: the result depends on the bytes alone.
#include <string>

#include "fuzzers.h"
#include "models/gltf/plain.h"

int oriel::fuzz::fuzz_gltf(const std::uint8_t* data, std::size_t size) {
  models::gltf::PlainOptions options;
  options.files.set_untrusted(true);
  Diagnostics diagnostics;
  models::gltf::make_plain(std::string(reinterpret_cast<const char*>(data), size), ".", options,
                           diagnostics);
  return 0;
}
