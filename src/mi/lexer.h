// SPDX-License-Identifier: Apache-2.0
// Lexer: words, strings, numbers, punctuation, hexadecimal and binary blocks.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mi/source.h"

namespace oriel::mi {

struct Token {
  enum class Kind : std::uint8_t {
    End,
    Word,    ///< unquoted: keyword or symbol
    String,  ///< text: the characters between the quotes, with escapes
    Number,
    Punct,      ///< one of = , ( ) { } [ ] %
    Hex,        ///< '00ff'
    Binary,     ///< `raw bytes`
    Directive,  ///< $word
    Bad         ///< bytes that start no token
  };
  enum class Problem : std::uint8_t { None, Unterminated, NumberRange };
  Kind kind = Kind::End;
  Problem problem = Problem::None;
  bool escaped = false;   ///< String: contains \" to be unescaped
  bool integral = false;  ///< Number: without decimal point and exponent
  std::string_view text;  ///< without quotes
  std::string_view raw;   ///< as written
  double number = 0;
  Source* source = nullptr;

  bool is_word(std::string_view word) const { return kind == Kind::Word && text == word; }
  bool is_punct(char c) const { return kind == Kind::Punct && text[0] == c; }
  bool is_name() const { return kind == Kind::String || kind == Kind::Word; }
  /// The string value: \" becomes ", other backslashes stay (Windows paths).
  std::string str() const;
};

/// Reads tokens from one source. Tokens are views of the memory of the source.
class Lexer {
 public:
  explicit Lexer(Source& source);
  void next(Token& token);
  const char* position() const { return p_; }
  void set_position(const char* p) { p_ = p; }
  Source& source() const { return *source_; }

 private:
  void lex_string(Token& token);
  void lex_number_or_word(Token& token);
  void lex_quoted_bytes(Token& token);
  void lex_binary(Token& token);
  void finish(Token& token, Token::Kind kind, const char* text_begin, const char* text_end,
              const char* end);
  Source* source_;
  const char* p_;
  /// End of an unterminated string. Quotes before this position do not open a string; otherwise a
  /// malicious file would be scanned once per quote.
  const char* forgotten_until_ = nullptr;
};

}  // namespace oriel::mi
