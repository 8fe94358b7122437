// SPDX-License-Identifier: Apache-2.0
// Text output to a stream: shortest exact numbers, quoted strings.
#pragma once

#include <cstdint>
#include <memory>
#include <ostream>
#include <string_view>

namespace oriel::mi {

/// Buffered text output. Every number reads back as the same number.
class TextSink {
 public:
  explicit TextSink(std::ostream& stream);
  ~TextSink() { flush(); }
  TextSink(const TextSink&) = delete;
  TextSink& operator=(const TextSink&) = delete;

  void put(char c) {
    reserve(1);
    *end_++ = c;
  }
  void put(std::string_view text);
  void index(std::uint32_t value);
  /// Non-finite numbers have no syntax: infinities become the largest finite number, NaN becomes 0.
  void number(float value);
  void number(double value);
  /// Writes a decimal point or an exponent, also for whole numbers.
  void scalar(double value);
  /// Writes a whole number of any size without decimal point and exponent.
  void integer(double value);
  /// Writes the text in quotes and escapes quotes inside it. A trailing backslash would escape the
  /// closing quote and becomes a slash; such strings are folders.
  void quoted(std::string_view text);
  void hex(std::uint8_t byte);
  void flush();

 private:
  static constexpr std::size_t kCapacity = 1 << 16;
  // Longest fixed notation of a double, in characters.
  static constexpr std::size_t kLongestNumber = 400;
  void reserve(std::size_t bytes) {
    if (static_cast<std::size_t>(limit_ - end_) < bytes) flush();
  }
  std::ostream& stream_;
  std::unique_ptr<char[]> buffer_;
  char *end_, *limit_;
};

}  // namespace oriel::mi
