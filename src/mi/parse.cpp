// SPDX-License-Identifier: Apache-2.0
#include "mi/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace oriel::mi {
namespace {

// Words that always begin a top-level statement when they are in the first column.
constexpr std::string_view kUnmistakable[] = {
    "options", "camera",    "object",      "instance", "instgroup", "render",      "declare",
    "link",    "namespace", "incremental", "delete",   "assembly",  "lightprofile"};
// Words that also occur inside other elements. They end only elements that cannot contain them.
constexpr std::string_view kAmbiguous[] = {"light", "material", "shader", "texture",
                                           "data",  "gui",      "color",  "scalar",
                                           "local", "set",      "verbose"};

template <std::size_t N>
bool contains(const std::string_view (&words)[N], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

bool in_first_column(const Token& token) {
  return token.raw.data() == token.source->begin() ||
         token.raw.data()[-1] == token.source->newline();
}

}  // namespace

Parse::Parse(const ReadOptions& read_options, Diagnostics& messages)
    : in(read_options, messages), options(read_options), diagnostics(messages) {}

std::string Parse::shown(const Token& token) const {
  if (token.kind == Token::Kind::End) return "the end of the file";
  if (token.kind == Token::Kind::Binary) return "a binary block";
  constexpr std::size_t kLongest = 40;
  std::string text(token.raw.substr(0, token.raw.find_first_of("\n\r")));
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return token.kind == Token::Kind::String ? text : "'" + text + "'";
}

void Parse::unexpected(std::string_view wanted, std::span<const std::string> candidates) {
  const Token token = in.peek();
  const bool end = token.kind == Token::Kind::End;
  std::string hint;
  if (!candidates.empty() && token.is_name()) {
    const std::string near = nearest_name(token.text, candidates);
    if (!near.empty()) hint = "did you mean " + near + "?";
  }
  diagnostics.error(end ? code::kUnclosed : code::kSyntax, in.locate(token),
                    fmt::format("expected {}, found {}", wanted, shown(token)), std::move(hint));
  throw SyntaxError{};
}

std::string Parse::name(std::string_view what) {
  if (!in.peek().is_name()) unexpected(what);
  return in.next().str();
}

void Parse::expect_word(std::string_view word) {
  if (!in.accept_word(word)) unexpected(fmt::format("'{}'", word));
}

void Parse::expect_punct(char c) {
  if (!in.accept_punct(c)) unexpected(fmt::format("'{}'", c));
}

void Parse::expect_end(std::string_view kind) {
  expect_word("end");
  expect_word(kind);
}

double Parse::number(std::string_view what) {
  if (!at_number()) unexpected(what);
  return in.next().number;
}

float Parse::real(std::string_view what) {
  const SourceLocation at = in.where();
  const double value = number(what);
  if (std::abs(value) <= FLT_MAX) return static_cast<float>(value);
  warn(code::kNumberRange, at, fmt::format("number {} is too large and was clamped", value));
  return value < 0 ? -FLT_MAX : FLT_MAX;
}

int Parse::integer(std::string_view what) {
  const double value = number(what);
  return static_cast<int>(std::clamp(value, -2147483648.0, 2147483647.0));
}

bool Parse::is_boolean(const Token& token, bool& value) {
  if (token.kind != Token::Kind::Word) return false;
  const bool yes = token.text == "on" || token.text == "true";
  if (!yes && token.text != "off" && token.text != "false") return false;
  value = yes;
  return true;
}

bool Parse::boolean_or(bool otherwise) {
  bool value = otherwise;
  if (is_boolean(in.peek(), value)) in.next();
  return value;
}

bool Parse::leave_namespace() {
  if (namespaces_.empty()) return false;
  namespaces_.pop_back();
  return true;
}

std::string Parse::prefix() const {
  std::string result;
  for (const std::string& n : namespaces_) result += n + "::";
  return result;
}

std::string Parse::defined_name(std::string name) const {
  if (name.starts_with("::")) return name.substr(2);
  return namespaces_.empty() || phenomenon ? name : prefix() + name;
}

std::string Parse::referenced_name(std::string name) const {
  if (name.starts_with("::")) return name.substr(2);
  if (phenomenon || name.empty() || namespaces_.empty()) return name;
  return prefix() + name;
}

std::string Parse::shader_type_name(std::string name) const {
  if (name.starts_with("::")) return name.substr(2);
  if (namespaces_.empty()) return name;
  // Shader libraries are declared globally; only types declared in the namespace have the prefix.
  std::string inner = prefix() + name;
  return declaration(inner) ? inner : name;
}

std::string Parse::text_value(std::string name) const {
  if (namespaces_.empty()) return name;
  if (name.starts_with("::") && scene->find(name.substr(2))) return name.substr(2);
  std::string inner = prefix() + name;
  return scene->find(inner) ? inner : name;
}

void Parse::check_redefinition(const std::string& element, SourceLocation at) {
  if (phenomenon || !scene->find(element)) return;
  warn(code::kRedefined, at,
       fmt::format("\"{}\" is defined again; the later definition holds", element),
       "write incremental to change an existing element");
}

void Parse::add(scene::Element element) {
  if (phenomenon) {
    if (auto* s = std::get_if<scene::ShaderElement>(&element))
      return phenomenon->shaders.push_back(std::move(*s));
    if (auto* m = std::get_if<scene::Material>(&element))
      return phenomenon->materials.push_back(std::move(*m));
    if (auto* l = std::get_if<scene::Light>(&element))
      return phenomenon->lights.push_back(std::move(*l));
    if (auto* i = std::get_if<scene::Instance>(&element))
      return phenomenon->instances.push_back(std::move(*i));
  }
  scene->add(std::move(element));
}

void Parse::declare(scene::ShaderDeclaration d) {
  auto& list = scene->declarations;
  const auto [entry, is_new] = declaration_index_.try_emplace(d.name, list.size());
  if (is_new || entry->second >= list.size() || list[entry->second].name != d.name) {
    entry->second = list.size();
    list.push_back(std::move(d));
  } else {
    list[entry->second] = std::move(d);
  }
}

void Parse::declare(scene::Phenomenon p) {
  auto& list = scene->phenomena;
  const std::string& type = p.declaration.name;
  const auto [entry, is_new] = phenomenon_index_.try_emplace(type, list.size());
  if (is_new || entry->second >= list.size() || list[entry->second].declaration.name != type) {
    entry->second = list.size();
    list.push_back(std::move(p));
  } else {
    list[entry->second] = std::move(p);
  }
}

const scene::ShaderDeclaration* Parse::declaration(const std::string& type) const {
  if (const auto d = declaration_index_.find(type);
      d != declaration_index_.end() && d->second < scene->declarations.size())
    return &scene->declarations[d->second];
  if (const auto p = phenomenon_index_.find(type);
      p != phenomenon_index_.end() && p->second < scene->phenomena.size())
    return &scene->phenomena[p->second].declaration;
  return nullptr;
}

bool Parse::starts_element(const Token& token) {
  return token.kind == Token::Kind::Word && in_first_column(token) &&
         contains(kUnmistakable, token.text);
}

void Parse::recover(std::string_view kind) {
  const bool may_hold_others = kind == "instance" || kind == "options" || kind == "camera" ||
                               kind == "material" || kind == "declare" || kind == "light";
  for (;;) {
    const Token& token = in.peek();
    if (token.kind == Token::Kind::End) return;
    if (token.kind == Token::Kind::Word) {
      if (token.text == "end") {
        in.next();
        if (in.accept_word(kind)) return;
        continue;
      }
      // `object space` and `camera space` are statements of options.
      const bool option = kind == "options" && (token.text == "object" || token.text == "camera");
      if ((starts_element(token) && !option) ||
          (!may_hold_others && in_first_column(token) && contains(kAmbiguous, token.text)))
        return;
    }
    in.next();
  }
}

Nesting::Nesting(Parse& parse) : parse_(parse) {
  if (++parse.depth > parse.options.limits.nesting) {
    --parse.depth;
    parse.diagnostics.error(
        code::kNesting, parse.in.where(),
        fmt::format("values are nested more than {} levels deep", parse.options.limits.nesting));
    throw SyntaxError{};
  }
}

}  // namespace oriel::mi
