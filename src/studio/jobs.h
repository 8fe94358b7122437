// SPDX-License-Identifier: Apache-2.0
// Final renders as child processes.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <thread>
#include <vector>

namespace oriel::studio {

/// Runs a program and returns its exit code; -1 if it could not be started.
int run_program(const std::vector<std::string>& words);

/// `oriel render` as a child process.
///
/// Model:   pausing ends the process with its checkpoint, so that a pause also survives the end of
///          the server; resuming starts it with the same checkpoint.
class RenderJob {
 public:
  enum class State : std::uint8_t { Running, Paused, Done, Failed, Cancelled };
  /// Called from a thread of the job with the fields of a `job` message.
  using Report = std::function<void(const nlohmann::json&)>;

  /// Inputs:  words: the command line; checkpoint: file that the job writes and removes.
  RenderJob(std::vector<std::string> words, std::string checkpoint, std::string file,
            Report report);
  ~RenderJob();
  RenderJob(const RenderJob&) = delete;
  RenderJob& operator=(const RenderJob&) = delete;

  void pause();
  void resume();
  void cancel();
  State state() const;

 private:
  void start();
  void watch(int output, pid_t process);
  void report(const nlohmann::json& facts);
  void end(State state);

  std::vector<std::string> words_;
  std::string checkpoint_, file_;
  Report report_;
  mutable std::mutex mutex_;
  State state_ = State::Running, wanted_ = State::Running;
  pid_t process_ = 0;
  std::unique_ptr<nlohmann::json> last_;  ///< fields of the last message
  std::thread thread_;
};

/// The name of a state in messages.
const char* name_of(RenderJob::State state);

}  // namespace oriel::studio
