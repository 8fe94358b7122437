// SPDX-License-Identifier: Apache-2.0
#include "interactive/interactive_session.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "base/parallel.h"

namespace oriel::interactive {

struct InteractiveSession::Queue {
  std::mutex mutex;
  std::condition_variable wake;
  struct Item {
    Task task;
    TaskKind kind;
  };
  std::deque<Item> tasks;
  bool ending = false, paused = false;
  bool reading = false;  ///< the thread of readers runs a task
  std::shared_ptr<const Picture> picture;
  std::thread thread, readers;

  Task take(std::deque<Item>::iterator item) {
    Task task = std::move(item->task);
    tasks.erase(item);
    return task;
  }
  /// The first task that reads, before any that changes something; else the end.
  std::deque<Item>::iterator next_read() {
    const auto first = std::find_if(tasks.begin(), tasks.end(),
                                    [](const Item& item) { return item.kind != TaskKind::Waits; });
    return first != tasks.end() && first->kind == TaskKind::Reads ? first : tasks.end();
  }
};

InteractiveSession::InteractiveSession(SceneSource source, const LoopSettings& settings,
                                       SessionCallbacks callbacks)
    : queue_(std::make_unique<Queue>()),
      callbacks_(std::move(callbacks)),
      loop_(
          std::move(source), settings,
          [this](std::shared_ptr<const Picture> picture) {
            {
              const std::scoped_lock lock(queue_->mutex);
              queue_->picture = std::move(picture);
            }
            if (callbacks_.picture) callbacks_.picture();
          },
          [this] {
            if (callbacks_.status) callbacks_.status();
          }) {
  loop_.on_caches_end([this] { wait_for_readers(); });
  queue_->thread = std::thread([this] { run(); });
  queue_->readers = std::thread([this] { run_readers(); });
}

InteractiveSession::~InteractiveSession() {
  {
    const std::scoped_lock lock(queue_->mutex);
    queue_->ending = true;
    interrupt_ = task_interrupt_ = true;
  }
  queue_->wake.notify_all();
  queue_->thread.join();
  queue_->readers.join();
}

void InteractiveSession::post(Task task, TaskKind kind) {
  {
    const std::scoped_lock lock(queue_->mutex);
    queue_->tasks.push_back({std::move(task), kind});
    task_interrupt_ = true;
    if (kind == TaskKind::Changes || !loop_.computes_caches()) interrupt_ = true;
  }
  queue_->wake.notify_all();
}

void InteractiveSession::set_paused(bool paused) {
  {
    const std::scoped_lock lock(queue_->mutex);
    queue_->paused = paused;
    if (paused && !loop_.computes_caches()) interrupt_ = true;
  }
  queue_->wake.notify_all();
}

bool InteractiveSession::paused() const {
  const std::scoped_lock lock(queue_->mutex);
  return queue_->paused;
}

std::shared_ptr<const Picture> InteractiveSession::picture() const {
  const std::scoped_lock lock(queue_->mutex);
  return queue_->picture;
}

/// Before the film is drawn, and before anything changes. What was posted or paused meanwhile then
/// interrupts as usual.
void InteractiveSession::wait_for_readers() {
  std::unique_lock lock(queue_->mutex);
  queue_->wake.wait(lock, [&] { return !queue_->reading; });
  if (!queue_->tasks.empty() || queue_->paused || queue_->ending) interrupt_ = true;
}

void InteractiveSession::run_readers() {
  flush_denormals();
  std::unique_lock lock(queue_->mutex);
  for (;;) {
    queue_->wake.wait(lock, [&] {
      return queue_->ending ||
             (loop_.computes_caches() && queue_->next_read() != queue_->tasks.end());
    });
    if (queue_->ending) return;
    {
      const Task task = queue_->take(queue_->next_read());
      task_interrupt_ = !queue_->tasks.empty();
      queue_->reading = true;
      lock.unlock();
      task(loop_);
    }
    lock.lock();
    queue_->reading = false;
    queue_->wake.notify_all();
  }
}

void InteractiveSession::run() {
  flush_denormals();
  bool finished = false;
  for (;;) {
    Task task;
    {
      std::unique_lock lock(queue_->mutex);
      queue_->wake.wait(lock, [&] {
        return queue_->ending || !queue_->tasks.empty() || !(queue_->paused || finished);
      });
      if (queue_->ending) return;
      if (!queue_->tasks.empty()) task = queue_->take(queue_->tasks.begin());
      interrupt_ = task_interrupt_ = !queue_->tasks.empty();
    }
    if (task) {
      task(loop_);
      finished = false;
    } else {
      finished = loop_.run(interrupt_);
    }
  }
}

}  // namespace oriel::interactive
