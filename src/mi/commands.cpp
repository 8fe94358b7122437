// SPDX-License-Identifier: Apache-2.0
// Top-level commands, and the table from element keywords to readers.
#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "mi/elements.h"
#include "mi/placeholder.h"
#include "mi/statements.h"

namespace oriel::mi {
namespace {

scene::Value text(std::string content, SourceLocation at) {
  scene::Value value;
  value.kind = scene::Value::Kind::Text;
  value.text = std::move(content);
  value.where = at;
  return value;
}

// Stores a command without effect on the reader: its keyword and the plain values after it.
void keep_command(Parse& parse, std::string keyword, SourceLocation at, int most_strings) {
  scene::Statement statement{std::move(keyword), false, {}, at};
  for (;;) {
    const SourceLocation here = parse.in.where();
    bool flag = false;
    if (parse.at_number()) {
      statement.values.push_back(read_numbers(parse));
    } else if (Parse::is_boolean(parse.in.peek(), flag)) {
      statement.values.push_back(read_value(parse));
    } else if (most_strings > 0 && parse.in.at(Token::Kind::String)) {
      statement.values.push_back(text(parse.in.next().str(), here));
      --most_strings;
    } else {
      break;
    }
  }
  parse.scene->commands.push_back(std::move(statement));
}

void read_set(Parse& parse, SourceLocation at) {
  const SourceLocation here = parse.in.where();
  const std::string variable = parse.name("the name of a variable");
  // Set before the next token is fetched, which may be an $ifdef on this variable.
  std::string& value = parse.in.variables()[variable];
  value.clear();
  scene::Statement statement{"set", false, {text(variable, here)}, at};
  if (parse.in.at(Token::Kind::String)) {
    const SourceLocation there = parse.in.where();
    value = parse.in.next().str();
    statement.values.push_back(text(value, there));
  }
  parse.scene->commands.push_back(std::move(statement));
}

// `system` is never run. The host compiles `code` if ReadOptions::trusts_code is set.
void refuse(Parse& parse, std::string keyword, SourceLocation at) {
  if (keyword == "system")
    parse.warn(code::kRefused, at, "'system' is never run from a scene",
               "the statement is kept and has no effect");
  else if (!parse.options.trusts_code)
    parse.warn(code::kRefused, at, "'code' of a scene is not compiled or run",
               std::string(code::kTrustHint));
  scene::Statement statement{std::move(keyword), false, {}, at};
  while (parse.in.at(Token::Kind::String) || parse.in.at(Token::Kind::Hex)) {
    const SourceLocation here = parse.in.where();
    const bool only = parse.in.at(Token::Kind::String);
    statement.values.push_back(text(parse.in.next().str(), here));
    statement.values.back().bare = !only;
    if (only) break;
  }
  parse.scene->commands.push_back(std::move(statement));
}

void read_call_command(Parse& parse, SourceLocation at) {
  parse.warn(code::kRefused, at, "'call' is not run; the statement has no effect");
  read_shader_list(parse);
  if (!parse.in.accept_punct(',')) return;
  parse.name("a camera instance");
  parse.name("an options element");
}

void reject_frame(Parse& parse, std::string_view word, SourceLocation at) {
  parse.diagnostics.error(
      code::kObsolete, at,
      fmt::format("'{}' is the scene form of mental ray 1.9, which is not supported", word),
      "newer files define options, camera, instgroup and end with render");
  parse.recover(word);
}

void read_delete(Parse& parse) {
  const SourceLocation at = parse.in.where();
  const std::string name = parse.referenced_name(parse.name("the name of an element"));
  if (!parse.scene->remove(name))
    parse.warn(code::kNotThere, at, fmt::format("there is no element \"{}\" to delete", name));
}

void read_touch(Parse& parse, SourceLocation at) {
  const SourceLocation here = parse.in.where();
  const std::string name = parse.referenced_name(parse.name("the name of an element"));
  if (!parse.scene->touch(name))
    parse.warn(code::kNotThere, here, fmt::format("there is no element \"{}\" to touch", name));
  parse.scene->commands.push_back({"touch", false, {text(name, here)}, at});
}

void read_render(Parse& parse, SourceLocation at) {
  scene::RenderCommand render;
  render.where = at;
  render.root = parse.referenced_name(parse.name("the root group"));
  render.camera = parse.referenced_name(parse.name("the camera instance"));
  render.options = parse.referenced_name(parse.name("the options"));
  parse.scene->renders.push_back(render);
  load_placeholders(parse);
  report_unresolved(parse, render);
}

using ElementReader = std::function<void(Parse&, SourceLocation)>;

const std::map<std::string, ElementReader, std::less<>>& element_readers() {
  const auto uninterpreted = [](std::string_view kind) {
    return [kind](Parse& p, SourceLocation at) { read_uninterpreted_element(p, kind, at); };
  };
  const auto texture = [](std::string_view word) {
    return [word](Parse& p, SourceLocation at) { read_texture(p, word, at); };
  };
  static const std::map<std::string, ElementReader, std::less<>> readers{
      {"options", read_options},
      {"camera", read_camera},
      {"light", read_light},
      {"material", read_material},
      {"object", read_object},
      {"instance", read_instance},
      {"instgroup", read_instance_group},
      {"shader", read_shader_element},
      {"lightprofile", read_light_profile},
      {"local", texture("local")},
      {"filter", texture("filter")},
      {"writable", texture("writable")},
      {"color", texture("color")},
      {"scalar", texture("scalar")},
      {"vector", texture("vector")},
      {"data", read_user_data},
      {"gui", uninterpreted("gui")},
      {"assembly", read_assembly},
      {"colorprofile", uninterpreted("colorprofile")},
      {"spectrum", uninterpreted("spectrum")},
      {"registry", uninterpreted("registry")}};
  return readers;
}

const std::vector<std::string>& top_level_words() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> list{
        "verbose", "version",   "min",    "max",    "set",    "link",    "code",       "declare",
        "touch",   "namespace", "root",   "delete", "render", "private", "session",    "call",
        "echo",    "system",    "memory", "debug",  "frame",  "view",    "incremental"};
    for (const auto& [word, reader] : element_readers()) list.push_back(word);
    return list;
  }();
  return words;
}

// private | session depth N: scope hints for integrations, without effect on the scene.
bool skip_scope(Parse& parse, std::string_view word, SourceLocation at) {
  if (word != "private" && word != "session") return false;
  if (word == "session") {
    parse.expect_word("depth");
    parse.number("a depth");
  }
  parse.diagnostics.note(code::kIgnored, at, fmt::format("'{}' has no meaning here", word));
  return true;
}

void read_end_namespace(Parse& parse) {
  parse.expect_word("namespace");
  if (!parse.leave_namespace())
    parse.warn(code::kSyntax, parse.in.where(), "'end namespace' without a namespace");
}

// Statements that begin with two words or change the state of the reader.
bool read_special(Parse& parse, std::string_view word, SourceLocation at) {
  if (word == "set") {
    read_set(parse, at);
  } else if (word == "link" || word == "echo" || word == "root") {
    keep_command(parse, std::string(word), at, 1);
  } else if (word == "version" || word == "verbose" || word == "memory") {
    keep_command(parse, std::string(word), at, word == "version" ? 1 : 0);
  } else if (word == "debug") {
    keep_command(parse, "debug", at, 2);
  } else if (word == "touch") {
    read_touch(parse, at);
  } else if (word == "min" || word == "max") {
    parse.expect_word("version");
    keep_command(parse, std::string(word) + " version", at, 1);
  } else if (word == "system" || word == "code") {
    refuse(parse, std::string(word), at);
  } else if (word == "declare") {
    read_declare(parse, at);
  } else if (word == "delete") {
    read_delete(parse);
  } else if (word == "call") {
    read_call_command(parse, at);
  } else if (word == "namespace") {
    parse.enter_namespace(parse.name("the name of the namespace"));
  } else if (word == "end") {
    read_end_namespace(parse);
  } else if (word == "frame" || word == "view") {
    reject_frame(parse, word, at);
  } else {
    return false;
  }
  return true;
}

void take_over(Parse& parse) {
  for (std::string& name : parse.in.take_packages()) {
    auto& packages = parse.scene->packages;
    if (std::find(packages.begin(), packages.end(), name) == packages.end())
      packages.push_back(std::move(name));
  }
  for (auto& [body, at] : parse.in.take_code())
    parse.scene->commands.push_back({"$code", false, {text(std::move(body), at)}, at});
}

bool read_one(Parse& parse) {
  SourceLocation at = parse.in.where();
  if (!parse.in.at(Token::Kind::Word)) parse.unexpected("a statement", top_level_words());
  std::string word(parse.in.next().text);
  parse.incremental = false;
  while (word == "incremental" || skip_scope(parse, word, at)) {
    parse.incremental |= word == "incremental";
    at = parse.in.where();
    if (!parse.in.at(Token::Kind::Word)) parse.unexpected("an element");
    word = parse.in.next().text;
  }
  if (word == "render") {
    read_render(parse, at);
    return true;
  }
  if (read_special(parse, word, at)) return false;
  const auto reader = element_readers().find(word);
  if (reader != element_readers().end()) {
    reader->second(parse, at);
    return false;
  }
  const std::string near = nearest_name(word, top_level_words());
  parse.diagnostics.error(code::kSyntax, at,
                          fmt::format("unknown statement '{}'", word.substr(0, 40)),
                          near.empty() ? "" : "did you mean " + near + "?");
  throw SyntaxError{};
}

}  // namespace

void finish_reading(Parse& parse) {
  // Results of $ directives after the last statement.
  take_over(parse);
  parse.in.report_missing_includes(true);  // without `render`, no name is known to be used
}

bool read_top_level(Parse& parse) {
  parse.in.release_finished_sources();
  parse.in.forget_what_was_read();
  bool rendered = false;
  // A syntax error may leave the position unchanged; the token is then skipped to make progress.
  const Token before = parse.in.peek();
  parse.depth = 0;
  try {
    rendered = read_one(parse);
  } catch (const SyntaxError&) {
    if (parse.in.peek().raw.data() == before.raw.data()) parse.in.next();
    parse.recover("");
  }
  take_over(parse);
  return rendered;
}

}  // namespace oriel::mi
