// SPDX-License-Identifier: Apache-2.0
// Decodes image files in confined processes, so that a decoder that crashes, hangs or is taken over
// by a hostile file does no harm.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "image/pixel_buffer.h"
#include "image/pixel_source.h"

namespace oriel {

struct ReaderOptions {
  /// Program that calls reader::serve() when its first argument is kReaderArgument; the others
  /// are those of ConfinedOptions.
  std::string program = "/proc/self/exe";
  std::size_t memory_mb = 8192;  ///< of each process
  double seconds = 60;           ///< for each request; less after a process that ended
  int processes = 0;             ///< 0 = one per processor, at most 8
};

inline constexpr char kReaderArgument[] = "--read-files";

/// From now on all image files of this process are decoded by reader processes.
///
/// Model:   files are opened here, with the rights of this process; a reader process receives the
///          descriptor and has no other access (enter_sandbox). Each file belongs to one process,
///          which is started when it is first needed and again after it ended. All sizes in replies
///          are checked against the limits of textures. Without this call, files are decoded in
///          this process.
/// Errors:  std::runtime_error if a reader process cannot be started.
/// Checked: ReaderProcess.*
void isolate_readers(const ReaderOptions& options);
bool readers_are_isolated();

/// Opens a file in a reader process. Throws std::runtime_error with the reason only.
std::unique_ptr<PixelSource> open_isolated(const std::string& path);
/// read_image() in a reader process.
Image read_image_isolated(const std::string& path);

}  // namespace oriel
