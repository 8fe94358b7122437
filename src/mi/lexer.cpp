// SPDX-License-Identifier: Apache-2.0
#include "mi/lexer.h"

#include <cstring>

#include "mi/number.h"

namespace oriel::mi {
namespace {

// Character classes: 1 word character, 2 starts a number, 4 digit, 8 punctuation.
struct CharacterClasses {
  std::uint8_t of[256] = {};
  constexpr CharacterClasses() {
    for (int c = 'a'; c <= 'z'; ++c) of[c] = of[c - 32] = 1;
    for (int c = 0x80; c < 0x100; ++c) of[c] = 1;  // UTF-8 in an unquoted name
    of[static_cast<int>('_')] = 1;
    for (int c = '0'; c <= '9'; ++c) of[c] = 2 | 4;
    of[static_cast<int>('+')] = of[static_cast<int>('-')] = of[static_cast<int>('.')] = 2;
    for (const char c : {'=', ',', '(', ')', '{', '}', '[', ']', '%'})
      of[static_cast<unsigned char>(c)] = 8;
  }
};
constexpr CharacterClasses kClasses;
constexpr std::uint8_t kWordStart = 1, kNumberStart = 2, kDigit = 4, kPunct = 8;

std::uint8_t class_of(char c) { return kClasses.of[static_cast<unsigned char>(c)]; }
bool is_word_character(char c) { return class_of(c) & (kWordStart | kDigit); }

}  // namespace

std::string Token::str() const {
  if (!escaped) return std::string(text);
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '"') ++i;
    result += text[i];
  }
  return result;
}

Lexer::Lexer(Source& source) : source_(&source), p_(source.begin()) {
  if (source.size() >= 3 && std::memcmp(p_, "\xef\xbb\xbf", 3) == 0) p_ += 3;  // byte order mark
}

void Lexer::finish(Token& token, Token::Kind kind, const char* text_begin, const char* text_end,
                   const char* end) {
  token.kind = kind;
  token.text = {text_begin, static_cast<std::size_t>(text_end - text_begin)};
  token.raw = {p_, static_cast<std::size_t>(end - p_)};
  p_ = end;
}

void Lexer::next(Token& token) {
  const char* const end = source_->end();
  token.problem = Token::Problem::None;
  token.escaped = false;
  token.source = source_;
  for (;;) {
    while (static_cast<unsigned char>(*p_) <= ' ' && *p_ != 0) ++p_;
    if (*p_ != '#') break;
    const void* newline = std::memchr(p_, source_->newline(), static_cast<std::size_t>(end - p_));
    p_ = newline ? static_cast<const char*>(newline) : end;
  }
  const char c = *p_;
  const std::uint8_t type = class_of(c);
  if (type & kWordStart) {
    const char* q = p_ + 1;
    while (is_word_character(*q)) ++q;
    return finish(token, Token::Kind::Word, p_, q, q);
  }
  if (type & kNumberStart) return lex_number_or_word(token);
  if (type & kPunct) return finish(token, Token::Kind::Punct, p_, p_ + 1, p_ + 1);
  if (c == '"') return lex_string(token);
  if (c == '\'') return lex_quoted_bytes(token);
  if (c == '`') return lex_binary(token);
  if (p_ >= end) return finish(token, Token::Kind::End, end, end, end);
  const char* q = p_ + 1;
  if (c == '$') {
    while (is_word_character(*q)) ++q;
    return finish(token, Token::Kind::Directive, p_ + 1, q, q);
  }
  // One token for all consecutive invalid bytes, so that a binary file produces one message.
  while (q < end && class_of(*q) == 0 && *q != '"' && *q != '\'' && *q != '`' && *q != '$' &&
         *q != '#' && *q != source_->newline())
    ++q;
  finish(token, Token::Kind::Bad, p_, q, q);
}

void Lexer::lex_number_or_word(Token& token) {
  ScannedNumber number;
  if (scan_number(p_, number)) {
    token.number = number.value;
    token.integral = number.integral;
    if (number.overflow) token.problem = Token::Problem::NumberRange;
    return finish(token, Token::Kind::Number, p_, number.end, number.end);
  }
  // E.g. 3dsmax or 1.2.3: becomes a word, which the error message quotes.
  const char* q = p_ + 1;
  while (is_word_character(*q) || *q == '.') ++q;
  const bool word = class_of(*p_) & kDigit;
  finish(token, word ? Token::Kind::Word : Token::Kind::Bad, p_, q, q);
}

void Lexer::lex_string(Token& token) {
  const char* const end = source_->end();
  const char* const start = p_ + 1;
  if (p_ < forgotten_until_) return finish(token, Token::Kind::Bad, p_, start, start);
  const char* q = start;
  for (;;) {
    q = static_cast<const char*>(std::memchr(q, '"', static_cast<std::size_t>(end - q)));
    if (!q || q == start || q[-1] != '\\') break;
    token.escaped = true;
    ++q;
  }
  // Detects a missing closing quote: the string spans a line end, and a word follows its end
  // directly, as it follows an opening quote.
  const void* newline =
      std::memchr(start, source_->newline(), static_cast<std::size_t>((q ? q : end) - start));
  if (!q || (newline && (class_of(q[1]) & kWordStart))) {
    token.problem = Token::Problem::Unterminated;
    forgotten_until_ = q ? q : end;
    const char* stop = newline && q ? static_cast<const char*>(newline) : end;
    return finish(token, Token::Kind::String, start, stop, stop);
  }
  finish(token, Token::Kind::String, start, q, q + 1);
}

void Lexer::lex_quoted_bytes(Token& token) {
  const char* q = p_ + 1;
  const auto hex = [](char c) {
    return (class_of(c) & kDigit) || ((c | 0x20) >= 'a' && (c | 0x20) <= 'f');
  };
  while (hex(*q) || (static_cast<unsigned char>(*q) <= ' ' && *q != 0)) ++q;
  if (*q != '\'') {
    // `code '...'` contains text instead of digits.
    const void* close = std::memchr(q, '\'', static_cast<std::size_t>(source_->end() - q));
    q = close ? static_cast<const char*>(close) : source_->end();
    if (!close) token.problem = Token::Problem::Unterminated;
  }
  finish(token, Token::Kind::Hex, p_ + 1, q, q < source_->end() ? q + 1 : q);
}

void Lexer::lex_binary(Token& token) {
  // The payload may contain the closing character. Cursor::binary() handles blocks of known size.
  // Here a block is assumed to consist of whole floats, followed by a blank or punctuation.
  const char* const end = source_->end();
  const char* q = p_ + 1;
  for (; q < end; q += 4)
    if (*q == '`' &&
        (q + 1 == end || static_cast<unsigned char>(q[1]) <= ' ' || (class_of(q[1]) & kPunct)))
      return finish(token, Token::Kind::Binary, p_ + 1, q, q + 1);
  token.problem = Token::Problem::Unterminated;
  finish(token, Token::Kind::Binary, p_ + 1, end, end);
}

}  // namespace oriel::mi
