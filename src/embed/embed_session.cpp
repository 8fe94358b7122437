// SPDX-License-Identifier: Apache-2.0
#include "embed/embed_session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

#include "embed/convert_model.h"
#include "embed/guard.h"
#include "interactive/interactive_session.h"
#include "shaders/registry.h"

namespace oriel::embed {
namespace {

interactive::SceneSource source_of(const std::string& path, const OrielSettings& settings) {
  interactive::SceneSource source;
  source.path = path;
  source.frame = settings.frame;
  source.registry = &builtin_shaders();
  source.read.packages = builtin_packages();
  source.read.knows_shader = [](std::string_view shader) {
    return builtin_shaders().find(shader) != nullptr;
  };
  if (settings.shader_folder_count > 0) required(settings.shader_folders, "shader_folders");
  for (std::size_t i = 0; i < settings.shader_folder_count; ++i)
    source.folders.emplace_back(&required(settings.shader_folders[i], "shader_folders"));
  return source;
}

}  // namespace

EmbedSession::EmbedSession(const std::string& path, const OrielSettings& settings)
    : changed_(settings.changed), user_(settings.user) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw EmbedError(ORIEL_NOT_FOUND, path + ": there is no such file");
  if (settings.threads < 0 || settings.frame < 1 || !(settings.clamp >= 0))
    throw EmbedError(ORIEL_BAD_ARGUMENT, "threads, frame or clamp is out of range");
  std::string scene = path;
  if (!is_scene(path)) {
    folder_.emplace();
    scene = folder_->file("scene.mi");
    convert_model(settings.program ? settings.program : "oriel", path, scene);
  }
  if (settings.threads > 0) threads_.emplace(settings.threads);
  interactive::LoopSettings loop;
  loop.seed = settings.seed;
  loop.clamp = settings.clamp;
  session_ = std::make_unique<interactive::InteractiveSession>(
      source_of(scene, settings), loop,
      interactive::SessionCallbacks{[this] { notify(); }, [this] { notify(); }});
  session_->set_paused(true);
  if (!run(interactive::TaskKind::Changes, [](interactive::RenderLoop& l) { return l.read(); }))
    throw EmbedError(ORIEL_FAILED, path + " could not be read as a scene");
}

EmbedSession::~EmbedSession() = default;

void EmbedSession::run_task(const std::function<void(interactive::RenderLoop&)>& task,
                            interactive::TaskKind kind) {
  std::packaged_task<void(interactive::RenderLoop&)> work(task);
  std::future<void> result = work.get_future();
  session_->post([&work](interactive::RenderLoop& loop) { work(loop); }, kind);
  result.get();
}

std::shared_ptr<const interactive::Picture> EmbedSession::picture() const {
  return session_->picture();
}

void EmbedSession::set_stopped(bool stopped) {
  session_->set_paused(stopped);
  notify();
}

void EmbedSession::notify() {
  {
    const std::scoped_lock lock(mutex_);
    ++changes_;
  }
  wake_.notify_all();
  if (changed_) changed_(user_);
}

OrielStatus EmbedSession::status() const {
  const interactive::LoopStatus now = session_->status();
  OrielStatus status{};
  status.state = static_cast<OrielState>(now.state);
  status.stopped = session_->paused();
  status.epoch = now.epoch;
  status.samples = now.progress.mean_samples;
  status.noise = now.progress.noise && std::isfinite(*now.progress.noise)
                     ? static_cast<double>(*now.progress.noise)
                     : -1;
  status.done = now.progress.done;
  status.elapsed = now.progress.elapsed;
  status.latency = now.latency.value_or(-1);
  return status;
}

bool EmbedSession::is_reached(std::uint32_t epoch, std::uint32_t samples) const {
  const interactive::LoopStatus now = session_->status();
  using interactive::LoopState;
  if (now.epoch >= epoch && now.state == LoopState::Failed)
    throw EmbedError(ORIEL_FAILED, "the scene cannot be rendered");
  const auto newest = session_->picture();
  if (!newest || newest->epoch < epoch) return false;
  if (now.epoch == newest->epoch && now.state == LoopState::Converged) return true;
  if (samples == 0) return true;
  return samples != UINT32_MAX && !newest->preview && newest->samples >= samples;
}

void EmbedSession::wait(std::uint32_t epoch, std::uint32_t samples, double seconds) {
  using Clock = std::chrono::steady_clock;
  constexpr double kLongest = 1e8;  // seconds; longer waits would overflow the clock
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(std::min(seconds, kLongest)));
  for (;;) {
    std::unique_lock lock(mutex_);
    const std::uint64_t seen = changes_;
    lock.unlock();
    if (is_reached(epoch, samples)) return;
    if (session_->paused())
      throw EmbedError(ORIEL_FAILED, "the session is stopped; nothing will change");
    lock.lock();
    const auto has_changed = [&] { return changes_ != seen; };
    if (seconds < 0)
      wake_.wait(lock, has_changed);
    else if (!wake_.wait_until(lock, end, has_changed))
      throw EmbedError(ORIEL_TIMEOUT, "there is no such picture yet");
  }
}

}  // namespace oriel::embed
