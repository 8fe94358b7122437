// SPDX-License-Identifier: Apache-2.0
// An interactive session: a render loop on its own thread, which takes work between passes.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "interactive/render_loop.h"

namespace oriel::interactive {

/// Callbacks of a session, from its threads; each should return at once.
struct SessionCallbacks {
  std::function<void()> picture;  ///< picture() has changed
  std::function<void()> status;   ///< status() has changed
};

/// What a task does, which decides when it runs while the caches of indirect light are computed.
enum class TaskKind : std::uint8_t {
  Changes,  ///< at once; the caches are computed again
  Reads,    ///< at once, on another thread; reads the scene and the world, not the film
  Waits,    ///< after the caches
};

/// Runs a render loop on a thread.
///
/// Model:   tasks run on that thread in the order of posting, between passes; a running pass is
///          interrupted and continues afterwards if no task changed anything. All tasks that wait
///          run before rendering continues, so that many quick edits cause one restart.
///          Caches of indirect light cannot be continued after an interruption, so while they are
///          computed only tasks that change something interrupt them, and those that only read may
///          run before others that were posted earlier.
/// Checked: InteractiveSessionTest.* in tests/interactive, StudioSessionTest.* in tests/studio
class InteractiveSession {
 public:
  using Task = std::function<void(RenderLoop&)>;

  InteractiveSession(SceneSource source, const LoopSettings& settings, SessionCallbacks callbacks);
  /// Waits for the running task.
  ~InteractiveSession();
  InteractiveSession(const InteractiveSession&) = delete;
  InteractiveSession& operator=(const InteractiveSession&) = delete;

  /// From any thread.
  void post(Task task, TaskKind kind = TaskKind::Changes);
  /// Rendering stops, after the caches if they are being computed.
  void set_paused(bool paused);
  /// See RenderLoop::set_pointer().
  void set_pointer(const std::optional<std::array<int, 2>>& pixel) { loop_.set_pointer(pixel); }
  /// The newest picture; null before the first.
  std::shared_ptr<const Picture> picture() const;
  LoopStatus status() const { return loop_.status(); }
  bool paused() const;
  /// For tasks that take long: true when they should end, because other tasks wait or the session
  /// ends.
  const std::atomic<bool>& interrupted() const { return task_interrupt_; }

 private:
  void run();
  void run_readers();
  void wait_for_readers();

  struct Queue;  ///< tasks and the thread that takes them
  std::unique_ptr<Queue> queue_;
  std::atomic<bool> interrupt_ = false;       ///< rendering should end
  std::atomic<bool> task_interrupt_ = false;  ///< the running task should end
  SessionCallbacks callbacks_;
  RenderLoop loop_;
};

}  // namespace oriel::interactive
