// SPDX-License-Identifier: Apache-2.0
#include "interactive/scene_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

#include "base/diagnostic.h"
#include "interactive/element_statements.h"
#include "interactive/structured_value.h"

namespace oriel::interactive {
namespace {

using scene::Value;

std::string hint_of(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string near = nearest_name(name, candidates);
  return near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near);
}

std::vector<std::string> parameters_of(const scene::Scene& scene, const std::string& type,
                                       const Registry& registry) {
  std::vector<std::string> names;
  if (const ShaderSpec* spec = registry.find(type))
    for (const ParamSpec& p : spec->params) names.emplace_back(p.name);
  else if (const scene::Phenomenon* phenomenon = scene.find_phenomenon(type))
    for (const scene::ParamDecl& p : phenomenon->declaration.parameters) names.push_back(p.name);
  else if (const scene::ShaderDeclaration* declaration = scene.find_declaration(type))
    for (const scene::ParamDecl& p : declaration->parameters) names.push_back(p.name);
  return names;
}

std::string no_such_option(const std::string& name, const std::vector<std::string>& known) {
  const std::string near = nearest_name(name, known);
  return fmt::format("--set: there is no option \"{}\"{}", name,
                     near.empty() ? "" : fmt::format("; did you mean {}?", near));
}

/// Looks for a parameter in calls.
struct CallSearch {
  scene::Scene& scene;
  const Registry& registry;
  const std::string& parameter;
  std::vector<std::string>& candidates;  ///< parameters that exist
};

FoundCall find_in_list(const CallSearch& search, const std::string& owner, scene::ShaderList& list,
                       int depth = 0) {
  constexpr int kMaxReferences = 16;  // named shaders may refer to each other in a circle
  for (scene::ShaderUse& use : list) {
    if (!use.reference.empty()) {
      auto* named = search.scene.get<scene::ShaderElement>(use.reference);
      if (!named || depth >= kMaxReferences) continue;
      const FoundCall found = find_in_list(search, use.reference, named->functions, depth + 1);
      if (found.call) return found;
      continue;
    }
    const std::vector<std::string> names = parameters_of(search.scene, use.type, search.registry);
    search.candidates.insert(search.candidates.end(), names.begin(), names.end());
    if (std::find(names.begin(), names.end(), search.parameter) != names.end())
      return {&use, owner};
  }
  return {};
}

/// The shader lists of an element in the order in which a parameter is looked up.
std::vector<scene::ShaderList*> lists_of(scene::Element& element) {
  std::vector<scene::ShaderList*> lists;
  if (auto* shader = std::get_if<scene::ShaderElement>(&element)) lists = {&shader->functions};
  if (auto* light = std::get_if<scene::Light>(&element)) lists = {&light->shaders};
  if (auto* texture = std::get_if<scene::Texture>(&element)) lists = {&texture->procedure};
  if (auto* camera = std::get_if<scene::Camera>(&element))
    lists = {&camera->lens, &camera->volume, &camera->environment};
  if (auto* material = std::get_if<scene::Material>(&element)) {
    lists = {&material->shaders};
    for (scene::Material::Slot& slot : material->slots) lists.push_back(&slot.shaders);
  }
  return lists;
}

}  // namespace

SceneEdit parse_edit(const scene::Scene& scene, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || text.find('.') > equals)
    throw EditFormError(fmt::format("--set {}: expected element.parameter=value", text));
  const std::string left = text.substr(0, equals);
  for (std::size_t dot = left.rfind('.'); dot != std::string::npos && dot > 0;
       dot = left.rfind('.', dot - 1))
    if (scene.find(left.substr(0, dot)))
      return {left.substr(0, dot), left.substr(dot + 1), text.substr(equals + 1)};

  const std::string wanted = left.substr(0, left.rfind('.'));
  std::vector<std::string> names;
  for (const scene::Element& e : scene.elements()) names.push_back(name_of(e));
  throw EditError(
      fmt::format("--set: the scene has no element \"{}\"{}", wanted, hint_of(wanted, names)));
}

Value parse_edit_value(const std::string& text) {
  Value value;
  if (text == "on" || text == "true" || text == "off" || text == "false") {
    value.kind = Value::Kind::Boolean;
    value.boolean = text == "on" || text == "true";
    return value;
  }
  if (text.starts_with('=')) {
    value.kind = Value::Kind::Connection;
    value.text = text.substr(1);
    return value;
  }
  if (is_structured(text))
    if (std::optional<Value> structured = parse_structured(text)) return *std::move(structured);
  const char* at = text.c_str();
  value.integral = true;
  while (*at) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) break;
    value.numbers.push_back(number);
    value.integral =
        value.integral && std::string_view(at, end).find_first_of(".eE") == std::string_view::npos;
    at = end + std::strspn(end, " ,");
  }
  if (*at == 0 && !value.numbers.empty()) {
    value.kind = Value::Kind::Numbers;
    return value;
  }
  value = {};
  value.kind = Value::Kind::Text;
  value.text = text;
  return value;
}

FoundCall find_call(scene::Scene& scene, const SceneEdit& edit, const Registry& registry,
                    std::vector<std::string>& candidates) {
  const CallSearch search{scene, registry, edit.parameter, candidates};
  for (scene::ShaderList* list : lists_of(*scene.find(edit.element)))
    if (const FoundCall found = find_in_list(search, edit.element, *list); found.call) return found;
  return {};
}

std::string apply_edit(scene::Scene& scene, const std::string& text, const Registry& registry,
                       const BeforeChange& before) {
  const SceneEdit edit = parse_edit(scene, text);
  scene::Element& element = *scene.find(edit.element);
  const Value value = parse_edit_value(edit.value);
  std::vector<std::string> candidates;
  if (const FoundCall found = find_call(scene, edit, registry, candidates); found.call) {
    if (before) before(*scene.find(found.owner));
    std::erase_if(found.call->arguments, [&](const auto& a) { return a.name == edit.parameter; });
    found.call->arguments.push_back({edit.parameter, value, {}});
    return found.owner;
  }
  std::vector<std::string> statements;
  switch (set_statement(element, edit.parameter, value, before, statements)) {
    case StatementEdit::Done:
      return edit.element;
    case StatementEdit::NoStatements:
      if (!lists_of(element).empty()) break;  // it has parameters
      throw EditError(fmt::format(
          "--set: \"{}\" is not a shader, material, light, camera, instance, texture or options "
          "block",
          edit.element));
    case StatementEdit::BadValue:
      throw EditError(fmt::format("--set: \"{}\" is not a value of {}.{}", edit.value, edit.element,
                                  edit.parameter));
    case StatementEdit::Unknown:
      break;
  }
  if (std::holds_alternative<scene::Options>(element))
    throw EditError(no_such_option(edit.parameter, statements));
  candidates.insert(candidates.end(), statements.begin(), statements.end());
  throw EditError(fmt::format("--set: \"{}\" has no parameter \"{}\"{}", edit.element,
                              edit.parameter, hint_of(edit.parameter, candidates)));
}

}  // namespace oriel::interactive
