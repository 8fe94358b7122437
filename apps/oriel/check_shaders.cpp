// SPDX-License-Identifier: Apache-2.0
#include "check_shaders.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "scene/asset_path.h"
#include "shaders/registry.h"

namespace oriel::app {
namespace {

using nlohmann::json;
using scene::Value;

/// Longer values are cut: a report is read by people.
constexpr std::size_t kMaxValueText = 80;

struct Use {
  int count = 0;
  std::string value;
  SourceLocation where;
};

/// Calls of one type, and what they write.
struct Type {
  int calls = 0;
  bool shows = false;  ///< some call makes a colour that the picture shows
  SourceLocation where;
  std::map<std::string, Use> arguments;
};

std::string value_text(const Value& value) {
  std::string text;
  switch (value.kind) {
    case Value::Kind::Null:
      return "null";
    case Value::Kind::Boolean:
      return value.boolean ? "on" : "off";
    case Value::Kind::Numbers:
      for (const double n : value.numbers)
        if (text.size() < kMaxValueText) text += fmt::format("{}{:g}", text.empty() ? "" : " ", n);
      break;
    case Value::Kind::Text:
      text = fmt::format("\"{}\"", value.text);
      break;
    case Value::Kind::Connection:
      text = fmt::format("= \"{}\"", value.text);
      break;
    case Value::Kind::Interface:
      text = fmt::format("= interface \"{}\"", value.text);
      break;
    case Value::Kind::Struct:
      return fmt::format("{{ {} members }}", value.members.size());
    case Value::Kind::Array:
      return fmt::format("[ {} values ]", value.items.size());
  }
  if (text.size() > kMaxValueText) text = text.substr(0, kMaxValueText) + "...";
  return text;
}

/// All calls of a scene, by type.
class Uses {
 public:
  explicit Uses(const scene::Scene& scene) {
    for (const scene::Element& element : scene.elements())
      std::visit([&](const auto& e) { take(e); }, element);
    for (const scene::Phenomenon& p : scene.phenomena) {
      for (const auto& shader : p.shaders) take(shader);
      for (const auto& material : p.materials) take(material);
      for (const auto& light : p.lights) take(light);
      for (const auto& root : p.roots) take(root.shaders);
    }
    for (const scene::Element& element : scene.elements()) {
      if (const auto* m = std::get_if<scene::Material>(&element)) show(scene, m->shaders);
      if (const auto* t = std::get_if<scene::Texture>(&element)) show(scene, t->procedure);
      if (const auto* c = std::get_if<scene::Camera>(&element)) show(scene, c->environment);
    }
    for (const scene::Phenomenon& p : scene.phenomena) {
      for (const auto& shader : p.shaders) show(scene, shader.functions);
      for (const auto& material : p.materials) show(scene, material.shaders);
      for (const auto& root : p.roots) show(scene, root.shaders);
    }
  }
  const std::map<std::string, Type>& types() const { return types_; }

 private:
  void take(const scene::ShaderList& list) {
    for (const scene::ShaderUse& use : list) {
      if (!use.reference.empty()) continue;
      Type& type = types_[use.type];
      if (type.calls++ == 0) type.where = use.where;
      for (const scene::Argument& argument : use.arguments) {
        Use& written = type.arguments[argument.name];
        if (written.count++ == 0)
          written.value = value_text(argument.value), written.where = argument.where;
      }
    }
  }
  /// Marks the types of a list, and of what is connected to it, as seen.
  void show(const scene::Scene& scene, const scene::ShaderList& list) {
    for (const scene::ShaderUse& use : list) {
      if (!use.reference.empty()) show_named(scene, use.reference);
      if (const auto type = types_.find(use.type); type != types_.end()) type->second.shows = true;
      for (const scene::Argument& argument : use.arguments) show_value(scene, argument.value);
    }
  }
  void show_value(const scene::Scene& scene, const Value& value) {
    if (value.kind == Value::Kind::Connection || value.kind == Value::Kind::Text)
      show_named(scene, value.text);
    for (const Value& item : value.items) show_value(scene, item);
    for (const scene::Argument& member : value.members) show_value(scene, member.value);
  }
  void show_named(const scene::Scene& scene, const std::string& name) {
    const auto* element = scene.get<scene::ShaderElement>(name);
    if (!element) element = scene.get<scene::ShaderElement>(name.substr(0, name.rfind('.')));
    if (element && shown_.insert(element->name).second) show(scene, element->functions);
  }
  void take(const scene::Options& o) { take(o.state); }
  void take(const scene::Camera& c) {
    for (const scene::ShaderList* list : {&c.lens, &c.volume, &c.environment}) take(*list);
    for (const scene::Output& o : c.outputs) take(o.shaders);
  }
  void take(const scene::Light& l) { take(l.shaders), take(l.emitters); }
  void take(const scene::Material& m) {
    take(m.shaders);
    for (const auto& slot : m.slots) take(slot.shaders);
  }
  void take(const scene::Texture& t) { take(t.procedure); }
  void take(const scene::Instance& i) { take(i.geometry), take(i.transform_shaders); }
  void take(const scene::ShaderElement& s) { take(s.functions); }
  template <class Other>
  void take(const Other&) {}

  std::map<std::string, Type> types_;
  std::set<std::string> shown_;
};

void set_place(const SourceLocation& where, const Diagnostics& diagnostics, json& entry) {
  if (!where.line) return;
  entry["file"] = diagnostics.file(where.file);
  entry["line"] = where.line;
}

const ParamSpec* find_parameter(const ShaderSpec& spec, const std::string& name) {
  for (const ParamSpec& p : spec.params)
    if (name == p.name || (p.alias && name == p.alias)) return &p;
  return nullptr;
}

/// How one parameter of a built-in shader is followed.
void judge(const ShaderSpec& spec, const std::string& name, json& entry) {
  constexpr const char* kSupports[] = {"exact", "approximated", "ignored"};
  const ParamSpec* p = find_parameter(spec, name);
  if (!p) {
    std::vector<std::string> names;
    for (const ParamSpec& known : spec.params) names.emplace_back(known.name);
    const std::string near = nearest_name(name, names);
    entry["support"] = "unknown";
    entry["reason"] = near.empty() ? std::string("the shader has no such parameter")
                                   : fmt::format(
                                         "the shader has no such parameter; \"{}\" is the "
                                         "nearest",
                                         near);
    return;
  }
  entry["support"] = kSupports[static_cast<int>(p->support)];
  if (p->support != Support::Exact) entry["reason"] = p->doc;
}

std::string worst_of(const json& parameters, bool is_fallback) {
  std::string worst = is_fallback ? "approximated" : "exact";
  for (const json& p : parameters) {
    if (p["support"] == "ignored" || p["support"] == "unknown") return "ignored";
    if (p["support"] == "approximated") worst = "approximated";
  }
  return worst;
}

/// What the type is, where it is none of the built-in ones.
void judge_foreign(const CheckedScene& c, const std::string& type, bool shows, json& entry) {
  if (c.scene.find_phenomenon(type)) {
    entry["status"] = "phenomenon";
    entry["note"] = "defined in the scene; its shaders are listed separately";
  } else if (c.host.registry().find(type)) {
    entry["status"] = "native";
    entry["note"] = "of a C library that is linked and trusted";
  } else if (const auto guess = c.binding.guessed.find(type); guess != c.binding.guessed.end()) {
    entry["status"] = "guessed";
    entry["note"] = "not available; guessed from the names of its parameters: " + guess->second;
    for (json& p : entry["parameters"])
      if (guess->second.find('"' + p["name"].get<std::string>() + '"') != std::string::npos)
        p["support"] = "approximated", p["reason"] = "the guess uses it";
  } else {
    std::vector<std::string> names;
    for (const ShaderSpec* spec : c.builtin.all()) names.emplace_back(spec->name);
    const std::string near = nearest_name(type, names);
    entry["status"] = "unknown";
    entry["magenta"] = shows;
    entry["note"] =
        std::string(shows ? "not available; shown magenta" : "not available; it has no effect") +
        (near.empty() ? std::string() : fmt::format(". The nearest is \"{}\"", near)) +
        ". Link the C library that has it, or replace it";
  }
}

}  // namespace

json used_shaders(const CheckedScene& c) {
  json list = json::array();
  const Uses uses(c.scene);
  for (const auto& [name, type] : uses.types()) {
    json entry = {{"type", name}, {"calls", type.calls}, {"parameters", json::array()}};
    set_place(type.where, c.diagnostics, entry);
    const ShaderSpec* spec = c.builtin.find(name);
    for (const auto& [parameter, use] : type.arguments) {
      json p = {{"name", parameter}, {"count", use.count}, {"value", use.value}};
      set_place(use.where, c.diagnostics, p);
      if (spec)
        judge(*spec, parameter, p);
      else
        p["support"] =
            c.host.registry().find(name) || c.scene.find_phenomenon(name) ? "exact" : "unknown";
      entry["parameters"].push_back(std::move(p));
    }
    if (!spec) {
      judge_foreign(c, name, type.shows, entry);
    } else {
      entry["status"] = worst_of(entry["parameters"], spec->fallback.is_fallback);
      entry["library"] = spec->library;
      entry["doc"] = spec->doc;
      entry["fallback"] = spec->fallback.is_fallback;
      if (spec->fallback.is_fallback)
        entry["note"] = "replaces a shader of another program; based on its public description";
    }
    list.push_back(std::move(entry));
  }
  return list;
}

json used_textures(const CheckedScene& c) {
  const std::set<std::string> missing(c.binding.missing_textures.begin(),
                                      c.binding.missing_textures.end());
  json list = json::array();
  for (const scene::Element& element : c.scene.elements()) {
    const auto* t = std::get_if<scene::Texture>(&element);
    if (!t || t->file.empty()) continue;
    const FileAccess& files = c.scene.files;
    const bool exists =
        bool(files.open(scene::find_asset(t->file, t->directory, files), FileUse::Asset));
    const char* state = missing.count(t->file) > 0 ? "missing" : exists ? "found" : "unused";
    json entry = {{"name", t->name}, {"written", t->file}, {"state", state}};
    set_place(t->where, c.diagnostics, entry);
    list.push_back(std::move(entry));
  }
  return list;
}

json used_libraries(const CheckedScene& c) {
  const auto stem = [](const std::string& path) {
    return std::filesystem::path(path.substr(path.find_last_of("/\\") + 1)).stem().string();
  };
  // What is built in stands for those libraries, and no file of theirs is looked for.
  const auto& own = builtin_packages();
  json list = json::array();
  for (const scene::Statement& command : c.scene.commands) {
    if (command.keyword != "link") continue;
    for (const scene::Value& value : command.values) {
      if (std::find(own.begin(), own.end(), stem(value.text)) != own.end()) continue;
      json entry = {{"written", value.text}, {"found", false}};
      set_place(command.where, c.diagnostics, entry);
      for (const auto& library : c.host.libraries())
        if (library->path().stem() == stem(value.text))
          entry["found"] = true, entry["path"] = library->path().string();
      list.push_back(std::move(entry));
    }
  }
  return list;
}

}  // namespace oriel::app
