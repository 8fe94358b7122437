// SPDX-License-Identifier: Apache-2.0
// Locks of shaders.
#include <chrono>
#include <memory>
#include <mutex>

#include "oriel/sdk/shader/system.h"
#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/host.h"

namespace {

using Mutex = std::timed_mutex;

/// Interval of checks for an abort: a crashed shader does not release its locks.
constexpr std::chrono::milliseconds kPatience{100};

/// The mutex of an invalid lock handle; shared by all of them.
Mutex& mutex_of(miLock lock) {
  static Mutex shared;
  return lock.p ? *static_cast<Mutex*>(lock.p) : shared;
}

bool stopped() {
  const oriel::sdk::Host* host = oriel::sdk::current_host();
  return host && host->stopped;
}

}  // namespace

void mi_init_lock(miLock* lock) { lock->p = std::make_unique<Mutex>().release(); }

void mi_delete_lock(miLock* lock) {
  const std::unique_ptr<Mutex> gone(static_cast<Mutex*>(lock->p));
  lock->p = nullptr;
}

void mi_lock(miLock lock) {
  Mutex& mutex = mutex_of(lock);
  while (!mutex.try_lock_for(kPatience))
    if (stopped()) oriel::sdk::leave_stopped_shader();
}

void mi_unlock(miLock lock) { mutex_of(lock).unlock(); }

miBoolean mi_trylock(miLock lock) { return mutex_of(lock).try_lock() ? miTRUE : miFALSE; }
