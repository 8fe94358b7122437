// SPDX-License-Identifier: Apache-2.0
#include "farm/references.h"

#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "farm/scene_calls.h"
#include "mi/codes.h"
#include "output/output_place.h"
#include "scene/asset_path.h"
#include "scene/element_settings.h"

namespace oriel::farm {
namespace {

namespace fs = std::filesystem;
using Kind = FileReference::Kind;

class FileFinder {
 public:
  FileFinder(const SceneSource& source, Diagnostics& diagnostics)
      : source_(source), diagnostics_(diagnostics) {
    folder_ = fs::path(source.path).parent_path().string();
  }

  SceneFiles run() {
    mi::ReadOptions options = source_.read;
    options.on_include = [this](const mi::IncludedFile& file) { add_include(file); };
    mi::Reader reader(source_.path, options, diagnostics_);
    if (!reader.opened()) throw std::runtime_error("cannot read '" + source_.path + "'");
    scene::Scene scene;
    while (reader.next_frame(scene)) {
      ++files_.frames;
      add_scene(scene);
    }
    if (files_.frames == 0) add_scene(scene);
    add_missing_includes();
    return std::move(files_);
  }

 private:
  void add(FileReference reference) {
    const SourceLocation& at = reference.where;
    if (seen_.emplace(diagnostics_.file(at.file), at.line, at.column, reference.written).second)
      files_.references.push_back(std::move(reference));
  }

  void add_include(const mi::IncludedFile& file) {
    included_[{diagnostics_.file(file.where.file), file.name}] = file.path;
    add({Kind::Include, file.name, file.path, {}, file.where});
  }

  /// Includes that the scene needs: the reader reports those as warnings, others as a note.
  void add_missing_includes() {
    for (const Diagnostic& d : diagnostics_.all()) {
      const bool missing = d.code == mi::code::kMissingInclude ||
                           d.code == mi::code::kForbiddenInclude || d.code == mi::code::kUnreadable;
      if (!missing || d.severity == Severity::Note) continue;
      const std::size_t begin = d.message.find('"'), end = d.message.find('"', begin + 1);
      if (end != std::string::npos)
        add({Kind::Include, d.message.substr(begin + 1, end - begin - 1), "", d.message, d.where});
    }
  }

  void add_scene(const scene::Scene& scene) {
    for (const scene::Element& element : scene.elements()) {
      if (const auto* texture = std::get_if<scene::Texture>(&element)) add_texture(*texture, scene);
      if (const auto* profile = std::get_if<scene::LightProfile>(&element))
        add_profile(*profile, scene);
      if (const auto* data = std::get_if<scene::UserData>(&element)) add_data(*data, scene);
      if (const auto* object = std::get_if<scene::Object>(&element)) add_placeholder(object->flags);
      if (const auto* part = std::get_if<scene::Assembly>(&element))
        add_placeholder(part->statements);
      if (const auto* options = std::get_if<scene::Options>(&element)) add_maps(*options);
    }
    const bool calls_users_shaders = calls_unknown(scene);
    for (const scene::Statement& command : scene.commands) {
      if (command.keyword == "link") add_libraries(command, calls_users_shaders);
      if (command.keyword == "code") add_code(command);
    }
    each_call(scene, [this](const scene::ShaderUse& call) {
      if (!call.type.empty() && !source_.read.knows_shader(call.type))
        for (const scene::Argument& argument : call.arguments) add_string(argument.value);
    });
  }

  void add_asset(Kind kind, const std::string& written, const std::string& directory,
                 SourceLocation where, int strings_before, const scene::Scene& scene) {
    const std::string path = scene::find_asset(written, directory, scene.files);
    const OpenFile file = scene.files.open(path, FileUse::Asset);
    add({kind, written, file ? path : "", file.reason(), where, strings_before});
  }

  void add_texture(const scene::Texture& texture, const scene::Scene& scene) {
    if (texture.pixels.empty() && !texture.file.empty())
      add_asset(Kind::Texture, texture.file, texture.directory, texture.where, 1, scene);
  }

  void add_profile(const scene::LightProfile& profile, const scene::Scene& scene) {
    for (const scene::Statement& s : profile.statements)
      if (s.keyword == "file" && !s.values.empty() && !s.values[0].text.empty())
        add_asset(Kind::Profile, s.values[0].text, profile.directory, s.where, 0, scene);
  }

  void add_data(const scene::UserData& data, const scene::Scene& scene) {
    if (data.file.empty()) return;
    const std::string path = (fs::path(data.directory) / data.file).string();
    const OpenFile file = scene.files.open(path, FileUse::Scene);
    add({Kind::UserData, data.file, file ? path : "", file.reason(), data.where, 1});
  }

  void add_placeholder(const std::vector<scene::Statement>& statements) {
    for (const scene::Statement& s : statements) {
      if (s.keyword != "file" || s.values.empty() || s.values[0].text.empty()) continue;
      const auto found = included_.find({diagnostics_.file(s.where.file), s.values[0].text});
      if (found != included_.end())
        add({Kind::Placeholder, s.values[0].text, found->second, {}, s.where});
    }
  }

  void add_maps(const scene::Options& options) {
    for (const scene::Statement& s : options.statements) {
      if (s.keyword != "photonmap file" && s.keyword != "finalgather file") continue;
      int before = 0;
      for (const scene::Value& value : s.values) {
        if (value.kind == scene::Value::Kind::Text && !value.bare)
          add_map(value.text, s.where, before++);
        for (const scene::Value& item : value.items) add_map(item.text, s.where, before++);
      }
    }
  }

  void add_map(const std::string& written, SourceLocation where, int before) {
    const std::string path = allowed_path(written, {folder_, {folder_}});
    std::error_code error;
    if (!path.empty() && fs::is_regular_file(path, error))
      add({Kind::Map, written, path, {}, where, before});
  }

  /// Whether the scene calls a shader that is not Oriel's.
  bool calls_unknown(const scene::Scene& scene) const {
    bool unknown = false;
    each_call(scene, [&](const scene::ShaderUse& call) {
      unknown |= !call.type.empty() && !source_.read.knows_shader(call.type) &&
                 !scene.find_phenomenon(call.type);
    });
    return unknown;
  }

  /// Scenes link the libraries of mental ray by habit: those that are missing matter only if the
  /// scene calls a shader that Oriel does not have.
  void add_libraries(const scene::Statement& command, bool calls_users_shaders) {
    for (const scene::Value& value : command.values) {
      const std::optional<std::string> path = source_.find_library(value.text);
      if (!path || (path->empty() && !calls_users_shaders)) continue;
      add({Kind::Library, value.text, *path,
           path->empty() ? "it is not in a folder of --shader-path or ORIEL_SHADER_PATH" : "",
           command.where});
    }
  }

  void add_code(const scene::Statement& command) {
    for (const scene::Value& value : command.values) {
      if (value.bare || value.text.empty()) continue;
      const fs::path path = fs::path(folder_) / scene::with_slashes(value.text);
      std::error_code error;
      const bool found = fs::is_regular_file(path, error);
      add({Kind::Code, value.text, found ? path.string() : "", {}, command.where});
    }
  }

  void add_string(const scene::Value& value) {
    if (value.kind == scene::Value::Kind::Text && !value.text.empty()) {
      const fs::path path = fs::path(folder_) / value.text;
      if (open_regular(path.string()))
        add({Kind::String, value.text, path.string(), {}, value.where});
    }
    for (const scene::Value& item : value.items) add_string(item);
    for (const scene::Argument& member : value.members) add_string(member.value);
  }

  const SceneSource& source_;
  Diagnostics& diagnostics_;
  std::string folder_;
  SceneFiles files_;
  std::map<std::pair<std::string, std::string>, std::string> included_;  // by file and name
  std::set<std::tuple<std::string, unsigned, unsigned, std::string>> seen_;
};

}  // namespace

SceneFiles find_files(const SceneSource& source, Diagnostics& diagnostics) {
  return FileFinder(source, diagnostics).run();
}

std::string_view kind_name(Kind kind) {
  switch (kind) {
    case Kind::Include:
      return "include";
    case Kind::Placeholder:
      return "placeholder";
    case Kind::Texture:
      return "texture";
    case Kind::Profile:
      return "light profile";
    case Kind::UserData:
      return "user data";
    case Kind::Map:
      return "map";
    case Kind::Library:
      return "shader library";
    case Kind::Code:
      return "C source";
    case Kind::String:
      return "string parameter";
  }
  return "file";
}

}  // namespace oriel::farm
