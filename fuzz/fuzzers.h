// SPDX-License-Identifier: Apache-2.0
// The fuzzers by name. libFuzzer calls one of them (entry.cpp), the replay of the corpora all.
#pragma once

#include <cstddef>
#include <cstdint>

// X(NAME) for each fuzzer: fuzz_NAME.cpp defines fuzz_NAME, corpus/NAME contains its inputs.
// clang-format off
#define ORIEL_FUZZERS(X)                                                    \
  X(checkpoint) X(command) X(exr) X(gltf) X(gzip) X(include) X(layers)      \
  X(maps) X(meshopt) X(mi) X(model) X(output) X(prepare) X(profile) X(studio)   \
  X(tags)
// clang-format on

namespace oriel::fuzz {

// Reads the bytes as an input of Oriel; aborts if a property that must hold does not. Returns 0.
#define ORIEL_DECLARE(name) int fuzz_##name(const std::uint8_t* data, std::size_t size);
ORIEL_FUZZERS(ORIEL_DECLARE)
#undef ORIEL_DECLARE

}  // namespace oriel::fuzz
