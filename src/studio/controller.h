// SPDX-License-Identifier: Apache-2.0
// Answers the messages of a client of Oriel Studio.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "interactive/edit_history.h"
#include "interactive/journal.h"
#include "interactive/render_loop.h"
#include "studio/server.h"

namespace oriel {
struct Explanation;
struct IndirectPlan;
}  // namespace oriel

namespace oriel::interactive {
class InteractiveSession;
enum class TaskKind : std::uint8_t;
}  // namespace oriel::interactive

namespace oriel::studio {

class RenderJob;
class SceneContent;

/// What the program provides.
struct StudioServices {
  /// Text and JSON of an explanation.
  std::function<nlohmann::json(const Explanation&, const World&, const IndirectPlan&,
                               const UnitLuminance&)>
      explain;
  std::string program;               ///< path of the oriel program, for jobs
  std::vector<std::string> options;  ///< further options of the command line, e.g. of trust
};

struct StudioSettings {
  interactive::SceneSource source;
  interactive::LoopSettings loop;
  std::string shown_name;  ///< the file that the user named
  bool is_model = false;
  std::string journal;  ///< file of unsaved edits; empty: none
  /// Not empty: why the renderer ended before. It starts paused then, with the edits of the
  /// journal.
  std::string crash;
};

/// Answers messages by an interactive session.
///
/// Model:   requests that concern the scene run as tasks of the session, in order.
/// Checked: StudioSessionTest.* in tests/studio
class Controller final : public ServerHandler {
 public:
  Controller(StudioSettings settings, StudioServices services);
  ~Controller() override;

  /// Inputs:  send: gets each message to the client, from any thread; picture_changed: likewise.
  void connect(std::function<void(std::string)> send, std::function<void()> picture_changed);

  void client_connected() override;
  void client_left() override;
  void text(const std::string& message) override;
  ApiAnswer api(ApiRequest request) override;
  std::size_t max_body(const std::string& path) const override;
  std::shared_ptr<const interactive::Picture> picture() override;

  interactive::InteractiveSession& session() { return *session_; }

 private:
  using json = nlohmann::json;
  using Loop = interactive::RenderLoop;
  using Handler = json (Controller::*)(Loop&, const json&);
  struct RequestType {
    Handler handler;
    interactive::TaskKind kind;
  };
  static const std::map<std::string, RequestType>& request_types();

  void send(const json& message);
  void send_error(const json& id, const std::string& code, const std::string& message);
  void set_pointer(const json& request);
  /// Inputs:  client: the number of the client that sent the request.
  void run_request(Loop& loop, Handler handler, const json& request, std::uint64_t client);
  void send_progress();
  void announce_state();
  void announce_messages();
  void send_state(Loop& loop);
  void send_messages(Loop& loop);
  void start(Loop& loop);
  void push_each(const std::vector<std::string>& edits);
  void update_pause();
  /// The last request `daylight`, if its edits are still in the list; else null.
  json present_daylight() const;
  json edited(Loop& loop);
  json try_edits(Loop& loop, std::vector<std::string> edits, const std::string& gesture);

  // controller_view.cpp, controller_edit.cpp, controller_scene.cpp, controller_measure.cpp,
  // controller_deliver.cpp, controller_thumbnail.cpp
  json view(Loop& loop, const json& request);
  json edit(Loop& loop, const json& request);
  json set_edits(Loop& loop, const json& request);
  json undo(Loop& loop, const json& request);
  json redo(Loop& loop, const json& request);
  json store_camera(Loop& loop, const json& request);
  json daylight(Loop& loop, const json& request);
  json sun_path(Loop& loop, const json& request);
  json focus(Loop& loop, const json& request);
  json save(Loop& loop, const json& request);
  json reload(Loop& loop, const json& request);
  json relink(Loop& loop, const json& request);
  json restart(Loop& loop, const json& request);
  json outline(Loop& loop, const json& request);
  json element(Loop& loop, const json& request);
  json shader(Loop& loop, const json& request);
  json pick(Loop& loop, const json& request);
  json probe(Loop& loop, const json& request);
  json lux_grid(Loop& loop, const json& request);
  json explain(Loop& loop, const json& request);
  json thumbnail(Loop& loop, const json& request);
  json command(Loop& loop, const json& request);
  json deliver(Loop& loop, const json& request);
  json job(Loop& loop, const json& request);

  ApiAnswer upload(const ApiRequest& request) const;
  /// The edit that makes the present look that of the scene's camera; unset without a look.
  std::optional<std::string> camera_edit(Loop& loop) const;
  std::vector<std::string> render_words(Loop& loop) const;
  std::string scene_folder() const;
  std::uint64_t keep_result(std::string bytes, std::string type);

  StudioSettings settings_;
  StudioServices services_;
  std::function<void(std::string)> send_;
  std::function<void()> picture_changed_;
  std::mutex send_mutex_;
  interactive::EditHistory history_;                 // of the session's thread
  std::optional<interactive::EditJournal> journal_;  // likewise
  std::vector<std::string> saved_;                   // edits of the last save, likewise
  std::unique_ptr<SceneContent> content_;            // likewise
  /// Fields of the last request `daylight` and its edits, likewise.
  std::string daylight_;
  std::vector<std::string> daylight_edits_;
  std::atomic<bool> state_announced_ = false;
  std::atomic<std::size_t> announced_messages_ = 0;
  std::atomic<std::int64_t> last_progress_ = 0;
  std::atomic<int> last_state_ = -1;
  std::atomic<bool> crashed_ = false;
  std::atomic<std::uint64_t> client_ = 0;  ///< number of the present client
  // What stops the renderer: the user, a hidden page, a page that was closed.
  std::atomic<bool> paused_ = false, hidden_ = false, left_ = false;
  std::mutex results_mutex_;
  struct Result {
    std::uint64_t number;
    std::string type;
    std::shared_ptr<const std::string> bytes;
  };
  std::vector<Result> results_;
  std::uint64_t next_result_ = 1;
  std::vector<Result> thumbnails_;  // guarded by results_mutex_
  std::uint64_t next_thumbnail_ = 1;
  std::unique_ptr<RenderJob> job_;
  std::unique_ptr<interactive::InteractiveSession> session_;  // last: its thread uses the others
};

}  // namespace oriel::studio
