// SPDX-License-Identifier: Apache-2.0
// The view, the state and the messages of the scene.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/explain.h"
#include "base/math.h"
#include "geom/accel.h"
#include "interactive/interactive_session.h"
#include "scene/asset_path.h"
#include "scene/hierarchy.h"
#include "studio/controller.h"
#include "studio/jobs.h"
#include "studio/json_values.h"
#include "studio/request_error.h"
#include "studio/scene_content.h"

namespace oriel::studio {
namespace {

using json = nlohmann::json;
using interactive::Look;
using interactive::ViewSettings;

constexpr int kMaxSide = 16384;
constexpr long kMaxPixels = 1L << 26;  // about 6 GB of film

template <std::size_t N>
std::optional<std::array<int, N>> numbers_or_null(const json& value, const char* name) {
  if (value.is_null()) return std::nullopt;
  if (!value.is_array() || value.size() != N)
    throw RequestError("bad-request", std::string("the field \"") + name + "\" has a wrong form");
  std::array<int, N> numbers;
  for (std::size_t i = 0; i < N; ++i) {
    if (!value[i].is_number()) throw RequestError("bad-request", "expected numbers");
    numbers[i] = static_cast<int>(std::clamp(value[i].get<double>(), -1e6, 1e6));
  }
  return numbers;
}

BudgetRequest budget_of(const json& value) {
  BudgetRequest budget;
  if (const auto samples = optional_number(value, "samples"))
    budget.samples = static_cast<std::uint32_t>(std::clamp(*samples, 1.0, double{kMaxSamples}));
  if (const auto noise = optional_number(value, "noise")) budget.noise = static_cast<float>(*noise);
  budget.seconds = optional_number(value, "seconds");
  return budget;
}

json json_of_budget(const BudgetRequest& b) {
  json value = {{"samples", nullptr}, {"noise", nullptr}, {"seconds", nullptr}};
  if (b.samples) value["samples"] = *b.samples;
  if (b.noise) value["noise"] = *b.noise;
  if (b.seconds) value["seconds"] = *b.seconds;
  return value;
}

std::vector<scene::LightGroup> light_groups_of(const json& list) {
  std::vector<scene::LightGroup> groups;
  for (const json& item : list) {
    const std::string text = item.is_string() ? item.get<std::string>() : std::string();
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw RequestError("bad-request", "a light group has the form NAME=PATTERN,...");
    scene::LightGroup group{text.substr(0, equals), scene::split_patterns(text.substr(equals + 1))};
    if (const std::string fault = scene::light_group_complaint(group); !fault.empty())
      throw RequestError("bad-request", fault);
    groups.push_back(std::move(group));
  }
  return groups;
}

void read_view_fields(const json& request, ViewSettings& view) {
  const auto with = [&](const char* name, const auto& set) {
    if (const auto found = request.find(name); found != request.end()) set(*found);
  };
  with("look", [&](const json& v) {
    view.look = v.is_null() ? std::nullopt
                            : std::optional(Look{vector_field(v, "from"), vector_field(v, "to"),
                                                 vector_field(v, "up")});
  });
  with("camera", [&](const json&) {
    view.camera = optional_text(request, "camera");
    view.look.reset();
  });
  with("size", [&](const json& v) {
    view.size = numbers_or_null<2>(v, "size");
    if (view.size)
      for (int& side : *view.size) side = std::clamp(side, 1, kMaxSide);
    if (view.size && long{(*view.size)[0]} * (*view.size)[1] > kMaxPixels)
      throw RequestError("too-large", "the picture has too many pixels");
  });
  with("scale", [&](const json&) { view.scale = std::clamp(int_field(request, "scale"), 1, 8); });
  with("region", [&](const json& v) { view.region = numbers_or_null<4>(v, "region"); });
  with("layers", [&](const json&) {
    view.layers = texts_field(request, "layers");
    std::erase(view.layers, interactive::kBeautyLayer);
    view.layers.insert(view.layers.begin(), interactive::kBeautyLayer);
    if (view.layers.size() > 80) throw RequestError("too-large", "too many layers");
  });
  with("budget", [&](const json& v) { view.budget = budget_of(v); });
  with("dragging", [&](const json& v) { view.dragging = v.is_boolean() && v.get<bool>(); });
  with("light_groups", [&](const json& v) {
    view.group_lights = v == "auto";
    view.light_groups = v.is_array() ? light_groups_of(v) : std::vector<scene::LightGroup>();
  });
}

std::vector<std::string> camera_instances(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const scene::Element& element : scene.elements())
    if (const auto* instance = std::get_if<scene::Instance>(&element))
      if (scene.get<scene::Camera>(instance->element)) names.push_back(instance->name);
  return names;
}

/// Parameters of the first exposure of the camera.
json exposure_of(const World& world) {
  json exposure;
  for (const ShaderNode* node : world.lens) {
    if (!node->spec().lens.settings) continue;
    exposure["shader"] = node->spec().name;
    // Integer files get the gamma of the options in addition to that of the shader.
    node->spec().lens.settings(*node, [&](const char* name, float value) {
      const bool is_gamma = std::string_view(name) == "gamma";
      exposure["parameters"][name] = is_gamma ? value * world.options.gamma : value;
    });
    break;
  }
  return exposure;
}

/// Distance of the point about which the camera turns: the surface in the middle of the picture, or
/// the middle of the scene.
float distance_looked_at(const World& world) {
  const Camera& camera = world.camera;
  const Spot spot = find_spot(
      world, Vec2(static_cast<float>(camera.width), static_cast<float>(camera.height)) * .5f);
  if (spot.surface) return spot.distance;
  const geom::Box3 box = world.accel->bounds();
  if (box.isEmpty()) return 1;
  constexpr float kNearest = 1e-6f;  // of scenes in any unit
  return std::max(length(box.center() - transform_point(Vec3(0), camera.to_world)), kNearest);
}

}  // namespace

json Controller::view(Loop& loop, const json& request) {
  const auto set_flag = [&](const char* name, std::atomic<bool>& flag) {
    if (const auto found = request.find(name); found != request.end())
      flag = found->is_boolean() && found->get<bool>();
  };
  set_flag("paused", paused_);
  set_flag("hidden", hidden_);
  update_pause();
  ViewSettings view = loop.view();
  read_view_fields(request, view);
  if (view.look && !interactive::camera_matrix(*view.look))
    throw RequestError("bad-request", "the look does not define a camera");
  const bool drags = view.dragging;
  loop.set_view(view);
  if (!drags) announce_state();
  return {{"epoch", loop.next_epoch()}};
}

void Controller::send_state(Loop& loop) {
  const ViewSettings& view = loop.view();
  json state = {{"type", "state"},
                {"edits", history_.now()},
                {"content", content_->name(history_.now())},
                {"undo", history_.undo_count()},
                {"redo", history_.redo_count()},
                {"saved", history_.now() == saved_},
                {"scale", view.scale},
                {"region", nullptr},
                {"layers", view.layers},
                {"paused", paused_.load()},
                {"budget", json_of_budget(view.budget)},
                {"look_stored", !view.look}};
  if (const json daylight = present_daylight(); !daylight.is_null()) state["daylight"] = daylight;
  if (view.region) state["region"] = *view.region;
  if (loop.scene().is_read() && loop.prepare()) {
    const World& world = *loop.scene().world();
    const Camera& camera = world.camera;
    const geom::Box3 box = world.accel->bounds();
    const bool bounded = !box.isEmpty();
    const float distance = view.look ? 0 : distance_looked_at(world);
    const Look look = view.look ? *view.look : interactive::look_of(camera, distance);
    state["size"] = loop.full_size();
    state["look"] = {
        {"from", json_of(look.from)}, {"to", json_of(look.to)}, {"up", json_of(look.up)}};
    state["fov"] = 2 * math::atan(camera.aperture / (2 * camera.focal)) * 180 / 3.14159265358979;
    state["orthographic"] = camera.orthographic;
    state["gamma"] = world.options.gamma;
    state["available_layers"] = interactive::available_layers(world);
    state["light_layers"] = json::array();
    for (const std::string& name : interactive::available_layers(world))
      if (name.starts_with("light_")) state["light_layers"].push_back(name);
    state["unit_luminance"] = loop.scene().unit().cd_m2;
    state["unit_luminance_source"] = loop.scene().unit().by;
    if (bounded) state["bounds"] = {{"min", json_of(box.min)}, {"max", json_of(box.max)}};
    if (const json exposure = exposure_of(world); !exposure.is_null()) state["exposure"] = exposure;
  }
  if (loop.scene().is_read()) {
    state["cameras"] = camera_instances(loop.scene().scene());
    state["camera"] = view.camera.empty() ? loop.scene().command().camera : view.camera;
  }
  state["epoch"] = loop.status().epoch;
  send(state);
}

void Controller::send_messages(Loop& loop) {
  constexpr const char* kSeverities[] = {"note", "warning", "error"};
  json list = json::array(), missing = json::array();
  const Diagnostics& all = loop.diagnostics();
  for (const Diagnostic& d : all.all()) {
    json item = {{"severity", kSeverities[static_cast<int>(d.severity)]},
                 {"code", d.code},
                 {"message", d.message}};
    if (!d.hint.empty()) item["hint"] = d.hint;
    if (d.where.file) item["file"] = all.file(d.where.file);
    if (d.where.line) item["line"] = d.where.line, item["column"] = d.where.column;
    list.push_back(std::move(item));
  }
  if (loop.scene().is_read()) {
    const scene::Scene& scene = loop.scene().scene();
    for (const scene::Element& element : scene.elements()) {
      const auto* texture = std::get_if<scene::Texture>(&element);
      if (!texture || texture->file.empty()) continue;
      const std::string path = scene::find_asset(texture->file, texture->directory, scene.files);
      if (open_regular(path)) continue;
      missing.push_back(
          {{"texture", texture->name},
           {"file", texture->file},
           {"where", all.file(texture->where.file) + ":" + std::to_string(texture->where.line)}});
    }
  }
  announced_messages_ = all.all().size();
  send({{"type", "messages"}, {"list", list}, {"missing", missing}});
}

}  // namespace oriel::studio
