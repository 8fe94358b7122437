// SPDX-License-Identifier: Apache-2.0
// Crashes of users' libraries: the call ends, not the program, and the function is named.
#pragma once

#include <csetjmp>
#include <string>
#include <utility>

#include "sdk/caller.h"

namespace oriel::sdk {

struct UserSpec;

/// Why a call did not return.
enum class Left {
  Stopped,   ///< by its own wish: mi_fatal, mi_abort
  Crashed,   ///< a signal
  Overflow,  ///< a signal: the stack was used up
  Ended      ///< it called exit, _exit, _Exit or quick_exit
};

/// The function of a library that is running.
struct Running {
  const UserSpec* spec = nullptr;        ///< null: a function of the whole library
  const char* suffix = "";               ///< of the function: behind the shader's name, or its name
  const std::string* library = nullptr;  ///< file name
  Left left = Left::Stopped;             ///< where it did not return
};

/// 'shader "NAME" crashed in NAME_init of LIBRARY'.
std::string describe(const Running& running);

/// Where a crash jumps to, in this thread.
struct CrashGuard {
  sigjmp_buf back;
  Running running;
  CrashGuard* outer = nullptr;

  static CrashGuard*& current();
};

/// Prepares the calling thread for crashes: signals are handled on a stack of their own. Quick
/// where the thread is ready.
void ready_thread_for_crashes();

/// Lets the calling thread receive signals of crashes again after the handler of one was left.
void unblock_crash_signals();

/// Calls f(). False: it was left early, and `running` is what left, which f() may have called. What
/// f() holds is not released.
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

/// Ends the call of a library's function that runs in this thread, for shaders that end themselves
/// (mi_fatal) or wait for what will not come. Returns where none is running.
void leave_stopped_shader();

/// The same for shaders that end the program.
void leave_ended_shader();

/// Installs the handlers of crash signals: those of functions that run guarded end the call, others
/// reach the handlers that the program had before. Called again after each function that may have
/// installed handlers of its own.
void install_crash_handlers();

/// Remembers code of a user's library, which may not end the program: its calls of exit and _exit
/// end the call of the shader instead, or the program with exit code 1 where none is running.
/// `address`: anything in the library.
void watch_library(const void* address, const std::string& file_name);
void unwatch_library(const std::string& file_name);

}  // namespace oriel::sdk
