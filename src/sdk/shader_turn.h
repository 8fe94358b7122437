// SPDX-License-Identifier: Apache-2.0
// Init and exit functions of shaders run one at a time.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace oriel::sdk {

/// The right of one thread to run init and exit functions; may be entered recursively, because they
/// may initialise other shaders.
///
/// Model:   not a lock: no mutex is held while a function of a library runs. If the function hangs,
///          waiting threads give up some time after the end of the render was requested; if it
///          crashes, the levels that it had entered are left.
/// Checked: UserHangs.InInitFunctionsAreEnded, ShaderTurn.*
class ShaderTurn {
 public:
  /// Returns false if the render was stopped and the other thread still has the turn.
  bool enter(const std::atomic<bool>& stopped);
  void leave();
  /// Levels that the calling thread has entered.
  int depth() const;
  /// Leaves all levels of the calling thread above `depth`, after a crash.
  void restore(int depth);

 private:
  mutable std::mutex mutex_;
  std::condition_variable free_;
  std::uint64_t owner_ = 0;  ///< thread_generation(); 0 = none
  int depth_ = 0;
};

/// Has the turn during its lifetime, if it was given.
class ShaderTurnScope {
 public:
  ShaderTurnScope(ShaderTurn& turn, const std::atomic<bool>& stopped)
      : turn_(turn), entered_(turn.enter(stopped)) {}
  ~ShaderTurnScope() {
    if (entered_) turn_.leave();
  }
  ShaderTurnScope(const ShaderTurnScope&) = delete;
  ShaderTurnScope& operator=(const ShaderTurnScope&) = delete;
  bool entered() const { return entered_; }

 private:
  ShaderTurn& turn_;
  const bool entered_;
};

}  // namespace oriel::sdk
