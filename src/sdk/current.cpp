// SPDX-License-Identifier: Apache-2.0
#include "sdk/current.h"

#include <atomic>
#include <mutex>

#include "output/camera_output.h"

namespace oriel::sdk {
namespace {

thread_local Host* of_thread = nullptr;
std::atomic<Host*> of_process = nullptr;

struct Roots {
  std::mutex mutex;
  OutputRoots roots;
};
Roots& shared_roots() {
  static Roots roots;
  return roots;
}

}  // namespace

Host* current_host() { return of_thread ? of_thread : of_process.load(std::memory_order_relaxed); }

void set_current_host(Host* host) {
  if (of_thread == host) return;
  of_thread = host;
  of_process.store(host, std::memory_order_relaxed);
}

void forget_host(const Host* host) {
  if (of_thread == host) of_thread = nullptr;
  auto* expected = const_cast<Host*>(host);
  of_process.compare_exchange_strong(expected, nullptr);
}

void set_output_roots(const OutputRoots& roots) {
  const std::lock_guard lock(shared_roots().mutex);
  shared_roots().roots = roots;
}

OutputRoots output_roots() {
  const std::lock_guard lock(shared_roots().mutex);
  return shared_roots().roots;
}

}  // namespace oriel::sdk
