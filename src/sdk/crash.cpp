// SPDX-License-Identifier: Apache-2.0
#include "sdk/crash.h"

#include <fmt/format.h>

#include <array>
#include <csignal>
#include <mutex>

#include "sdk/user_spec.h"

namespace oriel::sdk {
namespace {

constexpr std::array kCrashSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

struct CrashHandlers {
  std::mutex mutex;
  bool known = false;
  std::array<struct sigaction, kCrashSignals.size()> own{};
};
CrashHandlers& crash_handlers() {
  static CrashHandlers handlers;
  return handlers;
}

}  // namespace

CrashGuard*& CrashGuard::current() {
  thread_local CrashGuard* guard = nullptr;
  return guard;
}

std::string describe(const Running& running, const char* did) {
  const std::string& library = *running.library;
  if (!running.spec)
    return fmt::format("the shader library {} {} in {}", library, did, running.suffix);
  const std::string& name = running.spec->own_name;
  return fmt::format("shader \"{}\" {} in {}{} of {}", name, did, name, running.suffix, library);
}

void leave_crashed_shader() {
  CrashGuard* const guard = CrashGuard::current();
  if (!guard) return;
  guard->running.crashed = true;
  siglongjmp(guard->back, 1);
}

void leave_stopped_shader() {
  if (CrashGuard* const guard = CrashGuard::current()) siglongjmp(guard->back, 1);
}

std::string running_shader() {
  const CrashGuard* const guard = CrashGuard::current();
  return guard ? describe(guard->running, "ended the program") : std::string();
}

void remember_crash_handlers() {
  CrashHandlers& handlers = crash_handlers();
  const std::lock_guard lock(handlers.mutex);
  for (std::size_t i = 0; i < kCrashSignals.size(); ++i)
    sigaction(kCrashSignals[i], nullptr, &handlers.own[i]);
  handlers.known = true;
}

void restore_crash_handlers() {
  CrashHandlers& handlers = crash_handlers();
  const std::lock_guard lock(handlers.mutex);
  if (!handlers.known) return;
  for (std::size_t i = 0; i < kCrashSignals.size(); ++i)
    sigaction(kCrashSignals[i], &handlers.own[i], nullptr);
}

}  // namespace oriel::sdk
