// SPDX-License-Identifier: Apache-2.0
// Crash handling for user libraries: a crash ends the call instead of the program and is reported.
#pragma once

#include <csetjmp>
#include <string>
#include <utility>

#include "sdk/caller.h"

namespace oriel::sdk {

struct UserSpec;

/// Reason why a call did not return.
enum class Left {
  Stopped,   ///< by the shader: mi_fatal, mi_abort
  Crashed,   ///< a signal
  Overflow,  ///< a signal: stack overflow
  Ended      ///< it called exit, _exit, _Exit or quick_exit
};

/// The running function of a library.
struct Running {
  const UserSpec* spec = nullptr;  ///< null: a function of the library itself
  /// suffix of the function name after that of the shader, or the name of a library function
  const char* suffix = "";
  const std::string* library = nullptr;  ///< file name
  Left left = Left::Stopped;             ///< the reason, if the function did not return
};

/// 'shader "NAME" crashed in NAME_init of LIBRARY'.
std::string describe(const Running& running);

/// Jump target of a crash in this thread.
struct CrashGuard {
  sigjmp_buf back;
  Running running;
  CrashGuard* outer = nullptr;

  static CrashGuard*& current();
};

/// Prepares the calling thread for crashes with an alternate signal stack. Fast if already done.
void ready_thread_for_crashes();

/// Unblocks crash signals in the calling thread after a signal handler was left by longjmp.
void unblock_crash_signals();

/// Calls f(). Returns false if the call was aborted; `running` then describes the function that
/// failed, which may be a nested one. Resources of f() are not released.
template <class F>
bool run_guarded(Running& running, F&& f) {
  ready_thread_for_crashes();
  CrashGuard own;
  own.running = running;
  own.outer = std::exchange(CrashGuard::current(), &own);
  const Caller caller = Caller::current();
  if (sigsetjmp(own.back, 0) != 0) {
    running = own.running;
    CrashGuard::current() = own.outer;
    Caller::current() = caller;
    unblock_crash_signals();
    return false;
  }
  f();
  CrashGuard::current() = own.outer;
  return true;
}

/// Ends the running library call of this thread, for shaders that terminate themselves (mi_fatal)
/// or wait for an event that will not occur. Returns if no library function is running.
void leave_stopped_shader();

/// Same for shaders that call exit.
void leave_ended_shader();

/// Installs the handlers of crash signals. A signal in a guarded function ends the call; other
/// signals reach the previous handlers of the program. Called again after each function that may
/// have installed handlers of its own.
void install_crash_handlers();

/// Registers the code of a user library, which must not end the program. Its calls of exit and
/// _exit end the running shader call instead, or the program with exit code 1 if none is running.
/// `address`: any address in the library.
void watch_library(const void* address, const std::string& file_name);
void unwatch_library(const std::string& file_name);

}  // namespace oriel::sdk
