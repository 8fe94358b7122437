// SPDX-License-Identifier: Apache-2.0
// Shader calls, shader lists, named shaders.
#include <fmt/format.h>

#include <algorithm>

#include "mi/elements.h"
#include "mi/number.h"

namespace oriel::mi {
namespace {

using scene::ParamDecl;
using scene::ParamType;
using scene::ShaderUse;
using scene::Value;

void check_arguments(Parse& parse, const std::vector<ParamDecl>& declared,
                     const std::vector<scene::Argument>& arguments, const std::string& shader);

void check_value(Parse& parse, const ParamDecl& declared, const Value& value,
                 const std::string& shader) {
  if (value.kind == Value::Kind::Struct && declared.type == ParamType::Struct)
    check_arguments(parse, declared.members, value.members, shader);
  if (value.kind == Value::Kind::Array && declared.type == ParamType::Array &&
      !declared.members.empty())
    for (const Value& item : value.items) check_value(parse, declared.members[0], item, shader);
  if (value.kind == Value::Kind::Numbers && value.numbers.size() > number_count(declared.type) &&
      declared.type != ParamType::Array)
    parse.warn(code::kTooManyValues, value.where,
               fmt::format("parameter \"{}\" of shader \"{}\" has {} numbers; a {} has {}",
                           declared.name, shader, value.numbers.size(),
                           scene::type_name(declared.type), number_count(declared.type)),
               "the rest is ignored");
}

void check_arguments(Parse& parse, const std::vector<ParamDecl>& declared,
                     const std::vector<scene::Argument>& arguments, const std::string& shader) {
  for (const scene::Argument& argument : arguments) {
    const auto found = std::find_if(declared.begin(), declared.end(),
                                    [&](const ParamDecl& d) { return d.name == argument.name; });
    if (found != declared.end()) {
      check_value(parse, *found, argument.value, shader);
      continue;
    }
    if (!parse.reported.insert("parameter " + shader + " " + argument.name).second) continue;
    std::vector<std::string> names;
    names.reserve(declared.size());
    for (const ParamDecl& d : declared) names.push_back(d.name);
    const std::string near = nearest_name(argument.name, names);
    parse.warn(
        code::kUnknownParameter, argument.where,
        fmt::format("shader \"{}\" has no parameter \"{}\"; it is ignored", shader, argument.name),
        near.empty() ? "" : fmt::format("did you mean \"{}\"?", near));
  }
}

// An incremental change of a shader of the same type keeps parameters that are not in the change.
void merge_functions(scene::ShaderList& old, scene::ShaderList changed) {
  const bool same = old.size() == 1 && changed.size() == 1 && !changed[0].type.empty() &&
                    old[0].type == changed[0].type;
  if (!same) {
    old = std::move(changed);
    return;
  }
  for (scene::Argument& argument : changed[0].arguments) {
    auto& arguments = old[0].arguments;
    const auto found =
        std::find_if(arguments.begin(), arguments.end(),
                     [&](const scene::Argument& a) { return a.name == argument.name; });
    if (found == arguments.end())
      arguments.push_back(std::move(argument));
    else
      *found = std::move(argument);
  }
  old[0].where = changed[0].where;
}

}  // namespace

bool at_shader(Parse& parse) {
  const Token& token = parse.in.peek();
  if (token.kind != Token::Kind::Word)
    return token.kind == Token::Kind::String || token.is_punct('=');
  return *skip_blanks(token.raw.data() + token.raw.size()) == '(';
}

ShaderUse read_call(Parse& parse, std::string type, SourceLocation at) {
  ShaderUse use;
  use.where = at;
  use.type = parse.shader_type_name(std::move(type));
  if (parse.in.accept_punct('(')) {
    use.arguments = read_arguments(parse, ')');
  } else {
    parse.warn(code::kSyntax, parse.in.where(),
               fmt::format("the call of shader \"{}\" has no parameter list", use.type),
               "write \"" + use.type + "\" (), or = \"" + use.type + "\" for a named shader");
  }
  const bool host_binds = parse.options.knows_shader && parse.options.knows_shader(use.type);
  if (const auto* d = host_binds ? nullptr : parse.declaration(use.type))
    check_arguments(parse, d->parameters, use.arguments, use.type);
  return use;
}

ShaderUse read_shader(Parse& parse) {
  const Nesting nesting(parse);
  const SourceLocation at = parse.in.where();
  if (!parse.in.at_punct('=')) {
    if (!parse.in.peek().is_name()) parse.unexpected("a shader");
    return read_call(parse, parse.in.next().str(), at);
  }
  // Read as a value: a name, or the definition of a new shader.
  Value value = read_value(parse);
  ShaderUse use;
  use.where = at;
  if (value.kind == Value::Kind::Interface) {
    use.reference = std::move(value.text);
    use.interface = true;
  } else {
    use.reference = std::move(value.text);
  }
  return use;
}

scene::ShaderList read_shader_list(Parse& parse) {
  scene::ShaderList list;
  while (at_shader(parse)) list.push_back(read_shader(parse));
  return list;
}

void read_shader_element(Parse& parse, SourceLocation at) {
  parse.element<scene::ShaderElement>("shader", at, [&](scene::ShaderElement& shader) {
    const bool reopened = parse.incremental && !shader.functions.empty();
    if (!at_shader(parse)) parse.unexpected("a shader");
    scene::ShaderList functions = read_shader_list(parse);
    if (reopened)
      merge_functions(shader.functions, std::move(functions));
    else
      shader.functions = std::move(functions);
  });
}

}  // namespace oriel::mi
