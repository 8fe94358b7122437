// SPDX-License-Identifier: Apache-2.0
// Any bytes as a buffer view of meshoptimizer: mode, filter, size of an element and count from the
// first four bytes, then the compressed data.
#include <string_view>

#include "fuzzers.h"
#include "models/gltf/document.h"
#include "models/gltf/meshopt.h"

int oriel::fuzz::fuzz_meshopt(const std::uint8_t* data, std::size_t size) {
  using namespace oriel::models::gltf;
  if (size < 4) return 0;
  constexpr const char* kModes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
  constexpr const char* kFilters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
  const json packed = {{"mode", kModes[data[0] % 3]},
                       {"filter", kFilters[data[1] % 4]},
                       {"byteStride", data[2]},
                       {"count", data[3]}};
  try {
    unpacked(meshopt_stream(packed, "view"),
             std::string_view(reinterpret_cast<const char*>(data) + 4, size - 4), "view");
  } catch (const Unreadable&) {  // a message is what is asked for
  }
  return 0;
}
