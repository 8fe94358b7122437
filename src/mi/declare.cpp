// SPDX-License-Identifier: Apache-2.0
// declare [shader] result "name" ( parameters ) requirements end declare; declare data ...
#include <fmt/format.h>

#include <algorithm>

#include "mi/elements.h"
#include "mi/statements.h"

namespace oriel::mi {
namespace {

using scene::ParamDecl;
using scene::ParamType;

struct TypeWord {
  std::string_view word;
  ParamType type;
};
constexpr TypeWord kTypes[] = {{"boolean", ParamType::Boolean},
                               {"integer", ParamType::Integer},
                               {"scalar", ParamType::Scalar},
                               {"string", ParamType::String},
                               {"color", ParamType::Color},
                               {"vector", ParamType::Vector},
                               {"transform", ParamType::Transform},
                               {"light", ParamType::Light},
                               {"material", ParamType::Material},
                               {"geometry", ParamType::Geometry},
                               {"lightprofile", ParamType::LightProfile},
                               {"spectrum", ParamType::Spectrum},
                               {"texture", ParamType::ColorTexture},
                               {"shader", ParamType::Shader},
                               {"data", ParamType::Data},
                               {"struct", ParamType::Struct},
                               {"array", ParamType::Array}};

const TypeWord* find_type(std::string_view word) {
  const auto found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                  [&](const TypeWord& t) { return t.word == word; });
  return found == std::end(kTypes) ? nullptr : found;
}

bool at_type(Parse& parse) {
  return parse.in.at(Token::Kind::Word) && find_type(parse.in.peek().text);
}

ParamType read_type(Parse& parse) {
  if (!at_type(parse)) {
    std::vector<std::string> names;
    for (const TypeWord& t : kTypes) names.emplace_back(t.word);
    parse.unexpected("the type of a parameter", names);
  }
  const ParamType type = find_type(parse.in.next().text)->type;
  if (!parse.in.at_word("texture")) return type;
  if (type == ParamType::Color) return parse.in.next(), ParamType::ColorTexture;
  if (type == ParamType::Scalar) return parse.in.next(), ParamType::ScalarTexture;
  if (type == ParamType::Vector) return parse.in.next(), ParamType::VectorTexture;
  return type;
}

void read_default(Parse& parse, ParamDecl& parameter) {
  if (!parse.in.accept_word("default")) return;
  parameter.default_value = read_value(parse);
}

// The type, the name (optional for the element of an array), the members of a struct, the element
// of an array and the default.
ParamDecl read_parameter(Parse& parse) {
  const Nesting nesting(parse);
  ParamDecl p;
  p.where = parse.in.where();
  p.type = read_type(parse);
  if (p.type == ParamType::Array) {
    p.members.push_back(read_parameter(parse));
    p.name = p.members[0].name;
    return p;
  }
  if (p.type == ParamType::Data && parse.in.at(Token::Kind::String)) {
    p.name = parse.in.next().str();
    if (parse.in.at(Token::Kind::String)) {  // data "declaration" "name"
      p.type_argument = std::move(p.name);
      p.name = parse.in.next().str();
    }
  } else {
    p.name = parse.name("the name of a parameter");
  }
  if (p.type == ParamType::Struct) {
    parse.expect_punct('{');
    p.members = read_parameter_declarations(parse, '}');
  }
  read_default(parse, p);
  return p;
}

// color | struct { ... } | struct "n" { ... } | empty (color)
std::vector<ParamDecl> read_result(Parse& parse) {
  ParamDecl result;
  result.where = parse.in.where();
  result.type = ParamType::Color;
  if (!at_type(parse)) return {std::move(result)};
  result.type = read_type(parse);
  if (result.type != ParamType::Struct) return {std::move(result)};
  if (parse.in.at(Token::Kind::String)) parse.in.next();
  parse.expect_punct('{');
  return read_parameter_declarations(parse, '}');
}

const FormTable& requirement_forms() {
  static const FormTable table{{"version"},
                               {"min version", "", 1},
                               {"max version", "", 1},
                               {"scanline"},
                               {"trace"},
                               {"shadow", "sort|segments"},
                               {"face", "front|back|both"},
                               {"texture"},
                               {"bump"},
                               {"derivative"},
                               {"object space"},
                               {"camera space"},
                               {"mixed space"},
                               {"world space"},
                               {"parallel"},
                               {"volume level"},
                               {"set", "", 2}};
  return table;
}

scene::Statement read_apply(Parse& parse, SourceLocation at) {
  scene::Statement statement{"apply", false, {}, at};
  do {
    scene::Value value;
    value.kind = scene::Value::Kind::Text;
    value.bare = true;
    value.where = parse.in.where();
    value.text = parse.name("what the shader applies to");
    statement.values.push_back(std::move(value));
  } while (parse.in.accept_punct(','));
  return statement;
}

void read_shader_declaration(Parse& parse, bool old_form, SourceLocation at) {
  scene::ShaderDeclaration d;
  try {
    read_declaration_head(parse, d, at);
    d.old_form = old_form;
    while (!old_form && !parse.in.at_word("end"))
      read_requirement(parse, d.requirements, d.uninterpreted);
    if (!old_form) parse.expect_end("declare");
    parse.declare(std::move(d));
  } catch (const SyntaxError&) {
    // Declared despite the error, so that its uses are not reported as unknown as well.
    if (!d.name.empty()) parse.declare(std::move(d));
    parse.recover("declare");
  }
}

void read_data_declaration(Parse& parse, SourceLocation at) {
  scene::DataDeclaration d;
  d.where = at;
  try {
    d.name = parse.defined_name(parse.name("the name of the data"));
    parse.expect_punct('(');
    d.parameters = read_parameter_declarations(parse, ')');
    while (!parse.in.at_word("end")) read_requirement(parse, d.requirements, d.uninterpreted);
    parse.expect_end("declare");
  } catch (const SyntaxError&) {
    parse.recover("declare");
  }
  auto& list = parse.scene->data_declarations;
  std::erase_if(list, [&](const scene::DataDeclaration& other) { return other.name == d.name; });
  if (!d.name.empty()) list.push_back(std::move(d));
}

}  // namespace

std::vector<ParamDecl> read_parameter_declarations(Parse& parse, char close) {
  std::vector<ParamDecl> list;
  while (!parse.in.accept_punct(close)) {
    list.push_back(read_parameter(parse));
    if (!parse.in.accept_punct(',') && !parse.in.at_punct(close))
      parse.unexpected(fmt::format("',' or '{}'", close));
  }
  return list;
}

void read_declaration_head(Parse& parse, scene::ShaderDeclaration& d, SourceLocation at) {
  d.where = at;
  d.results = read_result(parse);
  d.name = parse.defined_name(parse.name("the name of the shader"));
  parse.expect_punct('(');
  d.parameters = read_parameter_declarations(parse, ')');
}

void read_requirement(Parse& parse, std::vector<scene::Statement>& requirements,
                      std::vector<scene::UninterpretedStatement>& uninterpreted) {
  const SourceLocation at = parse.in.where();
  if (parse.in.accept_word("apply")) {
    requirements.push_back(read_apply(parse, at));
  } else if (parse.in.accept_word("gui")) {
    uninterpreted.push_back(read_gui(parse, at));
  } else if (parse.in.accept_word("hardware")) {
    scene::UninterpretedStatement text{"hardware", "", at};
    if (parse.in.at_punct('(')) keep_brackets(parse, text.text);
    uninterpreted.push_back(std::move(text));
  } else if (auto statement = read_statement(parse, requirement_forms(), "a declaration")) {
    requirements.push_back(std::move(*statement));
  }
}

void read_declare(Parse& parse, SourceLocation at) {
  if (parse.in.accept_word("phenomenon")) return read_phenomenon(parse, at);
  if (parse.in.accept_word("data")) return read_data_declaration(parse, at);
  // `declare shader "s"` is the new form. A result of type shader requires `shader` twice.
  read_shader_declaration(parse, !parse.in.accept_word("shader"), at);
}

}  // namespace oriel::mi
