// SPDX-License-Identifier: Apache-2.0
// options "name" ... end options
#include "mi/elements.h"
#include "mi/statements.h"
#include "scene/option_table.h"

namespace oriel::mi {
namespace {

const FormTable& option_forms() {
  static constexpr std::string_view kOthers[] = {"state"};
  static const FormTable table(scene::option_table(), kOthers);
  return table;
}

bool starts_option(Parse& parse) {
  const Token& token = parse.in.peek();
  if (token.kind == Token::Kind::String) return true;
  return token.kind == Token::Kind::Word && option_forms().starts_statement(token.text);
}

// contour store "f" ( ), attribute ...
scene::UninterpretedStatement keep_option(Parse& parse, std::string keyword, SourceLocation at) {
  scene::UninterpretedStatement uninterpreted{std::move(keyword), "", at};
  while (parse.in.at_word("store") || parse.in.at_word("contrast")) {
    if (uninterpreted.keyword != "contour") break;
    append_source(uninterpreted.text, parse.in.next());
  }
  if (uninterpreted.keyword == "attribute") {
    while (!parse.in.at_end() && !parse.in.at_word("end")) {
      if (parse.in.at(Token::Kind::Word) && starts_option(parse)) break;
      append_source(uninterpreted.text, parse.in.next());
    }
    return uninterpreted;
  }
  while (at_shader(parse)) {
    if (parse.in.at_punct('=')) append_source(uninterpreted.text, parse.in.next());
    if (!parse.in.peek().is_name()) parse.unexpected("a shader");
    append_source(uninterpreted.text, parse.in.next());
    if (!parse.in.at_punct('(')) break;
    keep_brackets(parse, uninterpreted.text);
  }
  return uninterpreted;
}

// state function | state [ function, ... ]. A string after a single function may be a string
// option.
scene::ShaderList read_state_shaders(Parse& parse) {
  if (!parse.in.accept_punct('[')) return {read_shader(parse)};
  scene::ShaderList list;
  while (!parse.in.accept_punct(']')) {
    if (!list.empty()) parse.in.accept_punct(',');
    if (!at_shader(parse)) parse.unexpected("a shader or ']'");
    list.push_back(read_shader(parse));
  }
  return list;
}

void read_option(Parse& parse, scene::Options& options, StatementList& statements) {
  const SourceLocation at = parse.in.where();
  if (parse.in.at(Token::Kind::String)) return statements.add(read_string_option(parse));
  if (parse.in.accept_word("data")) return statements.add(read_data_reference(parse, at));
  if (parse.in.accept_word("approximate"))
    return statements.add(read_approximate(parse, "approximate", at));
  if (parse.in.accept_word("traversal")) {
    // The only option with an arbitrary bare word as its value.
    scene::Statement statement{"traversal", false, {}, at};
    if (!parse.in.peek().is_name()) parse.unexpected("the name of a function");
    statement.values.push_back(read_value(parse));
    return statements.add(std::move(statement));
  }
  if (parse.in.accept_word("state")) {
    options.state = read_state_shaders(parse);
    return;
  }
  for (const std::string_view word : {"contour", "attribute"})
    if (parse.in.accept_word(word)) {
      options.uninterpreted.push_back(keep_option(parse, std::string(word), at));
      return;
    }
  if (auto statement = read_statement(parse, option_forms(), "options"))
    statements.add(std::move(*statement));
}

}  // namespace

void read_options(Parse& parse, SourceLocation at) {
  parse.element<scene::Options>("options", at, [&](scene::Options& options) {
    StatementList statements(options.statements, parse.incremental);
    while (!parse.in.at_word("end")) read_option(parse, options, statements);
    parse.expect_end("options");
  });
}

}  // namespace oriel::mi
