// SPDX-License-Identifier: Apache-2.0
// Programs for x86-64-v3 end with one sentence on older processors, in place of an illegal
// instruction. This file is compiled for any x86-64 and includes no C++ header: the linker could
// keep the copy of an inline function that another file compiled for the newer processors.
#if defined(ORIEL_CHECKS_PROCESSOR)
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#if defined(__AVX__)
#error "compile this file with -march=x86-64"
#endif

namespace {

/// Of an MPI job, whose messages come from many nodes.
void print_rank() {
  const char* rank = getenv("OMPI_COMM_WORLD_RANK");
  if (!rank) rank = getenv("PMIX_RANK");
  if (rank) fprintf(stderr, "rank %.20s on ", rank);
}

/// Before `main` and before the constructors of all static objects of the program.
[[gnu::constructor(101)]] void check_processor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
      __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma"))
    return;
  char host[256] = "this machine";
  gethostname(host, sizeof host - 1);
  fputs("oriel: ", stderr);
  print_rank();
  fprintf(stderr,
          "%s: the processor lacks AVX2, BMI2 or FMA, which this build requires (x86-64-v3); "
          "build Oriel from source with cmake -DORIEL_ARCH=native\n",
          host);
  _exit(1);
}

}  // namespace
#endif
