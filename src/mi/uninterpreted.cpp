// SPDX-License-Identifier: Apache-2.0
// Constructs that the renderer does not interpret, stored as source text, token by token.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "mi/elements.h"

namespace oriel::mi {
namespace {

bool opens(const Token& token) {
  return token.is_punct('(') || token.is_punct('[') || token.is_punct('{');
}
bool closes(const Token& token) {
  return token.is_punct(')') || token.is_punct(']') || token.is_punct('}');
}

/// Whether a registry item acts like the top-level command of the same name.
bool acts_as_command(Parse& parse, std::string_view word, SourceLocation at) {
  if (word == "link" || word == "echo" || word == "mi") return true;
  if (word == "code" && parse.options.trusts_code) return true;
  if (word == "system" || word == "code")
    parse.warn(code::kRefused, at, "a registry command of this kind is not run",
               word == "code" ? std::string(code::kTrustHint) : "");
  return false;
}

// { value | link | code | mi | spdl | echo | system "text" | symbol symbol }... end registry; the
// braces are optional. Returns the text of the items that do not act as commands.
std::string read_registry(Parse& parse) {
  std::string text;
  std::vector<std::pair<std::string, SourceLocation>> files;
  while (!parse.in.at_word("end")) {
    if (parse.in.at_end()) parse.unexpected("'end registry'");
    const SourceLocation at = parse.in.where();
    const Token word = parse.in.next();
    if (!word.is_name() || !parse.in.peek().is_name() || parse.in.at_word("end")) {
      append_source(text, word);
      continue;
    }
    const Token argument = parse.in.next();
    if (word.kind == Token::Kind::Word && argument.kind == Token::Kind::String &&
        acts_as_command(parse, word.text, at)) {
      scene::Value value;
      value.kind = scene::Value::Kind::Text;
      value.text = argument.str();
      value.where = at;
      if (word.text == "mi")
        files.emplace_back(value.text, at);
      else
        parse.scene->commands.push_back({std::string(word.text), false, {value}, at});
      continue;
    }
    append_source(text, word);
    append_source(text, argument);
  }
  parse.expect_end("registry");
  // Includes are stacked: the last one included is read first.
  for (auto file = files.rbegin(); file != files.rend(); ++file)
    parse.in.include(file->first, false, file->second);
  return text;
}

}  // namespace

void append_source(std::string& text, const Token& token) {
  if (!text.empty()) text += ' ';
  text += token.raw;
}

std::string keep_until_end(Parse& parse, std::string_view kind) {
  std::string text;
  for (;;) {
    if (parse.in.at_end()) parse.unexpected("'end " + std::string(kind) + "'");
    const Token token = parse.in.next();
    if (token.is_word("end") && parse.in.accept_word(kind)) return text;
    append_source(text, token);
  }
}

void keep_brackets(Parse& parse, std::string& text) {
  std::size_t depth = 0;
  do {
    if (parse.in.at_end()) parse.unexpected("a closing bracket");
    const Token token = parse.in.next();
    depth += opens(token);
    depth -= closes(token);
    append_source(text, token);
  } while (depth > 0);
}

std::string keep_until_word(Parse& parse, std::span<const std::string_view> words) {
  std::string text;
  while (!parse.in.at_end() && !parse.in.at_word("end")) {
    const Token& token = parse.in.peek();
    if (token.kind == Token::Kind::Word &&
        std::find(words.begin(), words.end(), token.text) != words.end())
      break;
    if (opens(token))
      keep_brackets(parse, text);
    else
      append_source(text, parse.in.next());
  }
  return text;
}

scene::UninterpretedStatement read_gui(Parse& parse, SourceLocation at) {
  scene::UninterpretedStatement uninterpreted{"gui", "", at};
  if (parse.in.peek().is_name()) append_source(uninterpreted.text, parse.in.next());
  while (parse.in.at_punct('(') || parse.in.at_punct('{')) keep_brackets(parse, uninterpreted.text);
  return uninterpreted;
}

void read_uninterpreted_element(Parse& parse, std::string_view kind, SourceLocation at) {
  parse.element<scene::UninterpretedElement>(kind, at, [&](scene::UninterpretedElement& element) {
    element.kind = kind;
    if (kind == "gui") {
      std::string text;
      while (parse.in.at_punct('(') || parse.in.at_punct('{')) keep_brackets(parse, text);
      element.text = std::move(text);
    } else if (kind == "registry") {
      element.text = read_registry(parse);
    } else {
      element.text = keep_until_end(parse, kind);
    }
  });
}

}  // namespace oriel::mi
