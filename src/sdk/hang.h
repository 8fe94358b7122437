// SPDX-License-Identifier: Apache-2.0
// Interrupts functions of user libraries that do not return after the end of the render was
// requested.
#pragma once

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

#include "sdk/crash.h"

namespace oriel::sdk {

using StopTime = std::optional<std::chrono::steady_clock::time_point>;

/// Sets the time limit of the following render; nothing = no limit.
void set_stop_time(StopTime time);

/// The guarded calls of a thread. Written by that thread only, except `overdue`, `force` and the
/// data of the watch.
struct ThreadCalls {
  ThreadCalls();
  ~ThreadCalls();
  ThreadCalls(const ThreadCalls&) = delete;
  ThreadCalls& operator=(const ThreadCalls&) = delete;

  /// Called at the begin and end of every guarded call.
  void count(CallKind running) {
    kind.store(running, std::memory_order_relaxed);
    serial.store(serial.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }
  bool is_overdue() const {
    return overdue.load(std::memory_order_relaxed) == serial.load(std::memory_order_relaxed);
  }

  const pthread_t thread = pthread_self();
  std::atomic<std::uint64_t> serial = 1;
  std::atomic<std::uint64_t> overdue = 0;  ///< serial of a call to be ended; 0 = none
  std::atomic<CallKind> kind = CallKind::None;
  std::atomic<bool> force = false;  ///< ends it wherever it is, even in the C library

  // Read and written by the watch.
  std::uint64_t seen = 0;
  std::chrono::steady_clock::time_point since;
};

/// A thread that ends hanging calls.
///
/// Model:   after the stop flag is set or the time limit has passed, a call that has been running
///          for another kHangGrace is ended by a signal whose handler leaves the call like a crash.
///          At first only if the thread executes code of the library, which holds no lock of the
///          renderer or the C library; after kForceAfter in any case. Output shaders have
///          kLongGrace, under a time limit also functions of CallKind::Setup.
/// Checked: UserHangs.*
class HangWatch {
 public:
  static constexpr std::chrono::milliseconds kHangGrace{5000}, kForceAfter{1000}, kLongGrace{60000};

  /// Inputs:  stop: the flag that ends a render; outlives the watch.
  explicit HangWatch(const std::atomic<bool>& stop);
  ~HangWatch();
  HangWatch(const HangWatch&) = delete;
  HangWatch& operator=(const HangWatch&) = delete;

 private:
  void run();

  const std::atomic<bool>& stop_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace oriel::sdk
