// SPDX-License-Identifier: Apache-2.0
#include "interactive/inverse_edits.h"

#include <algorithm>

#include "interactive/element_statements.h"
#include "interactive/scene_edit.h"
#include "interactive/structured_value.h"
#include "shaders/default_text.h"

namespace oriel::interactive {
namespace {

using scene::Value;

/// The value as parse_edit_value() reads it.
std::optional<std::string> text_of_edit(const Value& value) {
  switch (value.kind) {
    case Value::Kind::Null:
    case Value::Kind::Interface:
      return std::nullopt;
    case Value::Kind::Text:
      return value.text;
    case Value::Kind::Connection:
      return "=" + value.text;
    default:
      return structured_text(value);
  }
}

std::optional<std::string> value_in_call(const scene::ShaderUse& call, const std::string& parameter,
                                         const Registry& registry) {
  for (const scene::Argument& argument : call.arguments)
    if (argument.name == parameter) return text_of_edit(argument.value);
  const ShaderSpec* spec = registry.find(call.type);
  if (!spec) return std::nullopt;
  const auto p = std::find_if(spec->params.begin(), spec->params.end(),
                              [&](const ParamSpec& s) { return parameter == s.name; });
  const std::string text = p == spec->params.end() ? "" : default_text(*p);
  return text.empty() ? std::nullopt : std::optional(text);
}

std::optional<std::string> value_of_statement(const scene::Element& element,
                                              const std::string& name) {
  for (const StatementValue& s : statements_of(element)) {
    if (s.name != name || s.values.empty()) continue;
    std::string text;
    for (const Value& value : s.values) {
      const auto part = text_of_edit(value);
      if (!part) return std::nullopt;
      text += (text.empty() ? "" : " ") + *part;
    }
    return text;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<std::string>> inverse_edits(scene::Scene& scene,
                                                      const std::vector<std::string>& edits,
                                                      const Registry& registry) {
  std::vector<std::string> inverse;
  for (const std::string& text : edits) {
    const SceneEdit edit = parse_edit(scene, text);
    std::vector<std::string> candidates;
    const FoundCall found = find_call(scene, edit, registry, candidates);
    const auto value = found.call ? value_in_call(*found.call, edit.parameter, registry)
                                  : value_of_statement(*scene.find(edit.element), edit.parameter);
    if (!value) return std::nullopt;
    inverse.push_back(edit.target() + "=" + *value);
  }
  return inverse;
}

}  // namespace oriel::interactive
