// SPDX-License-Identifier: Apache-2.0
// A child process that works on untrusted files without access to anything else, and the packets
// and memory that it shares with its parent.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "base/descriptor.h"
#include "base/sandbox.h"

namespace oriel {

// Conventions
//   The parent sends the first packet. Large data is in shared memory, a memfd that can neither
//   grow nor shrink and that only the child writes. The parent checks all that the child says.

struct ConfinedOptions {
  /// The program; it calls enter_confinement() if its first argument is `argument`. The second and
  /// third argument are memory_mb and processor_seconds.
  std::string program = "/proc/self/exe";
  std::string argument;
  std::size_t memory_mb = 8192;          ///< of private data
  std::size_t processor_seconds = 3600;  ///< of the process in all
  std::size_t shared_bytes = 0;
};

/// The process ended, was not answering, or was ended by its limits.
struct ProcessEnded : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs a confined process and ends it.
///
/// Model:   the process inherits the two descriptors of the packets and the memory, and of the
///          environment only what finds libraries.
/// Checked: ConfinedProcess.*
class ConfinedProcess {
 public:
  /// Errors: std::runtime_error if the process cannot be started.
  explicit ConfinedProcess(const ConfinedOptions& options);
  ~ConfinedProcess() { end(); }
  ConfinedProcess(const ConfinedProcess&) = delete;
  ConfinedProcess& operator=(const ConfinedProcess&) = delete;

  /// Whether the packet was sent; otherwise the process has ended.
  bool send(const void* bytes, std::size_t size, int descriptor = -1);
  /// The size of the next packet.
  /// Errors:  ProcessEnded, also if there is no packet in this time or it is larger; the process is
  ///          ended then. The text follows "the process that reads it".
  std::size_t receive(void* bytes, std::size_t capacity, double seconds);
  /// Ends the process; the memory stays, and does not change any more.
  void end();
  bool is_running() const { return process_ > 0; }
  pid_t id() const { return process_; }

  std::span<const std::byte> memory() const { return memory_.bytes; }

 private:
  struct Mapping {
    std::span<const std::byte> bytes;
    ~Mapping();
  };
  void spawn(const ConfinedOptions& options, int socket, int memory);

  Mapping memory_;
  Descriptor socket_;
  pid_t process_ = 0;
};

/// In the child process: its end of the socket and the memory.
struct ConfinedSide {
  int socket = -1;
  std::span<std::byte> memory;
};
/// The descriptors that a confined process inherits.
/// Errors:  std::runtime_error without them.
ConfinedSide confined_side();

/// Limits from the arguments that ConfinedProcess passes.
SandboxLimits confined_limits(char** arguments);

}  // namespace oriel
