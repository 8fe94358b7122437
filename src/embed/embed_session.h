// SPDX-License-Identifier: Apache-2.0
// The session behind the C interface.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>

#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "oriel/oriel.h"

namespace oriel::interactive {
class InteractiveSession;
class RenderLoop;
struct Picture;
enum class TaskKind : std::uint8_t;
}  // namespace oriel::interactive

namespace oriel::embed {

/// An interactive session and what waits for it.
///
/// Model:   requests run as tasks of the session's thread; the calling thread waits for their
///          result.
/// Checked: Embed.* in tests/embed
class EmbedSession {
 public:
  /// Errors:  EmbedError.
  EmbedSession(const std::string& path, const OrielSettings& settings);

  ~EmbedSession();
  EmbedSession(const EmbedSession&) = delete;
  EmbedSession& operator=(const EmbedSession&) = delete;

  /// Runs `task(RenderLoop&)` on the session's thread and returns its result or exception.
  template <class F>
  auto run(interactive::TaskKind kind, F task) {
    using Result = std::invoke_result_t<F, interactive::RenderLoop&>;
    if constexpr (std::is_void_v<Result>) {
      run_task(task, kind);
    } else {
      std::optional<Result> result;
      run_task([&](interactive::RenderLoop& loop) { result = task(loop); }, kind);
      return *std::move(result);
    }
  }
  void set_stopped(bool stopped);
  OrielStatus status() const;
  std::shared_ptr<const interactive::Picture> picture() const;
  /// See oriel_session_wait.
  void wait(std::uint32_t epoch, std::uint32_t samples, double seconds);

 private:
  void run_task(const std::function<void(interactive::RenderLoop&)>& task,
                interactive::TaskKind kind);
  void notify();
  /// Whether waiting ends. Errors: EmbedError if the scene cannot be rendered.
  bool is_reached(std::uint32_t epoch, std::uint32_t samples) const;

  std::optional<ThreadLimit> threads_;
  std::optional<TemporaryFolder> folder_;
  void (*changed_)(void*) = nullptr;
  void* user_ = nullptr;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::uint64_t changes_ = 0;
  std::unique_ptr<interactive::InteractiveSession> session_;  // last: its thread uses the others
};

}  // namespace oriel::embed
