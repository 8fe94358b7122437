// SPDX-License-Identifier: Apache-2.0
// Crash handling for user libraries: a crash ends the call instead of the program and is reported.
#pragma once

#include <cxxabi.h>

#include <csetjmp>
#include <csignal>
#include <cstdint>
#include <exception>
#include <string>

#include "sdk/caller.h"

namespace oriel::sdk {

struct UserSpec;

/// Reason why a call did not return.
enum class Left {
  Stopped,   ///< by the shader: mi_fatal, mi_abort
  Crashed,   ///< a signal
  Overflow,  ///< a signal: stack overflow
  Threw,     ///< an exception
  Hung,      ///< HangWatch
  Ended      ///< it called exit, _exit, _Exit or quick_exit
};

/// A running function, by the time that it may take.
enum class CallKind : std::uint8_t {
  None,
  Sample,   ///< of one shader call in a sample
  Setup,    ///< init, exit, version and module functions, geometry shaders
  Picture,  ///< output shaders, which process the whole picture
};

/// The running function of a library.
struct Running {
  const UserSpec* spec = nullptr;  ///< null: a function of the library itself
  /// suffix of the function name after that of the shader, or the name of a library function
  const char* suffix = "";
  const std::string* library = nullptr;  ///< file name
  Left left = Left::Stopped;             ///< the reason, if the function did not return
  CallKind kind = CallKind::Setup;
  const char* what = "";  ///< of an exception; valid until the next exception in this thread
};

/// 'shader "NAME" crashed in NAME_init of LIBRARY'.
std::string describe(const Running& running);

/// Jump target of a crash in this thread.
struct CrashGuard {
  sigjmp_buf back;
  Running running;
  CrashGuard* outer = nullptr;

  /// Fast, and without allocation in signal handlers.
  static CrashGuard*& current();
  void enter();
  void leave() const;
};

/// Prepares the calling thread for crashes with an alternate signal stack. Fast if already done.
void ready_thread_for_crashes();

/// Unblocks crash signals in the calling thread after a signal handler was left by longjmp.
void unblock_crash_signals();

/// Keeps the text for Running::what.
const char* keep_exception_text(const char* text);

/// Calls f(). Returns false if the call was aborted; `running` then describes the function that
/// failed, which may be a nested one. Resources of f() are not released, except after an exception.
template <class F>
bool run_guarded(Running& running, F&& f) {
  ready_thread_for_crashes();
  CrashGuard own;
  own.running = running;
  const Caller caller = Caller::current();
  if (sigsetjmp(own.back, 0) == 0) {
    own.enter();
    try {
      f();
      own.leave();
      return true;
    } catch (const abi::__forced_unwind&) {  // the end of the thread
      own.leave();
      throw;
    } catch (const std::exception& e) {
      own.running.left = Left::Threw;
      own.running.what = keep_exception_text(e.what());
    } catch (...) {
      own.running.left = Left::Threw;
      own.running.what = "";
    }
  }
  own.leave();
  running = own.running;
  Caller::current() = caller;
  unblock_crash_signals();
  return false;
}

/// Signal that HangWatch sends to threads with an overdue call. Ignored by default, so that a
/// library that resets it does no harm.
inline constexpr int kInterruptSignal = SIGURG;

/// Ends the running library call of this thread if HangWatch considers it overdue; for functions
/// that shaders may call in an endless loop.
void leave_overdue_shader();

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
/// Whether the address is in a registered library. For signal handlers: no locks, no allocation.
bool is_library_code(const void* address);

}  // namespace oriel::sdk
