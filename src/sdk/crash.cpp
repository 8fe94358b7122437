// SPDX-License-Identifier: Apache-2.0
#include "sdk/crash.h"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/mman.h>
#include <ucontext.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <mutex>

#include "sdk/hang.h"
#include "sdk/user_spec.h"

namespace oriel::sdk {
namespace {

constexpr std::array kCrashSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

struct CrashHandlers {
  std::mutex mutex;
  bool installed = false;
  std::array<struct sigaction, kCrashSignals.size()> before{};
};
/// Constant initialisation: a signal handler uses it.
constinit CrashHandlers crash_handlers;

// The storage of the initial-exec model exists from the start of a thread; the first access in a
// signal handler would otherwise allocate it.
[[gnu::tls_model("initial-exec")]] constinit thread_local CrashGuard* guard_of_thread = nullptr;
[[gnu::tls_model("initial-exec")]] constinit thread_local ThreadCalls* calls_of_thread = nullptr;

/// Alternate signal stack of a thread, for stack overflows.
class SignalStack {
 public:
  SignalStack() {
    stack_t present{};
    // Another component has already set one for this thread that is large enough.
    if (sigaltstack(nullptr, &present) == 0 && (present.ss_flags & SS_DISABLE) == 0 &&
        present.ss_size >= kMinSize)
      return;
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
  static constexpr std::size_t kSize = 128 << 10, kMinSize = 32 << 10;
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
  CrashGuard* const guard = guard_of_thread;
  if (!guard) return;
  guard->running.left = left;
  siglongjmp(guard->back, 1);
}

void on_crash(int number, siginfo_t* info, void* context) {
  leave(is_stack_overflow(*info, context) ? Left::Overflow : Left::Crashed);
  CrashHandlers& handlers = crash_handlers;
  for (std::size_t i = 0; i < kCrashSignals.size(); ++i)
    if (kCrashSignals[i] == number) sigaction(number, &handlers.before[i], nullptr);
  raise(number);
}

/// Leaves an overdue call. The signal may arrive after its end, in another call.
void on_interrupt(int, siginfo_t*, void* context) {
  const ThreadCalls* const calls = calls_of_thread;
  if (!calls || !calls->is_overdue()) return;
  const auto& machine = static_cast<const ucontext_t*>(context)->uc_mcontext;
  const auto* const at = reinterpret_cast<const void*>(machine.gregs[REG_RIP]);
  if (calls->force.load(std::memory_order_relaxed) || is_library_code(at)) leave(Left::Hung);
}

}  // namespace

CrashGuard*& CrashGuard::current() { return guard_of_thread; }

void CrashGuard::enter() {
  outer = guard_of_thread;
  if (calls_of_thread) calls_of_thread->count(running.kind);
  guard_of_thread = this;
}

void CrashGuard::leave() const {
  guard_of_thread = outer;
  if (calls_of_thread) calls_of_thread->count(outer ? outer->running.kind : CallKind::None);
}

std::string describe(const Running& running) {
  const char* did = "crashed";
  std::string why;
  switch (running.left) {
    case Left::Ended:
      did = "ended the program";
      break;
    case Left::Threw:
      did = "threw an exception";
      if (*running.what) why = fmt::format(" ({})", running.what);
      break;
    case Left::Hung:
      did = "did not return and was interrupted";
      break;
    case Left::Overflow:
      why = " (stack overflow)";
      break;
    default:
      break;
  }
  const std::string& library = *running.library;
  if (!running.spec)
    return fmt::format("the shader library {} {} in {}{}", library, did, running.suffix, why);
  const std::string& name = running.spec->own_name;
  return fmt::format("shader \"{}\" {} in {}{} of {}{}", name, did, name, running.suffix, library,
                     why);
}

const char* keep_exception_text(const char* text) {
  thread_local std::string kept;
  constexpr std::size_t kLongest = 400;
  kept.assign(text, strnlen(text, kLongest));
  return kept.c_str();
}

void ready_thread_for_crashes() {
  thread_local const SignalStack stack;
  thread_local ThreadCalls calls;
  calls_of_thread = &calls;
}

void unblock_crash_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : kCrashSignals) sigaddset(&signals, number);
  sigaddset(&signals, kInterruptSignal);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

void leave_overdue_shader() {
  if (calls_of_thread && calls_of_thread->is_overdue()) leave(Left::Hung);
}

void leave_stopped_shader() { leave(Left::Stopped); }

void leave_ended_shader() { leave(Left::Ended); }

void install_crash_handlers() {
  CrashHandlers& handlers = crash_handlers;
  const std::lock_guard lock(handlers.mutex);
  struct sigaction action = {};
  action.sa_sigaction = on_crash;
  // The handler jumps back into the program, so the signal must not stay blocked.
  action.sa_flags = SA_SIGINFO | SA_NODEFER | SA_ONSTACK;
  for (std::size_t i = 0; i < kCrashSignals.size(); ++i)
    sigaction(kCrashSignals[i], &action, handlers.installed ? nullptr : &handlers.before[i]);
  action.sa_sigaction = on_interrupt;
  action.sa_flags |= SA_RESTART;
  sigaction(kInterruptSignal, &action, nullptr);
  handlers.installed = true;
}

}  // namespace oriel::sdk
