// SPDX-License-Identifier: Apache-2.0
// ORIEL_ASSERT: aborts on programming errors with file and line; compiled out in release builds.
#pragma once

#include <cstdio>
#include <cstdlib>

#if defined(ORIEL_ASSERTIONS)
#define ORIEL_ASSERT(condition)                                                                  \
  ((condition)                                                                                   \
       ? static_cast<void>(0)                                                                    \
       : (std::fprintf(stderr, "%s:%d: assertion failed: %s\n", __FILE__, __LINE__, #condition), \
          std::abort()))
#else
#define ORIEL_ASSERT(condition) static_cast<void>(0)
#endif
