// SPDX-License-Identifier: Apache-2.0
// What the readers of all elements share: tokens, messages, names, where elements go.
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
//   Readers are free functions on a Parse (elements.h). A reader is entered after its keyword was
//   consumed. A syntax error is reported where it is found and then thrown as SyntaxError; the
//   nearest element() catches it, skips to the element's end and keeps what was read so far.

/// A syntax error that has been reported already.
struct SyntaxError {};

/// State while reading one file.
class Parse {
 public:
  Parse(const ReadOptions& read_options, Diagnostics& messages);

  Cursor in;
  const ReadOptions& options;
  Diagnostics& diagnostics;
  scene::Scene* scene = nullptr;
  scene::Phenomenon* phenomenon = nullptr;      ///< while reading the body of one
  bool incremental = false;                     ///< the element being read re-opens an existing one
  bool tagged = false;                          ///< the object being read has labels for materials
  int depth = 0;                                ///< of nested values and shaders, see Nesting
  std::set<std::string, std::less<>> reported;  ///< unknown names that have been reported

  // Messages ------------------------------------------------------------------------------------
  void warn(code::Code code, SourceLocation at, std::string message, std::string hint = {}) {
    diagnostics.warning(code, at, std::move(message), std::move(hint));
  }
  /// "expected X, found Y", at the next token, with the nearest of `candidates` as a hint.
  [[noreturn]] void unexpected(std::string_view wanted,
                               std::span<const std::string> candidates = {});
  /// The token as a message shows it: shortened, with its quotes.
  std::string shown(const Token& token) const;

  // Tokens --------------------------------------------------------------------------------------
  std::string name(std::string_view what);  ///< string or unquoted symbol
  void expect_word(std::string_view word);
  void expect_punct(char c);
  /// `end kind`, both words consumed.
  void expect_end(std::string_view kind);
  bool at_number() { return in.at(Token::Kind::Number); }
  double number(std::string_view what);
  float real(std::string_view what);  ///< as number(), clamped to the range of float
  int integer(std::string_view what);
  bool boolean_or(bool otherwise);  ///< on off true false, or `otherwise` when none stands here
  static bool is_boolean(const Token& token, bool& value);

  // Names ---------------------------------------------------------------------------------------
  void enter_namespace(std::string name) { namespaces_.push_back(std::move(name)); }
  bool leave_namespace();
  std::string defined_name(std::string name) const;     ///< with the prefix of the namespace
  std::string referenced_name(std::string name) const;  ///< the same; a leading :: leads outside
  std::string shader_type_name(std::string name) const;
  std::string text_value(std::string name) const;  ///< prefixed only when that names an element

  // Where things go -----------------------------------------------------------------------------
  /// Reads the body of an element by `body(T&)` and adds it to the scene or the phenomenon.
  /// `T` is taken over from the existing element when incremental.
  template <class T, class Body>
  void element(std::string_view kind, SourceLocation at, Body body);
  void add(scene::Element element);
  void declare(scene::ShaderDeclaration declaration);
  void declare(scene::Phenomenon phenomenon);
  /// Declaration or outside of a phenomenon in this file, or null.
  const scene::ShaderDeclaration* declaration(const std::string& type) const;

  /// Whether this word, in the first column, can only begin an element of the top level.
  static bool starts_element(const Token& token);
  /// Skips to the end of the broken element: behind its `end kind`, or before the next statement
  /// that stands in the first column and can only be one of the top level.
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

/// Counts levels of nested values; stops the reader before the stack ends.
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
