// SPDX-License-Identifier: Apache-2.0
#include "studio/jobs.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

extern char** environ;

namespace oriel::studio {
namespace {

using json = nlohmann::json;

std::vector<char*> arguments_of(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  return arguments;
}

/// Starts a program with its standard output in a pipe; 0 if that failed.
pid_t spawn_program(const std::vector<std::string>& words, int& output) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return 0;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // The terminal's interrupt is for the server, which ends its jobs itself.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t process = 0;
  std::vector<char*> arguments = arguments_of(words);
  if (posix_spawn(&process, arguments[0], &actions, &attributes, arguments.data(), environ) != 0)
    process = 0;
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (process == 0) close(ends[0]);
  output = ends[0];
  return process;
}

int exit_code(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

const char* name_of(RenderJob::State state) {
  constexpr const char* kNames[] = {"running", "paused", "done", "failed", "cancelled"};
  return kNames[static_cast<std::size_t>(state)];
}

int run_program(const std::vector<std::string>& words) {
  int output = -1;
  const pid_t process = spawn_program(words, output);
  if (process == 0) return -1;
  char bytes[4096];
  while (read(output, bytes, sizeof bytes) > 0) {
  }
  close(output);
  return exit_code(process);
}

RenderJob::RenderJob(std::vector<std::string> words, std::string checkpoint, std::string file,
                     Report report)
    : words_(std::move(words)),
      checkpoint_(std::move(checkpoint)),
      file_(std::move(file)),
      report_(std::move(report)),
      last_(std::make_unique<json>(json::object())) {
  start();
}

RenderJob::~RenderJob() {
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = State::Cancelled;
    if (process_ > 0) kill(process_, SIGKILL);
  }
  if (thread_.joinable()) thread_.join();
}

RenderJob::State RenderJob::state() const {
  const std::scoped_lock lock(mutex_);
  return state_;
}

void RenderJob::start() {
  if (thread_.joinable()) thread_.join();
  std::vector<std::string> words = words_;
  // The file need not exist: then the render starts from the beginning.
  words.insert(words.end(), {"--checkpoint", checkpoint_, "--resume", checkpoint_});
  int output = -1;
  const pid_t process = spawn_program(words, output);
  if (process == 0) return end(State::Failed);
  {
    const std::scoped_lock lock(mutex_);
    state_ = wanted_ = State::Running;
    process_ = process;
  }
  thread_ = std::thread([this, output, process] { watch(output, process); });
  report(json::object());
}

void RenderJob::watch(int output, pid_t process) {
  FILE* lines = fdopen(output, "r");
  char* line = nullptr;
  std::size_t size = 0;
  while (lines && getline(&line, &size, lines) >= 0) {
    const json facts = json::parse(line, nullptr, false);
    if (facts.is_object()) report(facts);
  }
  std::free(line);
  if (lines) std::fclose(lines);
  const int code = exit_code(process);
  State wanted = State::Running;
  {
    const std::scoped_lock lock(mutex_);
    process_ = 0;
    wanted = wanted_;
  }
  if (code == 0)
    end(State::Done);
  else
    end(wanted == State::Running ? State::Failed : wanted);
}

void RenderJob::end(State state) {
  {
    const std::scoped_lock lock(mutex_);
    state_ = state;
  }
  std::error_code error;
  if (state == State::Cancelled) std::filesystem::remove(checkpoint_, error);
  report(json::object());
}

void RenderJob::report(const json& facts) {
  json message = {{"type", "job"}};
  {
    const std::scoped_lock lock(mutex_);
    for (const char* name : {"done", "samples", "noise", "remaining", "message", "elapsed"})
      if (facts.contains(name)) (*last_)[name] = facts[name];
    if (state_ == State::Done) (*last_)["done"] = 1;
    message.update(*last_);
    message["state"] = name_of(state_);
  }
  message["files"] = {file_};
  report_(message);
}

void RenderJob::pause() {
  const std::scoped_lock lock(mutex_);
  if (process_ <= 0) return;
  wanted_ = State::Paused;
  kill(process_, SIGINT);
}

void RenderJob::cancel() {
  {
    const std::scoped_lock lock(mutex_);
    wanted_ = State::Cancelled;
    if (process_ > 0) {
      kill(process_, SIGTERM);
      return;
    }
    if (state_ != State::Paused) return;
  }
  end(State::Cancelled);
}

void RenderJob::resume() {
  if (state() == State::Paused) start();
}

}  // namespace oriel::studio
