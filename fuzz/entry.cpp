// SPDX-License-Identifier: Apache-2.0
// The function that libFuzzer calls, for the fuzzer that ORIEL_FUZZER names.
#include "fuzzers.h"

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer looks for
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return oriel::fuzz::ORIEL_FUZZER(data, size);
}
