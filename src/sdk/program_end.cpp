// SPDX-License-Identifier: Apache-2.0
// Replaces exit, _exit, _Exit and quick_exit for user libraries: a shader or a signal handler of
// its library must not end the program without a picture.
//
// The program exports these functions, so libraries resolve them before those of the C library
// (calls inside the C library are not affected). Direct system calls are not intercepted.
#include <dlfcn.h>
#include <link.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "sdk/crash.h"

namespace oriel::sdk {

namespace {

/// Child processes forked by a shader may exit.
const pid_t program = getpid();

/// Libraries of users. Read in signal handlers, so without locks. A free entry has a null begin.
struct Watched {
  std::atomic<std::uintptr_t> begin = 0, end = 0;
  std::array<char, 128> name{};
};
constexpr std::size_t kMaxWatched = 256;
struct WatchedLibraries {
  std::mutex mutex;  ///< for writers
  std::array<Watched, kMaxWatched> all{};
};
/// Constant initialisation, and never destroyed: libraries may run before and after.
constinit WatchedLibraries watched;

/// Addresses of a loaded object.
struct Extent {
  std::uintptr_t inside;  ///< any address in it
  std::uintptr_t begin = 0, end = 0;
};

/// Callback of dl_iterate_phdr: fills in the extent if this object contains the address.
int find_extent(dl_phdr_info* info, std::size_t, void* data) {
  auto& extent = *static_cast<Extent*>(data);
  std::uintptr_t begin = UINTPTR_MAX, end = 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type != PT_LOAD) continue;
    begin = std::min<std::uintptr_t>(begin, info->dlpi_addr + part.p_vaddr);
    end = std::max<std::uintptr_t>(end, info->dlpi_addr + part.p_vaddr + part.p_memsz);
  }
  if (extent.inside < begin || extent.inside >= end) return 0;
  extent.begin = begin;
  extent.end = end;
  return 1;
}

/// The registered library that contains the address; null if there is none.
const Watched* library_of(const void* address) {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (const Watched& library : watched.all)
    if (const std::uintptr_t begin = library.begin.load(std::memory_order_acquire))
      if (at >= begin && at < library.end.load(std::memory_order_relaxed)) return &library;
  return nullptr;
}

/// Prints the parts at once, because two threads may end the program at the same time.
void print(const char* begin, const char* middle, const char* end) {
  const std::array<iovec, 3> parts{{{const_cast<char*>(begin), std::strlen(begin)},
                                    {const_cast<char*>(middle), std::strlen(middle)},
                                    {const_cast<char*>(end), std::strlen(end)}}};
  [[maybe_unused]] const auto written = writev(STDERR_FILENO, parts.data(), parts.size());
}

/// The exit code for the program; does not return while a shader is running.
int checked_exit_code(int code, const void* caller) {
  if (getpid() != program) return code;
  leave_ended_shader();
  if (const Watched* const library = library_of(caller)) {
    print("oriel: error: the shader library ", library->name.data(),
          " ended the program [OR-SDK-005]\n");
    syscall(SYS_exit_group, 1);
  }
  return code;
}

template <class F>
[[noreturn]] void call_next(const char* name, int code) {
  if (const auto next = reinterpret_cast<F*>(dlsym(RTLD_NEXT, name))) next(code);
  for (;;) syscall(SYS_exit_group, code);
}

}  // namespace

void watch_library(const void* address, const std::string& file_name) {
  Extent extent{reinterpret_cast<std::uintptr_t>(address)};
  if (dl_iterate_phdr(find_extent, &extent) == 0) return;
  const std::lock_guard lock(watched.mutex);
  for (Watched& free : watched.all) {
    if (free.begin.load(std::memory_order_relaxed)) continue;
    free.name.fill(0);
    file_name.copy(free.name.data(), free.name.size() - 1);
    free.end.store(extent.end, std::memory_order_relaxed);
    free.begin.store(extent.begin, std::memory_order_release);
    return;
  }
}

void unwatch_library(const std::string& file_name) {
  const std::lock_guard lock(watched.mutex);
  for (Watched& library : watched.all)
    if (library.begin.load(std::memory_order_relaxed) &&
        file_name.compare(0, library.name.size() - 1, library.name.data()) == 0) {
      library.begin.store(0, std::memory_order_release);
      return;
    }
}

bool is_library_code(const void* address) { return library_of(address) != nullptr; }

}  // namespace oriel::sdk

// NOLINTBEGIN(bugprone-reserved-identifier): the C library's names
extern "C" {

__attribute__((noreturn)) void exit(int code) noexcept {
  code = oriel::sdk::checked_exit_code(code, __builtin_return_address(0));
  oriel::sdk::call_next<void(int)>("exit", code);
}

__attribute__((noreturn)) void quick_exit(int code) noexcept {
  code = oriel::sdk::checked_exit_code(code, __builtin_return_address(0));
  oriel::sdk::call_next<void(int)>("quick_exit", code);
}

__attribute__((noreturn)) void _exit(int code) {
  code = oriel::sdk::checked_exit_code(code, __builtin_return_address(0));
  for (;;) syscall(SYS_exit_group, code);
}

__attribute__((noreturn)) void _Exit(int code) noexcept {
  code = oriel::sdk::checked_exit_code(code, __builtin_return_address(0));
  for (;;) syscall(SYS_exit_group, code);
}

}  // extern "C"
// NOLINTEND(bugprone-reserved-identifier)
