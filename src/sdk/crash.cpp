// SPDX-License-Identifier: Apache-2.0
#include "sdk/crash.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/mman.h>
#include <ucontext.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <mutex>

#include "sdk/user_spec.h"

namespace oriel::sdk {
namespace {

constexpr std::array kCrashSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

struct CrashHandlers {
  std::mutex mutex;
  bool installed = false;
  std::array<struct sigaction, kCrashSignals.size()> before{};
};
CrashHandlers& crash_handlers() {
  static CrashHandlers handlers;
  return handlers;
}

/// Alternate signal stack of a thread, for stack overflows.
class SignalStack {
 public:
  SignalStack() {
    stack_t present{};
    // Another component has already set one for this thread.
    if (sigaltstack(nullptr, &present) == 0 && (present.ss_flags & SS_DISABLE) == 0) return;
    void* const room =
        mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) return;
    stack_t own{};
    own.ss_sp = room;
    own.ss_size = kSize;
    if (sigaltstack(&own, nullptr) == 0)
      room_ = room;
    else
      munmap(room, kSize);
  }
  ~SignalStack() {
    if (!room_) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
    munmap(room_, kSize);
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;

 private:
  /// Size in bytes: the saved registers take up to 11 KB, and signal handlers of libraries may
  /// print.
  static constexpr std::size_t kSize = 128 << 10;
  void* room_ = nullptr;
};

/// Whether the fault address is at the end of the stack.
bool is_stack_overflow(const siginfo_t& info, const void* context) {
  if (info.si_signo != SIGSEGV && info.si_signo != SIGBUS) return false;
  if (info.si_code <= 0) return false;  // sent by a process
  // A function may access its frame below the stack pointer, or above it if it has moved the
  // pointer.
  constexpr std::uintptr_t kFrame = 256 << 10;
  const auto& machine = static_cast<const ucontext_t*>(context)->uc_mcontext;
  const auto top = static_cast<std::uintptr_t>(machine.gregs[REG_RSP]);
  const auto fault = reinterpret_cast<std::uintptr_t>(info.si_addr);
  return fault + kFrame > top && fault < top + kFrame;
}

/// Leaves the guarded call; returns if no library function is running.
void leave(Left left) {
  CrashGuard* const guard = CrashGuard::current();
  if (!guard) return;
  guard->running.left = left;
  siglongjmp(guard->back, 1);
}

void on_crash(int number, siginfo_t* info, void* context) {
  leave(is_stack_overflow(*info, context) ? Left::Overflow : Left::Crashed);
  CrashHandlers& handlers = crash_handlers();
  for (std::size_t i = 0; i < kCrashSignals.size(); ++i)
    if (kCrashSignals[i] == number) sigaction(number, &handlers.before[i], nullptr);
  raise(number);
}

}  // namespace

CrashGuard*& CrashGuard::current() {
  thread_local CrashGuard* guard = nullptr;
  return guard;
}

std::string describe(const Running& running) {
  const char* const did = running.left == Left::Ended ? "ended the program" : "crashed";
  const char* const why = running.left == Left::Overflow ? " (stack overflow)" : "";
  const std::string& library = *running.library;
  if (!running.spec)
    return fmt::format("the shader library {} {} in {}{}", library, did, running.suffix, why);
  const std::string& name = running.spec->own_name;
  return fmt::format("shader \"{}\" {} in {}{} of {}{}", name, did, name, running.suffix, library,
                     why);
}

void ready_thread_for_crashes() { thread_local const SignalStack stack; }

void unblock_crash_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : kCrashSignals) sigaddset(&signals, number);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

void leave_stopped_shader() { leave(Left::Stopped); }

void leave_ended_shader() { leave(Left::Ended); }

void install_crash_handlers() {
  CrashHandlers& handlers = crash_handlers();
  const std::lock_guard lock(handlers.mutex);
  struct sigaction action = {};
  action.sa_sigaction = on_crash;
  // The handler jumps back into the program, so the signal must not stay blocked.
  action.sa_flags = SA_SIGINFO | SA_NODEFER | SA_ONSTACK;
  for (std::size_t i = 0; i < kCrashSignals.size(); ++i)
    sigaction(kCrashSignals[i], &action, handlers.installed ? nullptr : &handlers.before[i]);
  handlers.installed = true;
}

}  // namespace oriel::sdk
