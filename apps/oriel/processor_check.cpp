// SPDX-License-Identifier: Apache-2.0
// Programs for x86-64-v3 end with one sentence on older processors, in place of an illegal
// instruction. This file is compiled for any x86-64 and includes no C++ header: the linker could
// keep the copy of an inline function that another file compiled for the newer processors.
#if defined(ORIEL_CHECKS_PROCESSOR)
#include <unistd.h>

#if defined(__AVX__)
#error "compile this file with -march=x86-64"
#endif

namespace {

constexpr char kMessage[] =
    "oriel: this processor lacks AVX2, BMI2 or FMA, which this build requires (x86-64-v3); build "
    "Oriel from source with cmake -DORIEL_ARCH=native\n";

/// Before `main` and before the constructors of all static objects of the program.
[[gnu::constructor(101)]] void check_processor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
      __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma"))
    return;
  if (write(STDERR_FILENO, kMessage, sizeof kMessage - 1) < 0) _exit(2);
  _exit(1);
}

}  // namespace
#endif
