// SPDX-License-Identifier: Apache-2.0
// Shaders of other programs: fallback shaders bound by the scene's own declarations, whose structs
// and arrays come apart into plain parameters; and fallbacks for unavailable shaders.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/binder.h"
#include "runtime/fallback_shader.h"

namespace oriel {
namespace {

using scene::Value;

bool has_parameter(const ShaderSpec& spec, std::string_view name) {
  return std::any_of(spec.params.begin(), spec.params.end(),
                     [&](const ParamSpec& p) { return same_but_for_case(p.name, name); });
}

const scene::ParamDecl* declared_parameter(const scene::ShaderDeclaration* declaration,
                                           const std::string& name) {
  if (!declaration) return nullptr;
  for (const scene::ParamDecl& p : declaration->parameters)
    if (p.name == name) return &p;
  return nullptr;
}

}  // namespace

void Binder::bind_declared(ShaderNode& node, const std::vector<scene::ParamDecl>& declared) {
  for (const scene::ParamDecl& p : declared) {
    if (p.type == ParamType::Struct)
      bind_declared(node, p.members);
    else if (p.default_value && has_parameter(node.spec(), p.name))
      bind_argument(node, {p.name, *p.default_value, p.where}, nullptr);
  }
}

void Binder::bind_parts(ShaderNode& node, const scene::Argument& argument, Scope* scope) {
  const Value& value = argument.value;
  if (value.kind == Value::Kind::Interface && scope) {
    if (const Value* outer = interface_value(value.text, *scope))
      bind_parts(node, {argument.name, *outer, argument.where}, const_cast<Scope*>(scope->outer));
    return;
  }
  if (value.kind == Value::Kind::Struct) {
    // A struct only groups parameters; within an array its members belong to an element.
    const bool element = argument.name.ends_with(']');
    for (const scene::Argument& member : value.members)
      bind_argument(
          node,
          {element ? argument.name + '.' + member.name : member.name, member.value, member.where},
          scope);
    return;
  }
  if (value.kind == Value::Kind::Array && has_parameter(node.spec(), argument.name + "[]")) {
    Value count;
    count.kind = Value::Kind::Numbers;
    count.numbers = {static_cast<double>(value.items.size())};
    bind_argument(node, {argument.name + "[]", count, argument.where}, scope);
    for (std::size_t i = 0; i < value.items.size(); ++i)
      bind_argument(node, {fmt::format("{}[{}]", argument.name, i), value.items[i], argument.where},
                    scope);
    return;
  }
  if (bind_passed_through(node, argument, scope)) return;
  ++report_.ignored[fmt::format("{}.{}", node.spec().name, argument.name)];
}

bool Binder::bind_passed_through(ShaderNode& node, const scene::Argument& argument, Scope* scope) {
  const Value& value = argument.value;
  const bool named = value.kind == Value::Kind::Connection || value.kind == Value::Kind::Text;
  if (!node.spec().fallback.passes_through || !named || value.text.empty()) return false;
  const ParamSpec& input = node.spec().params.front();
  if (node.connected(input.offset)) return false;
  const ShaderNode* source = find_named(value.text, scope);
  if (!source && value.text.find('.') != std::string::npos)
    source = find_named(value.text.substr(0, value.text.rfind('.')), scope);
  return source && source->spec().material.fill &&
         bind_input(node, input.offset, *source, value.where);
}

const ShaderNode* Binder::bind_unknown(const std::string& type,
                                       const std::vector<scene::Argument>& args,
                                       SourceLocation where, Scope* scope) {
  std::vector<std::string> names;
  for (const ShaderSpec* known : registry_.all()) names.emplace_back(known->name);
  const std::string near = nearest_name(type, names);
  const auto* declaration = scene_.find_declaration(type);

  // A misspelt name is to be corrected, not guessed around.
  std::vector<scene::Argument> familiar;
  std::string guess;
  for (const scene::Argument& argument : args) {
    if (!near.empty()) break;
    const auto* declared = declared_parameter(declaration, argument.name);
    const bool names_texture = argument.value.kind == Value::Kind::Text &&
                               scene_.get<scene::Texture>(argument.value.text) != nullptr;
    const char* meaning = familiar_parameter(argument.name, argument.value,
                                             declared ? &declared->type : nullptr, names_texture);
    if (!meaning) continue;
    familiar.push_back({meaning, argument.value, argument.where});
    guess += fmt::format("{}{} \"{}\"", guess.empty() ? "" : ", ", meaning, argument.name);
  }
  if (reported_[type]++ == 0) {
    const std::string missing = fmt::format("shader \"{}\" is not available", type);
    if (familiar.empty())
      diagnostics_.warning("OR-RT-001", where, missing,
                           near.empty() ? "" : fmt::format("did you mean \"{}\"?", near));
    else
      diagnostics_.warning("OR-RT-001", where,
                           fmt::format("{}; guessed from its parameters: {}", missing, guess));
  }
  const auto once = [](auto& list, const std::string& name) {
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
  };
  if (familiar.empty()) {
    if (!report_.guessed.count(type)) once(report_.missing_shaders, type);
    return fallback();
  }
  report_.guessed.emplace(type, guess);
  ShaderNode* node = make_node(kApproximateMaterial);
  for (const scene::Argument& argument : familiar) bind_argument(*node, argument, scope);
  count_lobes(*node, where);
  return node;
}

}  // namespace oriel
