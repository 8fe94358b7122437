// SPDX-License-Identifier: Apache-2.0
// Messages between the renderer and a reader process.
#pragma once

#include <sys/socket.h>
#include <cstddef>
#include <cstdint>
#include <string>

#include "image/pixel_source.h"

namespace oriel::reader {

// Conventions
//   One packet each way per request over a SOCK_SEQPACKET socket. Pixels are in shared memory, a
//   memfd of kArenaBytes that can neither grow nor shrink. Requests for more are split.

inline constexpr std::size_t kArenaBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMaxPath = 8192, kMaxError = 512;
inline constexpr int kSocket = 3, kArena = 4;  ///< descriptors of the reader process

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

/// Sends a packet, with a descriptor unless it is negative. False on errors.
bool send_packet(int socket, const void* bytes, std::size_t size, int descriptor = -1);
/// Receives a packet of exactly `size` bytes, and a descriptor or -1. False on errors and at the
/// end.
bool receive_packet(int socket, void* bytes, std::size_t size, int* descriptor = nullptr);

/// Runs the reader process: confines itself and answers requests until the socket is closed.
/// Inputs:  memory_mb: limit of its memory.
/// Returns: the exit code.
int serve(std::size_t memory_mb);

}  // namespace oriel::reader
