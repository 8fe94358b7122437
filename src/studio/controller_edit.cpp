// SPDX-License-Identifier: Apache-2.0
// Edits: changes, undo, daylight, camera, saving.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "interactive/inverse_edits.h"
#include "interactive/save_edits.h"
#include "interactive/sun_edits.h"
#include "output/camera_output.h"
#include "scene/asset_path.h"
#include "scene/hierarchy.h"
#include "studio/controller.h"
#include "studio/json_values.h"
#include "studio/request_checks.h"
#include "studio/request_error.h"
#include "studio/scene_content.h"

namespace oriel::studio {
namespace {

using json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMaxEdits = 10'000, kMaxEditBytes = 4096;

void check_size(const std::vector<std::string>& edits) {
  if (edits.size() > kMaxEdits) throw RequestError("too-large", "too many edits");
  for (const std::string& edit : edits)
    if (edit.size() > kMaxEditBytes || edit.find('\0') != std::string::npos)
      throw RequestError("too-large", "an edit is too long");
}

std::string numbers_text(const Mat4& m) {
  std::string text;
  for (int i = 0; i < 16; ++i) text += fmt::format("{}{}", i > 0 ? " " : "", m[i / 4][i % 4]);
  return text;
}

}  // namespace

json Controller::edited(Loop& loop) {
  if (journal_)
    journal_->write(history_.now() == saved_ ? std::vector<std::string>() : history_.now());
  announce_state();
  return {{"epoch", loop.next_epoch()},
          {"undo", history_.undo_count()},
          {"redo", history_.redo_count()}};
}

json Controller::try_edits(Loop& loop, std::vector<std::string> edits, const std::string& gesture) {
  check_size(edits);
  // The journal comes first: what ends the renderer has then been written.
  if (journal_) journal_->write(edits);
  try {
    if (loop.scene().is_read()) loop.set_edits(edits);
  } catch (...) {
    if (journal_) journal_->write(history_.now());
    throw;
  }
  history_.push(std::move(edits), gesture);
  return edited(loop);
}

json Controller::edit(Loop& loop, const json& request) {
  std::vector<std::string> edits = history_.now();
  const std::vector<std::string> given = texts_field(request, "edits");
  check_size(given);
  for (const std::string& edit : given)
    edits = interactive::with_edit(loop.scene().scene(), std::move(edits), edit);
  return try_edits(loop, std::move(edits), optional_text(request, "gesture"));
}

json Controller::set_edits(Loop& loop, const json& request) {
  return try_edits(loop, texts_field(request, "edits"), {});
}

json Controller::undo(Loop& loop, const json&) {
  if (history_.undo() && loop.scene().is_read()) loop.set_edits(history_.now());
  return edited(loop);
}

json Controller::redo(Loop& loop, const json&) {
  if (history_.redo()) loop.set_edits(history_.now());
  return edited(loop);
}

std::optional<std::string> Controller::camera_edit(Loop& loop) const {
  const interactive::ViewSettings& view = loop.view();
  if (!view.look) return std::nullopt;
  const scene::Scene& scene = loop.scene().scene();
  const std::string name = view.camera.empty() ? loop.scene().command().camera : view.camera;
  const auto* instance = scene.get<scene::Instance>(name);
  if (!instance) throw RequestError("not-found", "the camera has no instance");
  const Mat4 to_camera = *interactive::camera_matrix(*view.look);
  // Instances may be below others: the matrix of those stays.
  Diagnostics known;
  Mat4 transform = to_camera;
  for (const scene::Leaf& leaf : scene::flatten(scene, loop.scene().command().root, known,
                                                {.leaves = scene.budgets[Budget::Instances]}))
    if (leaf.kind == scene::LeafKind::Camera && &leaf.instance() == instance &&
        leaf.chain.size() > 1)
      transform = (leaf.world_to_local * instance->transform.value_or(Mat4()).inverse()).inverse() *
                  to_camera;
  return name + ".transform=" + numbers_text(transform);
}

json Controller::store_camera(Loop& loop, const json&) {
  const std::optional<std::string> edit = camera_edit(loop);
  if (!edit) throw RequestError("bad-request", "the scene's camera is shown already");
  interactive::ViewSettings view = loop.view();
  view.look.reset();
  loop.set_view(view);
  return try_edits(loop, interactive::with_edit(loop.scene().scene(), history_.now(), *edit), {});
}

json Controller::daylight(Loop& loop, const json& request) {
  const double latitude = number_field(request, "latitude");
  const double longitude = number_field(request, "longitude");
  const auto day = sky::julian_day(text_field(request, "time"));
  if (!day || !(std::abs(latitude) <= 90) || !(std::abs(longitude) <= 360))
    throw RequestError("bad-request", "place or time is invalid; the time needs its zone");
  const sky::SolarPosition sun =
      sky::solar_position(*day, {.latitude = latitude, .longitude = longitude});
  const double north = optional_number(request, "north").value_or(0);
  std::vector<std::string> edits = history_.now();
  const std::vector<std::string> sun_edits =
      interactive::sun_edits(loop.scene().scene(), loop.scene().command().root, sun, north,
                             optional_number(request, "haze"));
  if (sun_edits.empty()) throw RequestError("not-found", "the scene has no sun and no sky");
  for (const std::string& edit : sun_edits)
    edits = interactive::with_edit(loop.scene().scene(), std::move(edits), edit);
  json reply = try_edits(loop, std::move(edits), optional_text(request, "gesture"));
  json fields;
  for (const char* name : {"latitude", "longitude", "time", "north", "haze"})
    if (request.contains(name)) fields[name] = request[name];
  daylight_ = fields.dump();
  daylight_edits_ = sun_edits;
  reply["azimuth"] = sun.azimuth;
  reply["elevation"] = sun.elevation;
  return reply;
}

json Controller::present_daylight() const {
  const std::vector<std::string>& now = history_.now();
  const auto is_present = [&](const std::string& edit) {
    return std::find(now.begin(), now.end(), edit) != now.end();
  };
  if (daylight_.empty() || !std::all_of(daylight_edits_.begin(), daylight_edits_.end(), is_present))
    return nullptr;
  return json::parse(daylight_);
}

json Controller::sun_path(Loop&, const json& request) {
  const sky::Place place{.latitude = number_field(request, "latitude"),
                         .longitude = number_field(request, "longitude")};
  const std::string date = text_field(request, "date");
  const double zone = optional_number(request, "zone").value_or(0);
  const auto midnight = sky::julian_day(date + "T00:00Z");
  if (!midnight) throw RequestError("bad-request", "the date is invalid");
  json hours = json::array();
  for (int i = 0; i <= 48; ++i) {
    const sky::SolarPosition sun = sky::solar_position(*midnight + (i * 0.5 - zone) / 24, place);
    hours.push_back({{"time", i * 0.5}, {"azimuth", sun.azimuth}, {"elevation", sun.elevation}});
  }
  return {{"hours", hours}};
}

json Controller::relink(Loop& loop, const json& request) {
  const std::string wanted = text_field(request, "texture"), file = text_field(request, "file");
  const std::string path = scene_folder() + "/" + file;
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  const fs::path root = fs::weakly_canonical(scene_folder(), error);
  if (!lies_below(real.string(), root.string()))
    throw RequestError("outside", "the file is outside of the scene's folder");
  if (!open_regular(path)) throw RequestError("not-found", "there is no such file");
  std::vector<std::string> edits = history_.now();
  bool found = false;
  const scene::Scene& scene = loop.scene().scene();
  for (const scene::Element& element : scene.elements()) {
    const auto* texture = std::get_if<scene::Texture>(&element);
    if (!texture || (texture->name != wanted && texture->file != wanted)) continue;
    // Relative names start from the folder of the file that defines the texture.
    const fs::path from = texture->directory.empty() ? "." : texture->directory;
    const std::string written =
        real.lexically_relative(fs::weakly_canonical(fs::absolute(from, error), error))
            .generic_string();
    edits = interactive::with_edit(scene, std::move(edits), texture->name + ".file=" + written);
    found = true;
  }
  if (!found) throw RequestError("not-found", "there is no such texture");
  return try_edits(loop, std::move(edits), {});
}

json Controller::reload(Loop& loop, const json&) {
  if (!loop.read()) throw RequestError("failed", "the scene could not be read");
  loop.set_edits(history_.now());
  content_->forget();
  return edited(loop);
}

json Controller::save(Loop& loop, const json& request) {
  const std::string mode = text_field(request, "mode");
  const std::string file = optional_text(request, "file");
  if (!file.empty() && (!is_plain_name(file) || fs::path(file).extension() != ".mi"))
    throw RequestError("outside", "the file name is not a plain name with .mi");
  std::vector<std::string> files;
  if (mode == "incremental") {
    const std::string name =
        file.empty() ? fs::path(settings_.source.path).stem().string() + ".edits.mi" : file;
    interactive::save_incremental(loop.scene(), scene_folder() + "/" + name);
    files.push_back(name);
  } else if (mode == "mi") {
    files = interactive::save_into_files(loop.scene(), scene_folder());
    // The files contain the edits now; the scene is read again, so that places are right.
    const std::vector<std::string> written = history_.now();
    loop.set_edits({});
    const auto before =
        interactive::inverse_edits(loop.scene().scene(), written, loop.scene().registry());
    if (!loop.read()) throw RequestError("failed", "the saved scene could not be read");
    history_ = {};
    content_->save(written, before.value_or(std::vector<std::string>()));
    if (before && !before->empty()) {
      history_.replace(*before);
      history_.push({});
    }
    saved_.clear();
    if (journal_) journal_->write({});
    announce_state();
    return {{"files", files}};
  } else {
    throw RequestError("bad-request", "the mode is mi or incremental");
  }
  saved_ = history_.now();
  if (journal_) journal_->write({});
  announce_state();
  return {{"files", files}};
}

}  // namespace oriel::studio
