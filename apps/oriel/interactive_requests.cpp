// SPDX-License-Identifier: Apache-2.0
#include "interactive_requests.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "interactive/interactive_session.h"
#include "message_stream.h"
#include "output/output.h"
#include "studio/json_values.h"
#include "studio/request_error.h"

namespace oriel::app {
namespace {

using interactive::LoopState;
using interactive::LoopStatus;
using interactive::Picture;
using interactive::ViewSettings;
using nlohmann::json;
using studio::RequestError;

const char* name_of_state(LoopState state) {
  switch (state) {
    case LoopState::Loading:
      return "loading";
    case LoopState::Preparing:
      return "preparing";
    case LoopState::Rendering:
      return "rendering";
    case LoopState::Converged:
      return "converged";
    case LoopState::Failed:
      return "failed";
  }
  return "failed";
}

bool flag_field(const json& request, const char* name) {
  const auto found = request.find(name);
  return found != request.end() && found->is_boolean() && found->get<bool>();
}

std::optional<std::array<int, 4>> region_of(const json& value) {
  if (value.is_null()) return std::nullopt;
  if (!value.is_array() || value.size() != 4)
    throw RequestError("bad-request", "\"region\" has four numbers");
  std::array<int, 4> region{};
  for (std::size_t i = 0; i < region.size(); ++i) {
    if (!value[i].is_number()) throw RequestError("bad-request", "\"region\" has four numbers");
    region[i] = static_cast<int>(std::clamp(value[i].get<double>(), 0.0, 65536.0));
  }
  if (region[2] <= region[0] || region[3] <= region[1])
    throw RequestError("bad-request", "\"region\" is empty");
  return region;
}

/// The fields of a request that concern the view.
ViewSettings view_of(const json& request, ViewSettings view, bool denoises) {
  if (const auto region = request.find("region"); region != request.end())
    view.region = region_of(*region);
  if (const auto samples = studio::optional_number(request, "samples"))
    view.budget.samples =
        static_cast<std::uint32_t>(std::clamp(*samples, 1.0, double{kMaxSamples}));
  // The denoiser reads the features of the first hits.
  view.layers = {interactive::kBeautyLayer};
  if (denoises) view.layers.insert(view.layers.end(), {"albedo", "normal", "depth"});
  return view;
}

std::string last_error(const Diagnostics& diagnostics) {
  std::string text = "the scene cannot be rendered";
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity == Severity::Error) text = d.message;
  return text;
}

/// The part of an image that a picture shows, RGB as halves.
std::vector<std::byte> halves_of(const Image& image, const Picture& part) {
  constexpr float kLargestHalf = 65504;
  std::vector<std::byte> pixels(static_cast<std::size_t>(part.w) *
                                static_cast<std::size_t>(part.h) *
                                interactive::bytes_per_pixel(interactive::LayerFormat::Rgb16F));
  std::byte* to = pixels.data();
  for (int y = 0; y < part.h; ++y)
    for (int x = 0; x < part.w; ++x) {
      const float* color = image.at(part.x + x, part.y + y);
      std::array<std::uint16_t, 3> bits{};
      for (std::size_t c = 0; c < bits.size(); ++c) {
        const float value = std::isnan(color[c]) ? 0 : color[c];
        bits[c] = half(std::clamp(value, -kLargestHalf, kLargestHalf)).bits();
      }
      std::memcpy(to, bits.data(), sizeof bits);
      to += sizeof bits;
    }
  return pixels;
}

json state_message(const LoopStatus& status) {
  return {{"type", "state"},
          {"epoch", status.epoch},
          {"state", name_of_state(status.state)},
          {"samples", status.progress.mean_samples},
          {"done", status.progress.done},
          {"latency", status.latency ? json(*status.latency) : json()}};
}

bool is_end(LoopState state) { return state == LoopState::Converged || state == LoopState::Failed; }

}  // namespace

class InteractiveRequests::Work {
 public:
  Work(interactive::SceneSource source, const interactive::LoopSettings& settings, int output);
  void handle(const std::string& line);

 private:
  using Loop = interactive::RenderLoop;
  void update(Loop& loop, const json& request);
  void answer(Loop& loop, const json& request);
  void status_changed();
  void finish(Loop& loop);
  void show_denoised(Loop& loop);

  MessageStream stream_;
  bool denoises_ = false;                  ///< of the render thread
  std::optional<std::uint32_t> finished_;  ///< epoch whose end was reported, of the render thread
  std::unique_ptr<interactive::InteractiveSession> session_;
};

InteractiveRequests::InteractiveRequests(interactive::SceneSource source,
                                         const interactive::LoopSettings& settings, int output)
    : work_(std::make_unique<Work>(std::move(source), settings, output)) {}

InteractiveRequests::~InteractiveRequests() = default;

void InteractiveRequests::handle(const std::string& line) { work_->handle(line); }

InteractiveRequests::Work::Work(interactive::SceneSource source,
                                const interactive::LoopSettings& settings, int output)
    : stream_(output) {
  interactive::SessionCallbacks callbacks;
  callbacks.picture = [this] {
    Picture picture = *session_->picture();
    picture.layers.resize(1);
    stream_.show(std::make_shared<const Picture>(std::move(picture)));
  };
  callbacks.status = [this] { status_changed(); };
  session_ = std::make_unique<interactive::InteractiveSession>(std::move(source), settings,
                                                               std::move(callbacks));
}

void InteractiveRequests::Work::handle(const std::string& line) {
  const json request = json::parse(line, nullptr, false);
  if (!request.is_object()) {
    stream_.send({{"type", "error"}, {"id", nullptr}, {"message", "a request is not JSON"}});
    return;
  }
  session_->post([this, request](Loop& loop) { answer(loop, request); });
}

void InteractiveRequests::Work::answer(Loop& loop, const json& request) {
  const json id = request.contains("id") ? request["id"] : json();
  const auto fail = [&](const char* what) {
    stream_.send({{"type", "error"}, {"id", id}, {"message", what}});
  };
  try {
    if (studio::text_field(request, "type") != "update")
      throw RequestError("unknown-type", "the type of the request is unknown");
    update(loop, request);
    stream_.send({{"type", "reply"}, {"id", id}, {"epoch", loop.next_epoch()}});
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

void InteractiveRequests::Work::update(Loop& loop, const json& request) {
  if (flag_field(request, "reload") || !loop.scene().is_read()) {
    if (!loop.read()) throw RequestError("failed", last_error(loop.diagnostics()));
  }
  denoises_ = flag_field(request, "denoise");
  const ViewSettings view = view_of(request, loop.view(), denoises_);
  if (request.contains("edits")) loop.set_edits(studio::texts_field(request, "edits"));
  loop.set_view(view);
}

void InteractiveRequests::Work::status_changed() {
  const LoopStatus status = session_->status();
  if (is_end(status.state))
    session_->post([this](Loop& loop) { finish(loop); });
  else
    stream_.state(state_message(status));
}

void InteractiveRequests::Work::finish(Loop& loop) {
  const LoopStatus status = loop.status();
  if (!is_end(status.state) || finished_ == status.epoch) return;  // a request came first
  finished_ = status.epoch;
  json message = state_message(status);
  if (status.state == LoopState::Failed)
    message["message"] = last_error(loop.diagnostics());
  else if (denoises_ && loop.session())
    show_denoised(loop);
  stream_.state(message);
}

void InteractiveRequests::Work::show_denoised(Loop& loop) {
  const auto noisy = session_->picture();
  const DenoisedPicture denoised = denoised_beauty(*loop.session(), Denoiser::Best);
  if (!noisy || denoised.color.width != noisy->width || denoised.color.height != noisy->height)
    return;
  Picture picture = *noisy;
  picture.layers.resize(1);
  picture.layers[0].pixels = halves_of(denoised.color, picture);
  stream_.show(std::make_shared<const Picture>(std::move(picture)));
}

}  // namespace oriel::app
