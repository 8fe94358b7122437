// SPDX-License-Identifier: Apache-2.0
// Untyped values as written in a scene file.
#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace oriel::scene {

struct Argument;

/// One value of a parameter or statement, as written. The declared type is applied when the value
/// is bound (runtime/bind.h), so values of unknown shaders can be stored and written too.
struct Value {
  enum class Kind : std::uint8_t {
    Null,        ///< `null`
    Boolean,     ///< on off true false
    Numbers,     ///< one or more consecutive numbers
    Text,        ///< quoted string or bare symbol
    Connection,  ///< = "shader" or = "shader.member"; text is the name
    Interface,   ///< = interface "parameter"; text is the name
    Struct,      ///< { parameters }; members
    Array        ///< [ values, ... ]; items
  };
  Kind kind = Kind::Null;
  bool boolean = false;
  bool integral = false;        ///< Numbers: all written without decimal point and exponent
  std::vector<double> numbers;  ///< double: exact for labels and tags up to 2^32
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

/// A statement that consists of a keyword (one or more words, joined by single blanks) and values:
/// `trace depth 2 2 4`, `shadow on`, `"finalgather mode" "automatic"`. Values are as written.
struct Statement {
  std::string keyword;
  bool quoted = false;  ///< a string option: the keyword was in quotes
  std::vector<Value> values;
  SourceLocation where;
  friend bool operator==(const Statement&, const Statement&);
};

/// A construct that is read, stored and written, but not interpreted: gui blocks, pass blocks etc.
/// `text` is its source after the keyword, tokens separated by blanks.
struct UninterpretedStatement {
  std::string keyword;
  std::string text;
  SourceLocation where;
  bool operator==(const UninterpretedStatement&) const = default;
};

}  // namespace oriel::scene
