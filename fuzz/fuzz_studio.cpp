// SPDX-License-Identifier: Apache-2.0
// Messages of a client of Oriel Studio, one a line, and the texts of its HTTP requests.
#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/explain.h"
#include "base/temporary_folder.h"
#include "fuzzers.h"
#include "shaders/registry.h"
#include "studio/controller.h"
#include "studio/request_checks.h"

namespace {

using namespace oriel;

constexpr const char* kFuzzedScene = R"(options "opt" samples 0 0 trace depth 1 1 2 end options
light "lamp" "mib_light_point" ("color" 4 4 4) origin 0 0 3 end light
instance "lamp_inst" "lamp" end instance
color texture "wood" "none.png"
material "grey" "mia_material_x" ("diffuse" .5 .4 .3) end material
object "floor" visible shadow trace group
  -4 -4 0  4 -4 0  4 4 0  -4 4 0  v 0 v 1 v 2 v 3  p "grey" 0 1 2 3
end group end object
instance "floor_inst" "floor" end instance
camera "cam" focal 35 aperture 36 aspect 1 resolution 8 8 end camera
instance "cam_inst" "cam" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -5 1 end instance
instgroup "root" "lamp_inst" "floor_inst" "cam_inst" end instgroup
render "root" "cam_inst" "opt"
)";

/// The answers to a client; waits for the last one.
class Client {
 public:
  explicit Client(studio::Controller& controller) : controller_(controller) {
    controller.connect([this](const std::string& message) { receive(message); }, {});
    controller.client_connected();
  }
  ~Client() { controller_.connect({}, {}); }

  /// Sends the messages, then one whose answer shows that all others were handled.
  void send(const std::vector<std::string>& messages) {
    for (const std::string& message : messages) controller_.text(message);
    controller_.text(R"({"type": "outline", "id": "the last"})");
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return done_; });
  }

 private:
  void receive(const std::string& message) {
    const nlohmann::json answer = nlohmann::json::parse(message);  // has to be valid
    if (!answer.contains("id") || answer["id"] != "the last") return;
    {
      const std::scoped_lock lock(mutex_);
      done_ = true;
    }
    wake_.notify_all();
  }

  studio::Controller& controller_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
};

void check_texts(const std::string& text) {
  const studio::OwnAddress own(8080);
  own.is_host(text);
  own.is_origin(text);
  const std::string decoded = studio::percent_decoded(text);
  if (decoded.find('\0') != std::string::npos) std::abort();
  if (studio::is_plain_name(text) && text.find('/') != std::string::npos) std::abort();
  studio::query_value(text, "name");
}

}  // namespace

int oriel::fuzz::fuzz_studio(const std::uint8_t* data, std::size_t size) {
  std::string_view text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> messages;
  constexpr std::size_t kMostMessages = 20;
  while (!text.empty() && messages.size() < kMostMessages) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    messages.emplace_back(text.substr(0, end));
    check_texts(messages.back());
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  const TemporaryFolder folder;
  std::ofstream(folder.file("scene.mi")) << kFuzzedScene;
  studio::StudioSettings settings;
  settings.source.path = folder.file("scene.mi");
  settings.source.registry = &builtin_shaders();
  settings.source.read.packages = builtin_packages();
  settings.shown_name = settings.source.path;
  studio::StudioServices services;
  services.explain = [](const Explanation&, const World&, const IndirectPlan&,
                        const UnitLuminance&) { return nlohmann::json::object(); };
  services.program = "/bin/false";
  studio::Controller controller(std::move(settings), std::move(services));
  controller.text(R"({"type": "view", "paused": true})");
  Client(controller).send(messages);
  return 0;
}
