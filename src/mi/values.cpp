// SPDX-License-Identifier: Apache-2.0
// Parameter values: numbers, strings, connections, structures, arrays.
#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "mi/elements.h"
#include "mi/statements.h"

namespace oriel::mi {
namespace {

using scene::Argument;
using scene::Value;

void read_connection(Parse& parse, Value& value) {
  if (parse.in.accept_word("interface")) {
    value.kind = Value::Kind::Interface;
    value.text = parse.name("the name of a parameter of the phenomenon");
    return;
  }
  value.kind = Value::Kind::Connection;
  const SourceLocation at = parse.in.where();
  const bool incremental = parse.in.accept_word("incremental");
  if (parse.in.accept_word("shader")) {
    scene::ShaderElement shader;
    shader.where = at;
    shader.name = parse.defined_name(parse.name("the name of the new shader"));
    shader.functions.push_back(read_shader(parse));
    value.text = shader.name;
    parse.add(std::move(shader));
    return;
  }
  if (incremental) parse.unexpected("'shader'");
  value.text = parse.referenced_name(parse.name("the name of a shader"));
}

void read_array(Parse& parse, Value& value) {
  value.kind = Value::Kind::Array;
  while (!parse.in.accept_punct(']')) {
    value.items.push_back(read_value(parse));
    if (!parse.in.accept_punct(',') && !parse.in.at_punct(']')) parse.unexpected("',' or ']'");
  }
}

// A vector in backquotes: three big-endian floats.
void read_binary_vector(Parse& parse, Value& value) {
  value.kind = Value::Kind::Numbers;
  const auto bytes = parse.in.binary(12);
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    std::uint32_t bits = 0;
    for (int b = 0; b < 4; ++b)
      bits = bits << 8 | static_cast<unsigned char>(bytes[i + static_cast<std::size_t>(b)]);
    value.numbers.push_back(static_cast<double>(std::bit_cast<float>(bits)));
  }
}

}  // namespace

Value read_value(Parse& parse) {
  const Nesting nesting(parse);
  Value value;
  const Token token = parse.in.peek();
  value.where = parse.in.where();
  if (token.kind == Token::Kind::Number) return read_numbers(parse);
  if (token.kind == Token::Kind::Binary) {
    read_binary_vector(parse, value);
    return value;
  }
  if (token.kind == Token::Kind::String) {
    value.kind = Value::Kind::Text;
    value.text = parse.text_value(parse.in.next().str());
    return value;
  }
  if (token.kind == Token::Kind::Word) {
    parse.in.next();
    if (Parse::is_boolean(token, value.boolean)) {
      value.kind = Value::Kind::Boolean;
    } else if (token.text == "colorprofile" && parse.in.at(Token::Kind::String)) {
      // The colour space of the next value is ignored: colours are linear.
      parse.in.next();
      return read_value(parse);
    } else if (token.text != "null") {
      value.kind = Value::Kind::Text;
      value.bare = true;
      value.text = parse.text_value(std::string(token.text));
    }
    return value;
  }
  if (parse.in.accept_punct('=')) {
    read_connection(parse, value);
  } else if (parse.in.accept_punct('{')) {
    value.kind = Value::Kind::Struct;
    value.members = read_arguments(parse, '}');
  } else if (parse.in.accept_punct('[')) {
    read_array(parse, value);
  } else {
    parse.unexpected("a value");
  }
  return value;
}

std::vector<Argument> read_arguments(Parse& parse, char close) {
  std::vector<Argument> arguments;
  while (!parse.in.accept_punct(close)) {
    Argument argument;
    argument.where = parse.in.where();
    if (!parse.in.peek().is_name())
      parse.unexpected(fmt::format("the name of a parameter or '{}'", close));
    argument.name = parse.in.next().str();
    argument.value = read_value(parse);
    arguments.push_back(std::move(argument));
    if (parse.in.accept_punct(',') || parse.in.at_punct(close)) continue;
    if (!parse.in.at(Token::Kind::String)) parse.unexpected(fmt::format("',' or '{}'", close));
    parse.warn(code::kMissingComma, parse.in.where(), "a comma is missing before this parameter");
  }
  return arguments;
}

}  // namespace oriel::mi
