// SPDX-License-Identifier: Apache-2.0
// Messages between the renderer and a reader process.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/sandbox.h"
#include "image/pixel_source.h"

namespace oriel::reader {

// Conventions
//   One packet each way per request (base/confined_process.h). Pixels are in the shared memory of
//   kArenaBytes. Requests for more are split.

inline constexpr std::size_t kArenaBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMaxPath = 8192, kMaxError = 512;

enum class Operation : std::int32_t {
  Ready,  ///< replies once the process is confined
  Open,   ///< path and descriptor of a file -> id
  Level,  ///< subimage, miplevel -> PixelLevel
  Rows,   ///< a, b: first and last row + 1 -> pixels
  Tile,   ///< a, b: corner -> pixels
  Close,
  Image,  ///< path and descriptor: decodes the first picture as floats -> PixelLevel
  Fetch   ///< a, b: rows of that picture -> pixels
};

struct Request {
  Operation operation = Operation::Ready;
  std::int32_t id = 0, subimage = 0, miplevel = 0, a = 0, b = 0;
  char path[kMaxPath] = {};
};

struct Reply {
  std::int32_t good = 0;
  std::int32_t id = 0;
  PixelLevel level;
  char error[kMaxError] = {};
};

/// Runs the reader process: confines itself and answers requests until the socket is closed.
/// Returns: the exit code.
int serve(const SandboxLimits& limits);

}  // namespace oriel::reader
