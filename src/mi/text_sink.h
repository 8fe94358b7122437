// SPDX-License-Identifier: Apache-2.0
// Text on its way to a stream: numbers in their shortest exact form, strings in quotes.
#pragma once

#include <cstdint>
#include <memory>
#include <ostream>
#include <string_view>

namespace oriel::mi {

/// A buffer in front of a stream. Every number it writes reads back as the same number.
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
  /// The language has no spelling for what is not finite: infinities become the largest number,
  /// not-a-number 0.
  void number(float value);
  void number(double value);
  /// With a point or an exponent even when it is whole.
  void scalar(double value);
  /// Whole numbers without point and exponent, whatever their size.
  void integer(double value);
  /// In quotes, quotes within escaped. A backslash at the very end would escape the closing quote
  /// and has no spelling; it becomes a slash (such strings are folders).
  void quoted(std::string_view text);
  void hex(std::uint8_t byte);
  void flush();

 private:
  static constexpr std::size_t kCapacity = 1 << 16;
  // Longest fixed notation of a double.
  static constexpr std::size_t kLongestNumber = 400;
  void reserve(std::size_t bytes) {
    if (static_cast<std::size_t>(limit_ - end_) < bytes) flush();
  }
  std::ostream& stream_;
  std::unique_ptr<char[]> buffer_;
  char *end_, *limit_;
};

}  // namespace oriel::mi
