// SPDX-License-Identifier: Apache-2.0
// declare phenomenon result "name" ( parameters ) body end declare
#include <algorithm>

#include "mi/elements.h"
#include "mi/statements.h"

namespace oriel::mi {
namespace {

using scene::Phenomenon;

constexpr std::string_view kListWords[] = {"output",      "lens",     "volume",
                                           "environment", "geometry", "contour"};

// output|lens|volume priority N
bool read_priority(Parse& parse, Phenomenon& phenomenon, const std::string& word,
                   SourceLocation at) {
  if (!parse.in.accept_word("priority")) return false;
  scene::Statement statement{word + " priority", false, {}, at};
  if (parse.at_number()) statement.values.push_back(read_numbers(parse));
  phenomenon.requirements.push_back(std::move(statement));
  return true;
}

void read_root(Parse& parse, Phenomenon& phenomenon) {
  Phenomenon::Root root{"root", "", {}};
  if (parse.in.at_word("material") || parse.in.at_word("light")) {
    root.keyword.append(" ").append(parse.in.next().text);
    root.name = parse.name("the name of the root");
  } else {
    if (!at_shader(parse)) parse.unexpected("the root shader");
    root.shaders = read_shader_list(parse);
  }
  phenomenon.roots.push_back(std::move(root));
}

void read_list(Parse& parse, Phenomenon& phenomenon, SourceLocation at) {
  Phenomenon::Root root{std::string(parse.in.next().text), "", {}};
  if (root.keyword == "contour") {
    if (!parse.in.at_word("store") && !parse.in.at_word("contrast"))
      parse.unexpected("store or contrast");
    root.keyword.append(" ").append(parse.in.next().text);
  } else if (read_priority(parse, phenomenon, root.keyword, at)) {
    return;
  }
  if (root.keyword == "volume" && parse.in.accept_word("level")) {
    scene::Statement statement{"volume level", false, {}, at};
    if (parse.at_number()) statement.values.push_back(read_numbers(parse));
    phenomenon.requirements.push_back(std::move(statement));
    return;
  }
  root.shaders = read_shader_list(parse);
  phenomenon.roots.push_back(std::move(root));
}

void read_body(Parse& parse, Phenomenon& phenomenon) {
  while (!parse.in.at_word("end")) {
    const SourceLocation at = parse.in.where();
    if (parse.in.accept_word("shader")) {
      read_shader_element(parse, at);
    } else if (parse.in.accept_word("material")) {
      read_material(parse, at);
    } else if (parse.in.accept_word("light")) {
      read_light(parse, at);
    } else if (parse.in.accept_word("instance")) {
      read_instance(parse, at);
    } else if (parse.in.accept_word("root")) {
      read_root(parse, phenomenon);
    } else if (const std::string_view word = parse.in.peek().text;
               parse.in.at(Token::Kind::Word) &&
               std::find(std::begin(kListWords), std::end(kListWords), word) !=
                   std::end(kListWords)) {
      read_list(parse, phenomenon, at);
    } else {
      read_requirement(parse, phenomenon.requirements, phenomenon.declaration.uninterpreted);
    }
  }
  parse.expect_end("declare");
}

}  // namespace

void read_phenomenon(Parse& parse, SourceLocation at) {
  Phenomenon phenomenon;
  scene::ShaderDeclaration& d = phenomenon.declaration;
  try {
    read_declaration_head(parse, d, at);
    parse.phenomenon = &phenomenon;
    read_body(parse, phenomenon);
  } catch (const SyntaxError&) {
    parse.recover("declare");
  }
  parse.phenomenon = nullptr;
  if (!d.name.empty()) parse.declare(std::move(phenomenon));
}

}  // namespace oriel::mi
