// SPDX-License-Identifier: Apache-2.0
// Pictures, command lines, final renders, uploads.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/durable_file.h"
#include "image/files.h"
#include "output/output.h"
#include "output/picture_metadata.h"
#include "scene/asset_path.h"
#include "studio/controller.h"
#include "studio/jobs.h"
#include "studio/json_values.h"
#include "studio/request_checks.h"
#include "studio/request_error.h"

namespace oriel::studio {
namespace {

using json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMaxUpload = std::size_t{256} << 20, kMaxResult = std::size_t{1} << 30;
constexpr std::size_t kResults = 8;

/// A private folder for files of one request, removed at the end.
class WorkFolder {
 public:
  WorkFolder() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "oriel-studio-XXXXXX").string();
    if (!mkdtemp(name.data())) throw RequestError("failed", "there is no temporary folder");
    path_ = name;
  }
  ~WorkFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string content(const std::string& path) {
  OpenFile file = open_regular(path);
  if (!file) throw RequestError("failed", "the picture could not be read");
  if (file.size() > kMaxResult) throw RequestError("too-large", "the picture is too large");
  return file.read(kMaxResult);
}

/// The options of `oriel tonemap` that a client may give; all take values, none names a file.
std::vector<std::string> tone_words(const std::string& text) {
  constexpr std::array<std::string_view, 18> kOptions = {
      "--iso",    "--shutter",    "--f-number", "--cm2",         "--whitepoint", "--burn",
      "--crush",  "--view",       "--gain",     "--saturation",  "--gamma",      "--pedestal",
      "--simple", "--vignetting", "--knee",     "--compression", "--knee-curve", "--fov"};
  std::istringstream words(text);
  std::vector<std::string> result;
  for (std::string word; words >> word;) {
    const bool is_option = word.starts_with("--");
    const std::string name = word.substr(0, word.find('='));
    if (is_option && std::find(kOptions.begin(), kOptions.end(), name) == kOptions.end())
      throw RequestError("bad-request", "unknown option of tone: " + name);
    const bool is_value = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == ',' || c == '-' ||
             c == '=' || c == '_' || c == '+';
    });
    if (!is_value || (!is_option && result.empty()))
      throw RequestError("bad-request", "unexpected word in tone: " + word);
    result.push_back(word);
  }
  return result;
}

std::string quoted_word(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("._-/=,:+").find(c) != std::string_view::npos;
  });
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

ApiAnswer api_error(unsigned status, const std::string& code, const std::string& message) {
  const json body = {{"type", "error"}, {"code", code}, {"message", message}};
  return {status, "application/json; charset=utf-8",
          std::make_shared<const std::string>(dumped(body))};
}

void remove_option(std::vector<std::string>& words, std::string_view name) {
  const auto found = std::find(words.begin(), words.end(), name);
  if (found != words.end()) words.erase(found, found + 2);
}

/// The words of the present picture with what the request of a final render replaces. A final
/// render has the whole picture.
std::vector<std::string> job_words(std::vector<std::string> words, const json& request) {
  const auto option = [&](const char* name, const std::string& value) {
    remove_option(words, name);
    words.insert(words.end(), {name, value});
  };
  remove_option(words, "--crop");
  if (const auto n = optional_number(request, "samples"))
    option("--samples", std::to_string(static_cast<long>(*n)));
  if (const auto n = optional_number(request, "noise")) option("--noise", fmt::format("{}", *n));
  if (const auto n = optional_number(request, "seconds")) option("--time", fmt::format("{}", *n));
  if (const auto size = request.find("size"); size != request.end() && size->is_array()) {
    const bool is_size = size->size() == 2 && (*size)[0].is_number() && (*size)[1].is_number();
    if (!is_size) throw RequestError("bad-request", "the field \"size\" has a wrong form");
    const auto side = [&](std::size_t i) {
      return std::clamp((*size)[i].get<double>(), 1.0, 65536.0);
    };
    option("--size", fmt::format("{:.0f}x{:.0f}", side(0), side(1)));
  }
  if (const std::string camera = optional_text(request, "camera"); !camera.empty())
    option("--camera", camera);
  if (request.contains("layers")) {
    // Without names of the page that are no layers of files, such as that of the denoised picture.
    std::vector<std::string> layers = texts_field(request, "layers");
    std::erase_if(layers, [](const std::string& name) { return LayerSet(name).empty(); });
    if (!layers.empty()) option("--layers", fmt::format("{}", fmt::join(layers, ",")));
  }
  if (request.contains("denoise") && request["denoise"] == true) words.emplace_back("--denoise");
  return words;
}

}  // namespace

std::vector<std::string> Controller::render_words(Loop& loop) const {
  const interactive::ViewSettings& view = loop.view();
  std::vector<std::string> words = {"render", settings_.source.path};
  words.insert(words.end(), services_.options.begin(), services_.options.end());
  for (const std::string& edit : history_.now()) words.insert(words.end(), {"--set", edit});
  if (const auto edit = camera_edit(loop)) words.insert(words.end(), {"--set", *edit});
  for (const scene::LightGroup& group : loop.scene().light_groups(view))
    words.insert(words.end(), {"--light-group",
                               fmt::format("{}={}", group.name, fmt::join(group.patterns, ","))});
  if (!view.camera.empty()) words.insert(words.end(), {"--camera", view.camera});
  if (view.size)
    words.insert(words.end(), {"--size", fmt::format("{}x{}", (*view.size)[0], (*view.size)[1])});
  if (view.region && view.scale == 1) {
    const auto [width, height] = loop.full_size();
    const Window w = interactive::reduced_window(view.region, 1, width, height);
    words.insert(words.end(),
                 {"--crop", fmt::format("{},{},{},{}", w.x0, w.y0, w.x1 - 1, w.y1 - 1)});
  }
  if (view.budget.samples)
    words.insert(words.end(), {"--samples", std::to_string(*view.budget.samples)});
  if (view.budget.noise)
    words.insert(words.end(), {"--noise", fmt::format("{}", *view.budget.noise)});
  if (settings_.loop.seed != 0)
    words.insert(words.end(), {"--seed", std::to_string(settings_.loop.seed)});
  return words;
}

json Controller::command(Loop& loop, const json&) {
  std::string text = "oriel";
  for (const std::string& word : render_words(loop)) text += " " + quoted_word(word);
  return {{"text", text}};
}

std::uint64_t Controller::keep_result(std::string bytes, std::string type) {
  const std::scoped_lock lock(results_mutex_);
  results_.push_back(
      {next_result_, std::move(type), std::make_shared<const std::string>(std::move(bytes))});
  if (results_.size() > kResults) results_.erase(results_.begin());
  return next_result_++;
}

json Controller::deliver(Loop& loop, const json& request) {
  const std::string kind = text_field(request, "kind");
  const std::vector<std::string> tone = tone_words(optional_text(request, "tone"));
  if (kind != "png" && kind != "exr") throw RequestError("bad-request", "the kind is png or exr");
  const RenderSession* session = loop.session();
  if (!session || session->film().mean_samples() < 1)
    throw RequestError("failed", "there is no full-size picture yet");
  const WorkFolder folder;
  PictureFile file = picture_file(folder.file(kind == "png" ? "picture.png" : "picture.exr"));
  file.shaders = loop.scene().output_shaders();
  if (kind == "exr") {
    for (const std::string& name : loop.view().layers) file.layers |= LayerSet(name);
  } else if (!tone.empty()) {
    file = picture_file(folder.file("linear.exr"));
    file.unmapped = true;
  }
  write_picture(file, *session, picture_metadata(session->world(), file.shaders));
  std::string path = file.path;
  if (kind == "png" && !tone.empty()) {
    std::vector<std::string> words = {services_.program, "tonemap", path, "-o",
                                      folder.file("picture.png")};
    words.insert(words.end(), tone.begin(), tone.end());
    path = folder.file("picture.png");
    if (run_program(words) != 0)
      throw RequestError("failed", "oriel tonemap does not accept these options");
  }
  std::string bytes = content(path);
  const std::size_t size = bytes.size();
  const std::uint64_t number =
      keep_result(std::move(bytes), kind == "png" ? "image/png" : "image/x-exr");
  return {{"result", number}, {"url", "/api/result/" + std::to_string(number)}, {"bytes", size}};
}

json Controller::job(Loop& loop, const json& request) {
  const std::string action = text_field(request, "action");
  if (action == "start") {
    if (job_ &&
        (job_->state() == RenderJob::State::Running || job_->state() == RenderJob::State::Paused))
      throw RequestError("busy", "a final render is running");
    const std::string file = text_field(request, "file");
    const std::string suffix = fs::path(file).extension().string();
    if (!is_plain_name(file) || (suffix != ".exr" && suffix != ".png"))
      throw RequestError("outside", "the file name is not a plain name with .exr or .png");
    const std::string path = scene_folder() + "/" + file;
    std::vector<std::string> words = job_words(render_words(loop), request);
    words.insert(words.begin(), services_.program);
    words.insert(words.end(), {"--json", "-o", path});
    job_.reset();
    job_ = std::make_unique<RenderJob>(words, path + ".checkpoint", file,
                                       [this](const json& message) { send(message); });
  } else if (!job_) {
    throw RequestError("not-found", "there is no final render");
  } else if (action == "pause") {
    job_->pause();
  } else if (action == "resume") {
    job_->resume();
  } else if (action == "cancel") {
    job_->cancel();
  } else {
    throw RequestError("bad-request", "unknown action");
  }
  return {{"state", name_of(job_->state())}};
}

std::size_t Controller::max_body(const std::string& path) const {
  return path == "/upload" ? kMaxUpload : 64 * 1024;
}

ApiAnswer Controller::api(ApiRequest request) {
  if (request.path == "/upload" && request.post) return upload(request);
  const auto found = [&](std::string_view folder, const std::vector<Result>& files) -> ApiAnswer {
    if (request.post || !request.path.starts_with(folder)) return {404, {}, nullptr};
    const std::string number = request.path.substr(folder.size());
    for (const Result& result : files)
      if (std::to_string(result.number) == number) return {200, result.type, result.bytes};
    return {404, {}, nullptr};
  };
  const std::scoped_lock lock(results_mutex_);
  for (ApiAnswer& answer :
       std::array{found("/result/", results_), found("/thumbnail/", thumbnails_)})
    if (answer.body) return std::move(answer);
  return api_error(404, "not-found", "there is nothing of that name");
}

ApiAnswer Controller::upload(const ApiRequest& request) const {
  const std::string name = query_value(request.query, "name");
  if (!is_plain_name(name)) return api_error(400, "outside", "the file name is not a plain name");
  std::string suffix = fs::path(name).extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::array<std::string_view, 12> kTypes = {".png", ".jpg",  ".jpeg", ".exr",
                                                       ".hdr", ".tif",  ".tiff", ".tga",
                                                       ".bmp", ".webp", ".ies",  ".tx"};
  if (std::find(kTypes.begin(), kTypes.end(), suffix) == kTypes.end())
    return api_error(400, "bad-request", "the file is of no type of a texture or light profile");
  const fs::path folder = fs::path(scene_folder()) / "textures";
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path root = fs::weakly_canonical(scene_folder(), error);
  if (!lies_below(fs::weakly_canonical(folder, error).string(), root.string()))
    return api_error(403, "outside", "the folder of textures leads out of the scene's folder");
  fs::path path = folder / name;
  const std::string stem = fs::path(name).stem().string();
  for (int i = 2; fs::exists(fs::symlink_status(path, error)); ++i) {
    OpenFile old = open_regular(path.string());
    if (old && old.size() == request.body.size() && old.read(kMaxUpload) == request.body) break;
    path = folder / fmt::format("{}-{}{}", stem, i, fs::path(name).extension().string());
    if (i > 1000) return api_error(400, "failed", "too many files of that name");
  }
  try {
    if (!fs::exists(path, error)) write_durably(path.string(), request.body);
  } catch (const std::runtime_error& failed) {
    return api_error(400, "failed", failed.what());
  }
  const json body = {{"file", "textures/" + path.filename().string()}};
  return {200, "application/json; charset=utf-8",
          std::make_shared<const std::string>(dumped(body))};
}

}  // namespace oriel::studio
