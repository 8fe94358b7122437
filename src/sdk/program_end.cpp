// SPDX-License-Identifier: Apache-2.0
// Replaces exit, _exit, _Exit and quick_exit for user libraries: a shader or a signal handler of
// its library must not end the program without a picture.
//
// The program exports these functions, so libraries resolve them before those of the C library
// (calls inside the C library are not affected). Direct system calls are not intercepted.
#include <dlfcn.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "sdk/crash.h"

namespace oriel::sdk {

namespace {

/// Child processes forked by a shader may exit.
const pid_t program = getpid();

/// Libraries of users. Read in signal handlers, so without locks. A free entry has a null base.
struct Watched {
  std::atomic<const void*> base = nullptr;
  std::array<char, 128> name{};
};
constexpr std::size_t kMaxWatched = 256;
struct WatchedLibraries {
  std::mutex mutex;  ///< for writers
  std::array<Watched, kMaxWatched> all{};
};
WatchedLibraries& watched() {
  // never destroyed: libraries may run after static destruction
  static auto* const libraries = new WatchedLibraries;
  return *libraries;
}

/// Load address of the object that contains an address.
const void* base_of(const void* address) {
  Dl_info info;
  return dladdr(address, &info) != 0 ? info.dli_fbase : nullptr;
}

void print(const char* text) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

/// The exit code for the program; does not return while a shader is running.
int checked_exit_code(int code, const void* caller) {
  if (getpid() != program) return code;
  leave_ended_shader();
  const void* const base = base_of(caller);
  if (!base) return code;
  for (const Watched& library : watched().all) {
    if (library.base.load(std::memory_order_acquire) != base) continue;
    print("oriel: error: the shader library ");
    print(library.name.data());
    print(" ended the program [OR-SDK-005]\n");
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
  const void* const base = base_of(address);
  WatchedLibraries& libraries = watched();
  const std::lock_guard lock(libraries.mutex);
  for (Watched& free : libraries.all) {
    if (free.base.load(std::memory_order_relaxed) || !base) continue;
    free.name.fill(0);
    file_name.copy(free.name.data(), free.name.size() - 1);
    free.base.store(base, std::memory_order_release);
    return;
  }
}

void unwatch_library(const std::string& file_name) {
  WatchedLibraries& libraries = watched();
  const std::lock_guard lock(libraries.mutex);
  for (Watched& library : libraries.all)
    if (library.base.load(std::memory_order_relaxed) &&
        file_name.compare(0, library.name.size() - 1, library.name.data()) == 0) {
      library.base.store(nullptr, std::memory_order_release);
      return;
    }
}

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
