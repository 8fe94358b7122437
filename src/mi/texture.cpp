// SPDX-License-Identifier: Apache-2.0
// [local] [filter [f]] [writable] color|scalar|vector texture "name" data
#include "mi/elements.h"

namespace oriel::mi {
namespace {

using scene::Texture;

// Reads numbers, optionally in brackets.
void read_size(Parse& parse, Texture& texture) {
  const bool bracketed = parse.in.accept_punct('[');
  while (parse.at_number()) texture.size.push_back(parse.integer("a size"));
  if (bracketed) parse.expect_punct(']');
}

void read_texture_data(Parse& parse, Texture& texture) {
  if (parse.in.accept_word("colorprofile")) parse.name("the name of a colour profile");
  if (at_shader(parse) && !parse.in.at(Token::Kind::String)) {
    texture.procedure = read_shader_list(parse);
    return;
  }
  if (parse.in.at(Token::Kind::String)) {
    const SourceLocation at = parse.in.where();
    std::string first = parse.in.next().str();
    if (parse.in.at_punct('(')) {
      texture.procedure.push_back(read_call(parse, std::move(first), at));
      for (scene::ShaderUse& use : read_shader_list(parse))
        texture.procedure.push_back(std::move(use));
      return;
    }
    texture.file = std::move(first);
    if (parse.in.at(Token::Kind::String)) texture.format = parse.in.next().str();
    if (parse.in.at(Token::Kind::String)) texture.data_type = parse.in.next().str();
  } else if (!parse.in.at_punct('[') && !parse.at_number()) {
    parse.unexpected("a file name, a size or a shader");
  }
  read_size(parse, texture);
  while (parse.in.at(Token::Kind::Hex)) append_hex(parse, texture.pixels);
}

}  // namespace

void read_texture(Parse& parse, std::string_view word, SourceLocation at) {
  Texture flags;
  for (;; word = parse.in.next().text) {
    if (word == "local") {
      flags.local = true;
    } else if (word == "writable") {
      flags.writable = true;
    } else if (word == "filter") {
      flags.filter = parse.at_number() ? parse.real("a factor") : 1.0f;
    } else {
      break;
    }
    if (!parse.in.at(Token::Kind::Word)) parse.unexpected("'color texture'");
  }
  flags.type = word == "color"    ? scene::ParamType::ColorTexture
               : word == "scalar" ? scene::ParamType::ScalarTexture
                                  : scene::ParamType::VectorTexture;
  if (word != "color" && word != "scalar" && word != "vector")
    parse.unexpected("color, scalar or vector before this");
  parse.expect_word("texture");
  parse.element<Texture>("texture", at, [&](Texture& texture) {
    flags.name = texture.name;
    flags.where = at;
    texture = flags;
    texture.directory = parse.in.folder();
    read_texture_data(parse, texture);
  });
}

}  // namespace oriel::mi
