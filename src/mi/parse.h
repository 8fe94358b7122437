// SPDX-License-Identifier: Apache-2.0
// State shared by all element readers: tokens, diagnostics, names, the target scene.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "mi/codes.h"
#include "mi/cursor.h"
#include "scene/scene.h"

namespace oriel::mi {

// Conventions
//   Readers are free functions on a Parse (elements.h), called after their keyword was consumed. A
//   syntax error is reported at its location and then thrown as SyntaxError. The nearest element()
//   catches it, skips to the end of the element and keeps the part that was read.

/// A syntax error that was already reported.
struct SyntaxError {};

/// State while reading one file.
class Parse {
 public:
  Parse(const ReadOptions& read_options, Diagnostics& messages);

  Cursor in;
  const ReadOptions& options;
  Diagnostics& diagnostics;
  scene::Scene* scene = nullptr;
  scene::Phenomenon* phenomenon = nullptr;      ///< not null inside its body
  bool incremental = false;                     ///< the current element changes an existing one
  bool tagged = false;                          ///< material labels in the current object
  int depth = 0;                                ///< current nesting of values and shaders
  std::set<std::string, std::less<>> reported;  ///< undefined names already reported

  // Messages ------------------------------------------------------------------------------------
  void warn(code::Code code, SourceLocation at, std::string message, std::string hint = {}) {
    diagnostics.warning(code, at, std::move(message), std::move(hint));
  }
  /// Throws after the error "expected X, found Y" at the next token. The most similar of
  /// `candidates` becomes the hint.
  [[noreturn]] void unexpected(std::string_view wanted,
                               std::span<const std::string> candidates = {});
  /// The token as shown in diagnostics: shortened, with its quotes.
  std::string shown(const Token& token) const;

  // Tokens --------------------------------------------------------------------------------------
  std::string name(std::string_view what);  ///< string or unquoted word
  void expect_word(std::string_view word);
  void expect_punct(char c);
  /// Consumes `end kind`.
  void expect_end(std::string_view kind);
  bool at_number() { return in.at(Token::Kind::Number); }
  double number(std::string_view what);
  float real(std::string_view what);  ///< as number(), clamped to the range of float
  int integer(std::string_view what);
  bool boolean_or(bool otherwise);  ///< on, off, true, false; default `otherwise`
  static bool is_boolean(const Token& token, bool& value);

  // Names ---------------------------------------------------------------------------------------
  void enter_namespace(std::string name) { namespaces_.push_back(std::move(name)); }
  bool leave_namespace();
  std::string defined_name(std::string name) const;     ///< with the namespace prefix
  std::string referenced_name(std::string name) const;  ///< with the prefix; a leading :: is global
  std::string shader_type_name(std::string name) const;
  std::string text_value(std::string name) const;  ///< prefixed only if that names an element

  // Where things go -----------------------------------------------------------------------------
  /// Reads the body of an element with `body(T&)` and adds the element to the scene or the
  /// phenomenon. `body` starts from the existing element if `incremental` is set.
  template <class T, class Body>
  void element(std::string_view kind, SourceLocation at, Body body);
  void add(scene::Element element);
  void declare(scene::ShaderDeclaration declaration);
  void declare(scene::Phenomenon phenomenon);
  /// Declaration of a shader or phenomenon in this file, or null.
  const scene::ShaderDeclaration* declaration(const std::string& type) const;

  /// Whether the token is in the first column and can only begin a top-level element.
  static bool starts_element(const Token& token);
  /// Skips to the end of the broken element: after its `end kind`, or before the next first-column
  /// word that can only begin a top-level statement.
  void recover(std::string_view kind);

 private:
  std::string prefix() const;
  void check_redefinition(const std::string& name, SourceLocation at);
  std::vector<std::string> namespaces_;
  std::unordered_map<std::string, std::size_t> declaration_index_, phenomenon_index_;
};

template <class T, class Body>
void Parse::element(std::string_view kind, SourceLocation at, Body body) {
  T fresh;
  try {
    if (!in.peek().is_name()) unexpected("the name of this " + std::string(kind));
    fresh.name = defined_name(name("name"));
    T* existing = phenomenon ? nullptr : scene->get<T>(fresh.name);
    if (incremental && existing) fresh = std::move(*existing);
    if (incremental && !existing)
      warn(code::kNotThere, at,
           "incremental " + std::string(kind) + " \"" + fresh.name + "\" was not there before");
    if (!incremental) check_redefinition(fresh.name, at);
    fresh.where = at;
    body(fresh);
  } catch (const SyntaxError&) {
    recover(kind);
  }
  if (!fresh.name.empty()) add(std::move(fresh));
}

/// Counts nested values and throws at the nesting limit, before a stack overflow.
class Nesting {
 public:
  explicit Nesting(Parse& parse);
  ~Nesting() { --parse_.depth; }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;

 private:
  Parse& parse_;
};

}  // namespace oriel::mi
