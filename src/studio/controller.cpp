// SPDX-License-Identifier: Apache-2.0
#include "studio/controller.h"
#include "studio/request_error.h"
#include "studio/scene_content.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/parallel.h"
#include "interactive/interactive_session.h"
#include "studio/jobs.h"
#include "studio/json_values.h"

namespace oriel::studio {

using interactive::EditError;
using interactive::LoopStatus;
using interactive::TaskKind;

namespace {

nlohmann::json error_message(const nlohmann::json& id, const std::string& code,
                             const std::string& message) {
  return {{"type", "error"}, {"id", id}, {"code", code}, {"message", message}};
}

}  // namespace

const std::map<std::string, Controller::RequestType>& Controller::request_types() {
  using C = Controller;
  using enum interactive::TaskKind;
  static const std::map<std::string, RequestType> table = {
      {"view", {&C::view, Changes}},
      {"edit", {&C::edit, Changes}},
      {"set_edits", {&C::set_edits, Changes}},
      {"undo", {&C::undo, Changes}},
      {"redo", {&C::redo, Changes}},
      {"store_camera", {&C::store_camera, Changes}},
      {"daylight", {&C::daylight, Changes}},
      {"focus", {&C::focus, Changes}},
      {"save", {&C::save, Changes}},
      {"reload", {&C::reload, Changes}},
      {"relink", {&C::relink, Changes}},
      {"restart", {&C::restart, Changes}},
      {"sun_path", {&C::sun_path, Reads}},
      {"outline", {&C::outline, Reads}},
      {"element", {&C::element, Reads}},
      {"shader", {&C::shader, Reads}},
      {"pick", {&C::pick, Reads}},
      {"command", {&C::command, Reads}},
      {"job", {&C::job, Reads}},
      {"thumbnail", {&C::thumbnail, Reads}},
      // These read the film, or trace paths with other options of the world.
      {"probe", {&C::probe, Waits}},
      {"lux_grid", {&C::lux_grid, Waits}},
      {"explain", {&C::explain, Waits}},
      {"deliver", {&C::deliver, Waits}},
  };
  return table;
}

Controller::Controller(StudioSettings settings, StudioServices services)
    : settings_(std::move(settings)),
      services_(std::move(services)),
      content_(std::make_unique<SceneContent>()) {
  if (!settings_.journal.empty()) journal_.emplace(settings_.journal);
  interactive::SessionCallbacks callbacks;
  callbacks.picture = [this] {
    const std::scoped_lock lock(send_mutex_);
    if (picture_changed_) picture_changed_();
  };
  callbacks.status = [this] {
    send_progress();
    announce_messages();
  };
  crashed_ = !settings_.crash.empty();
  session_ = std::make_unique<interactive::InteractiveSession>(settings_.source, settings_.loop,
                                                               callbacks);
  session_->post([this](Loop& loop) {
    if (crashed_) {
      if (journal_) push_each(journal_->read());
      return;
    }
    if (!loop.read()) return announce_state();
    start(loop);
  });
}

Controller::~Controller() {
  {
    const std::scoped_lock lock(send_mutex_);
    send_ = {};
    picture_changed_ = {};
  }
  job_.reset();
  session_.reset();
}

void Controller::connect(std::function<void(std::string)> send,
                         std::function<void()> picture_changed) {
  const std::scoped_lock lock(send_mutex_);
  send_ = std::move(send);
  picture_changed_ = std::move(picture_changed);
}

/// Applies the edits of the journal to the scene that was just read, one by one: a file that was
/// changed meanwhile may not take all of them.
void Controller::start(Loop& loop) {
  std::vector<std::string> edits;
  for (const std::string& edit : journal_ ? journal_->read() : std::vector<std::string>()) {
    edits.push_back(edit);
    try {
      loop.set_edits(edits);
    } catch (const EditError&) {
      edits.pop_back();
    }
  }
  push_each(edits);
  announce_state();
}

/// Makes a step of undo for each of the last edits, and one for those before.
void Controller::push_each(const std::vector<std::string>& edits) {
  constexpr std::size_t kSteps = 50;
  for (std::size_t n = edits.size() - std::min(edits.size(), kSteps) + 1; n <= edits.size(); ++n)
    history_.push({edits.begin(), edits.begin() + static_cast<std::ptrdiff_t>(n)});
}

void Controller::send(const json& message) {
  const std::scoped_lock lock(send_mutex_);
  if (send_) send_(dumped(message));
}

void Controller::send_error(const json& id, const std::string& code, const std::string& message) {
  send(error_message(id, code, message));
}

/// Pauses for the user, and while the page is hidden or closed.
void Controller::update_pause() {
  if (!session_) return;
  session_->set_paused(paused_ || hidden_ || left_);
  last_state_ = -1;  // is sent although the state of the loop is the same
  send_progress();
}

void Controller::client_connected() {
  namespace fs = std::filesystem;
  ++client_;
  send({{"type", "welcome"},
        {"version", 1},
        {"program", ORIEL_VERSION},
        {"scene",
         {{"file", fs::path(settings_.shown_name).filename().string()},
          {"folder", scene_folder()},
          {"model", settings_.is_model}}}});
  if (crashed_)
    session_->post([this](Loop&) {
      send({{"type", "crashed"}, {"message", settings_.crash}, {"edits", history_.now().size()}});
    });
  hidden_ = left_ = false;
  update_pause();
  announce_state();
  send_progress();
}

void Controller::client_left() {
  left_ = true;
  update_pause();
}

void Controller::text(const std::string& message) {
  const json request = json::parse(message, nullptr, false);
  if (!request.is_object()) return;
  const json id = request.contains("id") ? request["id"] : json();
  if (!request.contains("type") || !request["type"].is_string())
    return send_error(id, "bad-request", "the field \"type\" is missing");
  const std::string type = request["type"];
  if (type == "pointer") return set_pointer(request);
  // Long requests end when any request follows.
  if (type == "cancel") return session_->post([](Loop&) {}, TaskKind::Waits);
  const auto found = request_types().find(type);
  if (found == request_types().end())
    return send_error(id, "unknown-type", "unknown type \"" + type + "\"");
  const Handler handler = found->second.handler;
  session_->post([this, handler, request, client = client_.load()](
                     Loop& loop) { run_request(loop, handler, request, client); },
                 found->second.kind);
}

/// No task of the session: it would interrupt the picture.
void Controller::set_pointer(const json& request) {
  std::optional<std::array<int, 2>> pixel;
  try {
    if (request.contains("x")) pixel = {int_field(request, "x"), int_field(request, "y")};
  } catch (const RequestError& error) {
    return send_error({}, error.code, error.what());
  }
  session_->set_pointer(pixel);
}

void Controller::run_request(Loop& loop, Handler handler, const json& request,
                             std::uint64_t client) {
  const json id = request.contains("id") ? request["id"] : json();
  // Another client counts its requests anew, so it must not get answers to those of this one.
  const auto answer = [&](const json& message) {
    if (client == client_) send(message);
  };
  const auto fail = [&](const std::string& code, const char* message) {
    answer(error_message(id, code, message));
  };
  try {
    const bool needs_scene = handler != &Controller::restart && handler != &Controller::undo &&
                             handler != &Controller::reload && handler != &Controller::set_edits;
    if (needs_scene && !loop.scene().is_read())
      throw RequestError("failed",
                         crashed_ ? "the renderer is not running" : "the scene could not be read");
    json reply = (this->*handler)(loop, request);
    reply["type"] = "reply";
    reply["id"] = id;
    answer(reply);
  } catch (const EditError& error) {
    fail("bad-edit", error.what());
  } catch (const RequestError& error) {
    fail(error.code, error.what());
  } catch (const nlohmann::json::exception& error) {
    fail("bad-request", error.what());
  } catch (const std::exception& error) {
    fail("failed", error.what());
  }
}

Controller::json Controller::restart(Loop& loop, const json&) {
  if (crashed_.exchange(false)) {
    if (!loop.read()) throw RequestError("failed", "the scene could not be read");
    loop.set_edits(history_.now());
    announce_state();
  }
  return {{"epoch", loop.next_epoch()}};
}

std::shared_ptr<const interactive::Picture> Controller::picture() { return session_->picture(); }

void Controller::send_progress() {
  using namespace std::chrono;
  const LoopStatus status = session_ ? session_->status() : LoopStatus();
  const auto now = duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
  const int state = static_cast<int>(status.state);
  const bool changed = last_state_.exchange(state) != state;
  if (!changed && now - last_progress_ < 100 && status.progress.done < 1) return;
  last_progress_ = now;
  constexpr const char* kStates[] = {"loading", "preparing", "rendering", "converged", "failed"};
  const Progress& p = status.progress;
  json message = {{"type", "progress"},   {"epoch", status.epoch},     {"divider", status.divider},
                  {"pass", p.pass},       {"samples", p.mean_samples}, {"noise", nullptr},
                  {"elapsed", p.elapsed}, {"remaining", nullptr},      {"done", p.done},
                  {"stage", nullptr},     {"latency", nullptr},        {"status", kStates[state]}};
  if (p.noise && std::isfinite(*p.noise)) message["noise"] = *p.noise;
  if (p.remaining) message["remaining"] = *p.remaining;
  if (p.stage) message["stage"] = p.stage;
  if (status.latency) message["latency"] = *status.latency;
  if (session_ && session_->paused()) message["status"] = "paused";
  if (crashed_) message["status"] = "crashed";
  send(message);
}

/// Messages that shaders report while they render.
void Controller::announce_messages() {
  const std::size_t count = session_ ? session_->status().messages : 0;
  if (count <= announced_messages_) return;
  announced_messages_ = count;
  session_->post([this](Loop& loop) { send_messages(loop); }, TaskKind::Waits);
}

void Controller::announce_state() {
  if (!session_ || state_announced_.exchange(true)) return;
  session_->post(
      [this](Loop& loop) {
        state_announced_ = false;
        send_state(loop);
      },
      TaskKind::Reads);
  session_->post([this](Loop& loop) { send_messages(loop); }, TaskKind::Waits);
}

std::string Controller::scene_folder() const {
  return std::filesystem::absolute(settings_.source.path).parent_path().string();
}

}  // namespace oriel::studio
