// SPDX-License-Identifier: Apache-2.0
#include "sdk/shader_turn.h"

#include <chrono>

#include "sdk/caller.h"

namespace oriel::sdk {
namespace {

constexpr std::chrono::milliseconds kTurnInterval{100};
/// After a stop; longer than HangWatch takes to end the function.
constexpr int kMaxTurnWaits = 80;

}  // namespace

bool ShaderTurn::enter(const std::atomic<bool>& stopped) {
  const std::uint64_t own = thread_generation();
  std::unique_lock lock(mutex_);
  for (int waits = 0; owner_ != 0 && owner_ != own;) {
    free_.wait_for(lock, kTurnInterval);
    if (stopped && ++waits > kMaxTurnWaits) return false;
  }
  owner_ = own;
  ++depth_;
  return true;
}

void ShaderTurn::leave() { restore(depth() - 1); }

int ShaderTurn::depth() const {
  const std::lock_guard lock(mutex_);
  return owner_ == thread_generation() ? depth_ : 0;
}

void ShaderTurn::restore(int depth) {
  {
    const std::lock_guard lock(mutex_);
    if (owner_ != thread_generation() || depth_ <= depth) return;
    depth_ = depth;
    if (depth_ > 0) return;
    owner_ = 0;
  }
  free_.notify_one();
}

}  // namespace oriel::sdk
