// SPDX-License-Identifier: Apache-2.0
// Values as a scene file writes them, before any declaration has given them a type.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace oriel::scene {

struct Argument;

/// One value of a parameter or statement, as written. The declared type is applied when the value
/// is bound (runtime/bind.h), so a value can be kept and written back even with an unknown
/// shader.
struct Value {
  enum class Kind : std::uint8_t {
    Null,        ///< `null`
    Boolean,     ///< on off true false
    Numbers,     ///< one or more numbers in a row
    Text,        ///< quoted string or bare symbol
    Connection,  ///< = "shader" or = "shader.member"; text holds the name
    Interface,   ///< = interface "parameter"; text holds the name
    Struct,      ///< { parameters }; members
    Array        ///< [ values, ... ]; items
  };
  Kind kind = Kind::Null;
  bool boolean = false;
  bool integral = false;        ///< Numbers: all were written without point and exponent
  std::vector<double> numbers;  ///< double: labels and tags up to 2^32 must survive
  std::string text;
  bool bare = false;  ///< Text: written without quotes (`filter gauss`); not compared
  std::vector<Value> items;
  std::vector<Argument> members;
  SourceLocation where;

  friend bool operator==(const Value&, const Value&);
};

/// "name" value
struct Argument {
  std::string name;
  Value value;
  SourceLocation where;
  friend bool operator==(const Argument&, const Argument&);
};

/// A statement that is a keyword (of one or more words, joined by single blanks) and values:
/// `trace depth 2 2 4`, `shadow on`, `"finalgather mode" "automatic"`. Keeps what was written, in
/// order, for meaning to be read from it by name.
struct Statement {
  std::string keyword;
  bool quoted = false;  ///< a string option: the keyword stood in quotes
  std::vector<Value> values;
  SourceLocation where;
  friend bool operator==(const Statement&, const Statement&);
};

/// A construct that is read, kept and written back, but has no meaning to this renderer: free-form
/// surfaces, subdivision, hair, gui blocks... `text` is its source after the keyword, tokens
/// separated by blanks.
struct UninterpretedStatement {
  std::string keyword;
  std::string text;
  SourceLocation where;
  bool operator==(const UninterpretedStatement&) const = default;
};

}  // namespace oriel::scene
