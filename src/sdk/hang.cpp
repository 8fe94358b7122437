// SPDX-License-Identifier: Apache-2.0
#include "sdk/hang.h"

#include <algorithm>
#include <vector>

#include "sdk/crash.h"

namespace oriel::sdk {
namespace {

using Clock = std::chrono::steady_clock;

/// Intervals of checks: without a request, and while calls are overdue.
constexpr std::chrono::milliseconds kIdleInterval{100}, kBusyInterval{10};

struct WatchedThreads {
  std::mutex mutex;
  std::vector<ThreadCalls*> all;
};
WatchedThreads& watched_threads() {
  // never destroyed: threads may end after static destruction
  static auto* const threads = new WatchedThreads;
  return *threads;
}

struct SharedStopTime {
  std::mutex mutex;
  StopTime time;
};
SharedStopTime& shared_stop_time() {
  static SharedStopTime shared;
  return shared;
}

/// Marks and signals the thread if its call is overdue. Returns whether it is.
bool end_overdue_call(ThreadCalls& calls, Clock::time_point requested, bool by_user) {
  const Clock::time_point now = Clock::now();
  const std::uint64_t serial = calls.serial.load(std::memory_order_acquire);
  if (serial != calls.seen) {
    calls.seen = serial;
    calls.since = now;
    calls.force = false;
  }
  const CallKind kind = calls.kind.load(std::memory_order_relaxed);
  if (kind == CallKind::None) return false;
  const bool may_be_long = kind == CallKind::Picture || (kind == CallKind::Setup && !by_user);
  const auto grace = may_be_long ? HangWatch::kLongGrace : HangWatch::kHangGrace;
  const auto late = now - std::max(calls.since, requested) - grace;
  if (late < Clock::duration::zero()) return false;
  calls.force = late > HangWatch::kForceAfter;
  calls.overdue = serial;
  pthread_kill(calls.thread, kInterruptSignal);
  return true;
}

}  // namespace

void set_stop_time(StopTime time) {
  const std::lock_guard lock(shared_stop_time().mutex);
  shared_stop_time().time = time;
}

ThreadCalls::ThreadCalls() {
  WatchedThreads& threads = watched_threads();
  const std::lock_guard lock(threads.mutex);
  threads.all.push_back(this);
}

ThreadCalls::~ThreadCalls() {
  WatchedThreads& threads = watched_threads();
  const std::lock_guard lock(threads.mutex);
  std::erase(threads.all, this);
}

HangWatch::HangWatch(const std::atomic<bool>& stop) : stop_(stop), thread_([this] { run(); }) {}

HangWatch::~HangWatch() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void HangWatch::run() {
  StopTime requested;
  std::chrono::milliseconds interval = kIdleInterval;
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, interval, [this] { return ended_; })) {
    const bool by_user = stop_;
    bool by_time = false;
    {
      const std::lock_guard time_lock(shared_stop_time().mutex);
      const StopTime& limit = shared_stop_time().time;
      by_time = limit && Clock::now() > *limit;
    }
    if (!by_user && !by_time) requested.reset();
    interval = kIdleInterval;
    if (!by_user && !by_time) continue;
    if (!requested) requested = Clock::now();
    bool any = false;
    WatchedThreads& threads = watched_threads();
    const std::lock_guard threads_lock(threads.mutex);
    for (ThreadCalls* calls : threads.all) any |= end_overdue_call(*calls, *requested, by_user);
    if (any) interval = kBusyInterval;
  }
}

}  // namespace oriel::sdk
