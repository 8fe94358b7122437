// SPDX-License-Identifier: Apache-2.0
#include "studio/describe.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "interactive/element_statements.h"
#include "interactive/structured_value.h"
#include "scene/asset_path.h"
#include "studio/json_values.h"

namespace oriel::studio {
namespace {

using json = nlohmann::json;

constexpr std::size_t kMaxListed = 20'000;
constexpr int kMaxConnections = 6;

const char* support_name(Support support) {
  constexpr const char* kNames[] = {"exact", "approximated", "ignored"};
  return kNames[static_cast<int>(support)];
}

std::string type_name_of(const ParamSpec& p) {
  const std::string name(scene::type_name(p.type == ParamType::Array ? p.element : p.type));
  return p.type == ParamType::Array ? "array " + name : name;
}

json default_of(const ParamSpec& p) {
  const auto& v = p.fallback;
  switch (p.type) {
    case ParamType::Boolean:
      return v[0] != 0;
    case ParamType::Integer:
    case ParamType::Scalar:
      return v[0];
    case ParamType::Color:
    case ParamType::Vector:
      return {v[0], v[1], v[2]};
    case ParamType::String:
      return p.text ? p.text : "";
    default:
      return nullptr;
  }
}

json declaration_json(const ParamSpec& p) {
  json param = {{"name", p.name}, {"type", type_name_of(p)}, {"support", support_name(p.support)}};
  if (const json value = default_of(p); !value.is_null()) param["default"] = value;
  if (std::isfinite(p.min)) param["min"] = p.min;
  if (std::isfinite(p.max)) param["max"] = p.max;
  if (*p.unit) param["unit"] = p.unit;
  if (*p.doc) param["doc"] = p.doc;
  return param;
}

json declaration_json(const scene::ParamDecl& p) {
  json param = {{"name", p.name}, {"type", std::string(scene::type_name(p.type))}};
  if (p.default_value) param["default"] = json_of(*p.default_value);
  return param;
}

/// Collects the description of one element.
class ElementReport {
 public:
  ElementReport(const scene::Scene& scene, const Registry& registry,
                const std::vector<std::string>& edits)
      : scene_(scene), registry_(registry), edits_(edits) {}

  void add_list(const scene::ShaderList& list, const std::string& owner, const char* slot, json& to,
                int depth = 0) const {
    for (const scene::ShaderUse& use : list) {
      if (!use.reference.empty()) {
        const auto* named = scene_.get<scene::ShaderElement>(use.reference);
        if (named && depth < kMaxConnections)
          add_list(named->functions, use.reference, slot, to, depth + 1);
        continue;
      }
      json shader = call_json(use, owner, depth);
      shader["slot"] = slot;
      to.push_back(std::move(shader));
    }
  }

  json call_json(const scene::ShaderUse& use, const std::string& owner, int depth) const {
    json shader = {{"shader", use.type}, {"owner", owner}, {"parameters", json::array()}};
    if (const ShaderSpec* spec = registry_.find(use.type)) {
      shader["doc"] = spec->doc;
      for (const ParamSpec& p : spec->params)
        shader["parameters"].push_back(parameter(declaration_json(p), use, owner, depth));
    } else if (const scene::ShaderDeclaration* declared = declaration(use.type)) {
      for (const scene::ParamDecl& p : declared->parameters)
        shader["parameters"].push_back(parameter(declaration_json(p), use, owner, depth));
    }
    return shader;
  }

  void add_statements(const scene::Element& element, json& to) const {
    const std::vector<interactive::StatementValue> statements = interactive::statements_of(element);
    if (statements.empty()) return;
    json list = json::array();
    const std::string& owner = scene::name_of(element);
    for (const interactive::StatementValue& s : statements) {
      json p = {{"name", s.name}, {"set", owner + "." + s.name}, {"type", type_of(s)}};
      if (!s.form.empty()) p["form"] = std::string(s.form);
      if (!s.meaning.empty()) p["doc"] = std::string(s.meaning);
      if (s.values.size() == 1) p["value"] = json_of(s.values[0]);
      if (is_edited(owner + "." + s.name)) p["edited"] = true;
      list.push_back(std::move(p));
    }
    to.insert(to.begin(), {{"shader", ""}, {"slot", "statements"}, {"parameters", list}});
  }

 private:
  const scene::ShaderDeclaration* declaration(const std::string& type) const {
    if (const scene::Phenomenon* phenomenon = scene_.find_phenomenon(type))
      return &phenomenon->declaration;
    return scene_.find_declaration(type);
  }

  static const char* type_of(const interactive::StatementValue& s) {
    if (s.form == "bool") return "boolean";
    if (s.form == "int") return "integer";
    if (s.form == "float") return "scalar";
    if (s.name == "origin" || s.name == "direction") return "vector";
    if (s.name == "transform") return "transform";
    if (s.form.empty() && s.name != "file" && s.name != "resolution") return "scalar";
    return "string";
  }

  bool is_edited(const std::string& target) const {
    return std::any_of(edits_.begin(), edits_.end(),
                       [&](const std::string& e) { return e.starts_with(target + "="); });
  }

  json parameter(json p, const scene::ShaderUse& use, const std::string& owner, int depth) const {
    const std::string name = p["name"];
    p["set"] = owner + "." + name;
    if (is_edited(p["set"])) p["edited"] = true;
    for (const scene::Argument& argument : use.arguments) {
      if (argument.name != name) continue;
      const scene::Value& value = argument.value;
      const bool by_name =
          value.kind == scene::Value::Kind::Connection || value.kind == scene::Value::Kind::Text;
      if (const json v = json_of(value); !v.is_null()) p["value"] = v;
      if (value.kind == scene::Value::Kind::Array || value.kind == scene::Value::Kind::Struct)
        p["text"] = interactive::structured_text(value);
      if (by_name && depth < kMaxConnections) connect(p, value.text, depth);
    }
    return p;
  }

  void connect(json& p, const std::string& text, int depth) const {
    const std::string name = text.substr(0, text.find('.'));
    const scene::Element* element = scene_.find(text);
    if (!element) element = scene_.find(name);
    if (!element) return;
    if (const auto* texture = std::get_if<scene::Texture>(element)) {
      p["connection"] = {
          {"name", texture->name}, {"shader", ""}, {"texture", true}, {"file", texture->file}};
    } else if (const auto* shader = std::get_if<scene::ShaderElement>(element);
               shader && !shader->functions.empty()) {
      json connection = call_json(shader->functions.back(), shader->name, depth + 1);
      connection["name"] = shader->name;
      p["connection"] = std::move(connection);
    }
  }

  const scene::Scene& scene_;
  const Registry& registry_;
  const std::vector<std::string>& edits_;
};

std::string first_type(const scene::Scene& scene, const scene::ShaderList& list, int depth = 0) {
  for (auto use = list.rbegin(); use != list.rend(); ++use) {
    if (use->reference.empty()) return use->type;
    const auto* named = scene.get<scene::ShaderElement>(use->reference);
    if (named && depth < kMaxConnections) return first_type(scene, named->functions, depth + 1);
  }
  return {};
}

void push_limited(json& outline, const char* list, json entry) {
  if (outline[list].size() < kMaxListed)
    outline[list].push_back(std::move(entry));
  else
    outline["cut"] = true;
}

void outline_instance(const scene::Scene& scene, const scene::Instance& instance, json& outline) {
  const scene::Element* element = scene.find(instance.element);
  if (element && std::holds_alternative<scene::Camera>(*element)) {
    push_limited(outline, "cameras", {{"name", instance.element}, {"instance", instance.name}});
  } else if (const auto* light = element ? std::get_if<scene::Light>(element) : nullptr) {
    const char* kind = light->area                          ? "area"
                       : light->direction && !light->origin ? "directional"
                       : light->direction                   ? "spot"
                                                            : "point";
    push_limited(outline, "lights",
                 {{"name", light->name},
                  {"instance", instance.name},
                  {"shader", first_type(scene, light->shaders)},
                  {"kind", kind}});
  } else {
    push_limited(outline, "instances", {{"name", instance.name}, {"item", instance.element}});
  }
}

const char* kind_of(const scene::Element& element) {
  constexpr const char* kNames[] = {"options",  "camera",   "light",        "material", "texture",
                                    "profile",  "object",   "instance",     "group",    "shader",
                                    "assembly", "userdata", "uninterpreted"};
  return kNames[element.index()];
}

}  // namespace

/// Materials of the scene's main file come first: included files may be large libraries.
void outline_materials(const scene::Scene& scene, json& outline) {
  const std::uint32_t main_file = scene.renders.empty() ? 0 : scene.renders.back().where.file;
  for (const bool main : {true, false})
    for (const scene::Element& element : scene.elements()) {
      const auto* material = std::get_if<scene::Material>(&element);
      if (!material || (material->where.file == main_file) != main) continue;
      push_limited(outline, "materials",
                   {{"name", material->name}, {"shader", first_type(scene, material->shaders)}});
    }
}

json outline_json(const scene::Scene& scene) {
  json outline;
  for (const char* list :
       {"materials", "lights", "cameras", "instances", "textures", "shaders", "options"})
    outline[list] = json::array();
  bool daylight = false;
  outline_materials(scene, outline);
  for (const scene::Element& element : scene.elements()) {
    if (const auto* instance = std::get_if<scene::Instance>(&element))
      outline_instance(scene, *instance, outline);
    if (const auto* texture = std::get_if<scene::Texture>(&element)) {
      const bool missing =
          !texture->file.empty() &&
          !open_regular(scene::find_asset(texture->file, texture->directory, scene.files));
      push_limited(outline, "textures",
                   {{"name", texture->name}, {"file", texture->file}, {"missing", missing}});
    }
    if (const auto* shader = std::get_if<scene::ShaderElement>(&element)) {
      const std::string type = first_type(scene, shader->functions);
      daylight |= type == "mia_physicalsky" || type == "mia_ciesky";
      push_limited(outline, "shaders", {{"name", shader->name}, {"shader", type}});
    }
    if (const auto* light = std::get_if<scene::Light>(&element))
      daylight |= first_type(scene, light->shaders) == "mia_physicalsun";
    if (const auto* options = std::get_if<scene::Options>(&element))
      push_limited(outline, "options", options->name);
  }
  outline["daylight"] = daylight;
  return outline;
}

json element_json(const scene::Scene& scene, const Diagnostics& files, const std::string& name,
                  const Registry& registry, const std::vector<std::string>& edits) {
  const scene::Element* element = scene.find(name);
  if (!element) return nullptr;
  const SourceLocation where = scene::place_of(*element);
  json result = {{"name", name},
                 {"kind", kind_of(*element)},
                 {"file", files.file(where.file)},
                 {"line", where.line},
                 {"shaders", json::array()}};
  const ElementReport report(scene, registry, edits);
  json& shaders = result["shaders"];
  if (const auto* material = std::get_if<scene::Material>(element)) {
    report.add_list(material->shaders, name, "surface", shaders);
    for (const scene::Material::Slot& slot : material->slots)
      report.add_list(slot.shaders, name, slot.keyword.c_str(), shaders);
  } else if (const auto* light = std::get_if<scene::Light>(element)) {
    report.add_list(light->shaders, name, "light", shaders);
  } else if (const auto* shader = std::get_if<scene::ShaderElement>(element)) {
    report.add_list(shader->functions, name, "shader", shaders);
  } else if (const auto* camera = std::get_if<scene::Camera>(element)) {
    report.add_list(camera->lens, name, "lens", shaders);
    report.add_list(camera->volume, name, "volume", shaders);
    report.add_list(camera->environment, name, "environment", shaders);
  } else if (const auto* texture = std::get_if<scene::Texture>(element)) {
    report.add_list(texture->procedure, name, "texture", shaders);
  }
  report.add_statements(*element, shaders);
  return result;
}

json shader_json(const Registry& registry, const std::string& name) {
  const ShaderSpec* spec = registry.find(name);
  if (!spec) return nullptr;
  json parameters = json::array();
  for (const ParamSpec& p : spec->params) parameters.push_back(declaration_json(p));
  return {{"name", spec->name},
          {"doc", spec->doc},
          {"library", spec->library},
          {"version", spec->version},
          {"result", std::string(scene::type_name(spec->result))},
          {"parameters", parameters}};
}

}  // namespace oriel::studio
