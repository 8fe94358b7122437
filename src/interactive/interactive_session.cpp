// SPDX-License-Identifier: Apache-2.0
#include "interactive/interactive_session.h"

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
  std::deque<Task> tasks;
  bool ending = false, paused = false;
  std::shared_ptr<const Picture> picture;
  std::thread thread;
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
  queue_->thread = std::thread([this] { run(); });
}

InteractiveSession::~InteractiveSession() {
  {
    const std::scoped_lock lock(queue_->mutex);
    queue_->ending = true;
    interrupt_ = true;
  }
  queue_->wake.notify_all();
  queue_->thread.join();
}

void InteractiveSession::post(Task task) {
  {
    const std::scoped_lock lock(queue_->mutex);
    queue_->tasks.push_back(std::move(task));
    interrupt_ = true;
  }
  queue_->wake.notify_all();
}

void InteractiveSession::set_paused(bool paused) {
  {
    const std::scoped_lock lock(queue_->mutex);
    queue_->paused = paused;
    if (paused) interrupt_ = true;
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
      if (!queue_->tasks.empty()) {
        task = std::move(queue_->tasks.front());
        queue_->tasks.pop_front();
      }
      interrupt_ = !queue_->tasks.empty();
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
