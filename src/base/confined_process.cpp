// SPDX-License-Identifier: Apache-2.0
#include "base/confined_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "base/packet.h"

namespace oriel {
namespace {

constexpr int kSocket = 3, kMemory = 4;  // descriptors of the child process

/// Variables that a process needs to find its libraries, and those of sanitizers. Others may be
/// secrets of the user.
bool is_inherited(std::string_view variable) {
  for (const std::string_view start : {"LD_LIBRARY_PATH=", "ORIEL_MODULE_PATH=", "OCIO=", "TMPDIR=",
                                       "ASAN_OPTIONS=", "UBSAN_OPTIONS=", "TSAN_OPTIONS="})
    if (variable.starts_with(start)) return true;
  return false;
}

std::vector<char*> inherited_environment() {
  std::vector<char*> variables;
  for (char** variable = environ; *variable; ++variable)
    if (is_inherited(*variable)) variables.push_back(*variable);
  variables.push_back(nullptr);
  return variables;
}

/// Whether the reports of a sanitizer are wanted.
bool is_sanitized() { return std::getenv("ASAN_OPTIONS") || std::getenv("TSAN_OPTIONS"); }

/// Milliseconds until a time, at least 0, rounded up: after a wait that long the time has come.
int milliseconds_until(std::chrono::steady_clock::time_point end) {
  const auto left =
      std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
  return static_cast<int>(std::max<std::int64_t>(left.count(), 0));
}

}  // namespace

ConfinedProcess::Mapping::~Mapping() {
  if (!bytes.empty()) munmap(const_cast<std::byte*>(bytes.data()), bytes.size());
}

ConfinedProcess::ConfinedProcess(const ConfinedOptions& options) {
  int sockets[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets) != 0)
    throw std::runtime_error("no reader process can be started");
  socket_ = Descriptor(sockets[0]);
  const Descriptor theirs(sockets[1]);  // closed here, so that the end of the process is noticed
  const Descriptor memory(memfd_create("oriel-shared", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (!memory || ftruncate(memory.get(), static_cast<off_t>(options.shared_bytes)) != 0 ||
      // A process that shrinks the memory would crash this one.
      fcntl(memory.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
    throw std::runtime_error("no reader process can be started: shared memory is missing");
  void* const shared = mmap(nullptr, options.shared_bytes, PROT_READ, MAP_SHARED, memory.get(), 0);
  if (shared == MAP_FAILED) throw std::runtime_error("no memory for a reader process");
  memory_.bytes = {static_cast<const std::byte*>(shared), options.shared_bytes};
  spawn(options, theirs.get(), memory.get());
}

void ConfinedProcess::spawn(const ConfinedOptions& options, int socket, int memory) {
  // The numbers may be those of the targets.
  const Descriptor high_socket(fcntl(socket, F_DUPFD_CLOEXEC, 64));
  const Descriptor high_memory(fcntl(memory, F_DUPFD_CLOEXEC, 64));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, high_socket.get(), kSocket);
  posix_spawn_file_actions_adddup2(&actions, high_memory.get(), kMemory);
  // Text of a process that was taken over does not reach the terminal.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (stream != STDERR_FILENO || !is_sanitized())
      posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, kMemory + 1);
  std::string words[] = {options.program, options.argument, std::to_string(options.memory_mb),
                         std::to_string(options.processor_seconds)};
  char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(), nullptr};
  std::vector<char*> environment = inherited_environment();
  pid_t process = 0;
  const int failed = posix_spawn(&process, options.program.c_str(), &actions, nullptr, arguments,
                                 environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0)
    throw std::runtime_error(
        fmt::format("no reader process can be started: {}", std::strerror(failed)));
  process_ = process;
}

bool ConfinedProcess::send(const void* bytes, std::size_t size, int descriptor) {
  if (is_running() && send_packet(socket_.get(), bytes, size, descriptor)) return true;
  end();
  return false;
}

std::size_t ConfinedProcess::receive(void* bytes, std::size_t capacity, double seconds) {
  using namespace std::chrono;
  const auto end_time =
      steady_clock::now() + duration_cast<steady_clock::duration>(duration<double>(seconds));
  pollfd ready{socket_.get(), POLLIN, 0};
  int count = -1;
  do count = poll(&ready, 1, milliseconds_until(end_time));
  while (count < 0 && errno == EINTR);
  if (count == 0) {
    end();
    throw ProcessEnded(fmt::format("took more than {} s", seconds));
  }
  if (const auto size = receive_packet(socket_.get(), bytes, capacity)) return *size;
  end();
  throw ProcessEnded("crashed");
}

void ConfinedProcess::end() {
  socket_ = Descriptor();
  if (process_ > 0) {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  process_ = 0;
}

ConfinedSide confined_side() {
  struct stat about {};
  if (fstat(kMemory, &about) != 0 || about.st_size <= 0)
    throw std::runtime_error("the shared memory is missing");
  const auto size = static_cast<std::size_t>(about.st_size);
  void* const shared = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, kMemory, 0);
  if (shared == MAP_FAILED) throw std::runtime_error("the shared memory is missing");
  return {kSocket, {static_cast<std::byte*>(shared), size}};
}

SandboxLimits confined_limits(char** arguments) {
  return {static_cast<std::size_t>(std::strtoull(arguments[0], nullptr, 10)) << 20,
          static_cast<std::size_t>(std::strtoull(arguments[1], nullptr, 10))};
}

}  // namespace oriel
