// SPDX-License-Identifier: Apache-2.0
// Crashes of users' libraries: the call ends, not the program, and the function is named.
#pragma once

#include <csetjmp>
#include <string>
#include <utility>

#include "sdk/caller.h"

namespace oriel::sdk {

struct UserSpec;

/// The function of a library that is running.
struct Running {
  const UserSpec* spec = nullptr;        ///< null: a function of the whole library
  const char* suffix = "";               ///< of the function: behind the shader's name, or its name
  const std::string* library = nullptr;  ///< file name
  bool crashed = false;                  ///< it was left by a signal, not by its own wish
};

/// 'shader "NAME" DID in NAME_init of LIBRARY'.
std::string describe(const Running& running, const char* did);

/// Where a crash jumps to, in this thread.
struct CrashGuard {
  sigjmp_buf back;
  Running running;
  CrashGuard* outer = nullptr;

  static CrashGuard*& current();
};

/// Calls f(). False: it was left early, and `running` is what left, which f() may have called. What
/// f() holds is not released.
template <class F>
bool run_guarded(Running& running, F&& f) {
  CrashGuard own;
  own.running = running;
  own.outer = std::exchange(CrashGuard::current(), &own);
  const Caller caller = Caller::current();
  if (sigsetjmp(own.back, 0) != 0) {
    running = own.running;
    CrashGuard::current() = own.outer;
    Caller::current() = caller;
    return false;
  }
  f();
  CrashGuard::current() = own.outer;
  return true;
}

/// Handles a signal of a crash: does not return where a function of a library was running in this
/// thread. To be called from the program's signal handler.
void leave_crashed_shader();

/// The same for shaders that end themselves (mi_fatal), or wait for what will not come.
void leave_stopped_shader();

/// What of a library runs in this thread; empty when nothing does. For programs that are ended.
std::string running_shader();

/// The program's handlers of crash signals, which libraries may have replaced by their own.
void remember_crash_handlers();
void restore_crash_handlers();

}  // namespace oriel::sdk
