// SPDX-License-Identifier: Apache-2.0
// Reports undefined names after a `render`.
#include <fmt/format.h>

#include <algorithm>

#include "mi/elements.h"

namespace oriel::mi {
namespace {

using scene::ShaderList;
using scene::Value;

class Resolver {
 public:
  explicit Resolver(Parse& parse) : parse_(parse), scene_(*parse.scene) {}
  void element(const scene::Element& element);
  void phenomenon(const scene::Phenomenon& phenomenon);
  void render(const scene::RenderCommand& render);

 private:
  void name(std::string_view what, const std::string& name, SourceLocation at, bool fatal = false);
  void names(std::string_view what, const std::vector<std::string>& list, SourceLocation at) {
    for (const std::string& n : list) name(what, n, at);
  }
  void shader_type(const scene::ShaderUse& use);
  void list(const ShaderList& shaders);
  void value(const Value& value);
  void connection(const std::string& name, SourceLocation at);
  bool exists(std::string_view name) const;

  void visit(const scene::Options&) {}
  void visit(const scene::LightProfile&) {}
  void visit(const scene::UninterpretedElement&) {}
  void visit(const scene::Assembly&) {}
  void visit(const scene::UserData&) {}
  void visit(const scene::ShaderElement& e) { list(e.functions); }
  void visit(const scene::Texture& e) { list(e.procedure); }
  void visit(const scene::Camera& e);
  void visit(const scene::Light& e);
  void visit(const scene::Material& e);
  void visit(const scene::Object& e);
  void visit(const scene::Instance& e);
  void visit(const scene::InstanceGroup& e) { names("instance", e.members, e.where); }

  Parse& parse_;
  const scene::Scene& scene_;
  const scene::Phenomenon* local_ = nullptr;  // names inside a phenomenon have precedence
};

bool Resolver::exists(std::string_view wanted) const {
  const auto among = [&](const auto& elements) {
    return std::any_of(elements.begin(), elements.end(),
                       [&](const auto& e) { return e.name == wanted; });
  };
  if (local_ && (among(local_->shaders) || among(local_->materials) || among(local_->lights) ||
                 among(local_->instances)))
    return true;
  return scene_.find(wanted) != nullptr;
}

void Resolver::name(std::string_view what, const std::string& wanted, SourceLocation at,
                    bool fatal) {
  if (wanted.empty() || exists(wanted)) return;
  if (!parse_.reported.insert(fmt::format("{} {}", what, wanted)).second) return;
  // The search for a similar name is slow and only done while messages are shown.
  const bool shown = parse_.reported.size() <= Diagnostics::kMaxPerCode;
  std::vector<std::string> known;
  if (shown)
    for (const scene::Element& e : scene_.elements()) known.push_back(scene::name_of(e));
  const std::string near = nearest_name(wanted, known);
  std::string hint = near.empty() ? "" : fmt::format("did you mean \"{}\"?", near);
  const auto& missing = parse_.in.missing_includes();
  if (near.empty() && !missing.empty()) {
    hint = "perhaps an include that was not found should define it: ";
    constexpr std::size_t kMaxNamed = 3;
    for (std::size_t i = 0; i < missing.size() && i < kMaxNamed; ++i)
      hint += (i ? ", " : "") + missing[i];
    if (missing.size() > kMaxNamed) hint += fmt::format(" and {} more", missing.size() - kMaxNamed);
  }
  parse_.diagnostics.report(fatal ? Severity::Error : Severity::Warning, code::kUnresolved, at,
                            fmt::format("{} \"{}\" is defined nowhere", what, wanted),
                            std::move(hint));
}

// "shader" or "shader.member"; an element with the dotted name has precedence.
void Resolver::connection(const std::string& wanted, SourceLocation at) {
  if (exists(wanted)) return;
  const std::size_t dot = wanted.rfind('.');
  if (dot != std::string::npos && exists(wanted.substr(0, dot))) return;
  // Member of a structure in the result: "shader.member.part".
  const std::size_t first = wanted.find('.');
  if (first != std::string::npos && exists(wanted.substr(0, first))) return;
  name("shader", wanted, at);
}

void Resolver::value(const Value& v) {
  if (v.kind == Value::Kind::Connection) connection(v.text, v.where);
  for (const Value& item : v.items) value(item);
  for (const scene::Argument& member : v.members) value(member.value);
}

void Resolver::shader_type(const scene::ShaderUse& use) {
  if (parse_.declaration(use.type) || scene_.find_declaration(use.type)) return;
  if (parse_.options.knows_shader && parse_.options.knows_shader(use.type)) return;
  if (!parse_.reported.insert("type " + use.type).second) return;
  std::vector<std::string> known;
  for (const auto& d : scene_.declarations) known.push_back(d.name);
  for (const auto& p : scene_.phenomena) known.push_back(p.declaration.name);
  std::string hint;
  if (const std::string near = nearest_name(use.type, known); !near.empty()) {
    hint = fmt::format("did you mean \"{}\"?", near);
  } else if (const auto* e = scene_.get<scene::ShaderElement>(use.type)) {
    hint = fmt::format("a shader of that name exists: write = \"{}\"", e->name);
  }
  parse_.warn(code::kUnknownShader, use.where,
              fmt::format("shader type \"{}\" is not declared", use.type), std::move(hint));
}

void Resolver::list(const ShaderList& shaders) {
  for (const scene::ShaderUse& use : shaders) {
    if (!use.interface && !use.reference.empty()) connection(use.reference, use.where);
    if (!use.type.empty()) shader_type(use);
    for (const scene::Argument& argument : use.arguments) value(argument.value);
  }
}

void Resolver::visit(const scene::Camera& e) {
  list(e.lens);
  list(e.volume);
  list(e.environment);
  for (const scene::Output& output : e.outputs) list(output.shaders);
}

void Resolver::visit(const scene::Light& e) {
  list(e.shaders);
  list(e.emitters);
  if (e.area && e.area->keyword == "object" && !e.area->values.empty())
    name("instance", e.area->values[0].text, e.area->where);
}

void Resolver::visit(const scene::Material& e) {
  list(e.shaders);
  for (const auto& slot : e.slots) list(slot.shaders);
}

void Resolver::visit(const scene::Object& e) {
  for (const auto& group : e.groups) names("material", group.materials, group.where);
  for (const auto& hair : e.hairs)
    if (!hair.material.empty()) names("material", {hair.material}, hair.where);
}

void Resolver::visit(const scene::Instance& e) {
  name("element", e.element, e.where);
  names("material", e.materials, e.where);
  if (e.light_links) names("light", e.light_links->lights, e.where);
  if (e.shadow_links) names("light", e.shadow_links->lights, e.where);
  list(e.geometry);
  list(e.transform_shaders);
  if (e.parameters)
    for (const scene::Argument& argument : *e.parameters) value(argument.value);
}

void Resolver::element(const scene::Element& e) {
  std::visit([this](const auto& kind) { visit(kind); }, e);
}

void Resolver::phenomenon(const scene::Phenomenon& p) {
  local_ = &p;
  for (const auto& e : p.shaders) visit(e);
  for (const auto& e : p.materials) visit(e);
  for (const auto& e : p.lights) visit(e);
  for (const auto& e : p.instances) visit(e);
  for (const auto& root : p.roots) {
    list(root.shaders);
    name("root", root.name, p.declaration.where);
  }
  local_ = nullptr;
}

void Resolver::render(const scene::RenderCommand& r) {
  name("root group", r.root, r.where, true);
  name("camera instance", r.camera, r.where, true);
  name("options element", r.options, r.where, true);
}

}  // namespace

void report_unresolved(Parse& parse, const scene::RenderCommand& render) {
  Resolver resolver(parse);
  for (const scene::Phenomenon& p : parse.scene->phenomena) resolver.phenomenon(p);
  for (const scene::Element& e : parse.scene->elements()) resolver.element(e);
  resolver.render(render);
  parse.in.report_missing_includes(parse.diagnostics.has(code::kUnknownShader) ||
                                   parse.diagnostics.has(code::kUnresolved));
}

}  // namespace oriel::mi
