// SPDX-License-Identifier: Apache-2.0
#include "mi/text_sink.h"

#include <charconv>
#include <cmath>
#include <limits>

namespace oriel::mi {
namespace {

template <class T>
T made_finite(T value) {
  if (std::isnan(value)) return 0;
  constexpr T kLargest = std::numeric_limits<T>::max();
  return std::isinf(value) ? (value < 0 ? -kLargest : kLargest) : value;
}

}  // namespace

TextSink::TextSink(std::ostream& stream)
    : stream_(stream),
      buffer_(std::make_unique_for_overwrite<char[]>(kCapacity)),
      end_(buffer_.get()),
      limit_(buffer_.get() + kCapacity) {}

void TextSink::flush() {
  stream_.write(buffer_.get(), end_ - buffer_.get());
  end_ = buffer_.get();
}

void TextSink::put(std::string_view text) {
  if (text.size() > kCapacity) {
    flush();
    stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
    return;
  }
  reserve(text.size());
  end_ = std::copy(text.begin(), text.end(), end_);
}

void TextSink::index(std::uint32_t value) {
  reserve(kLongestNumber);
  end_ = std::to_chars(end_, limit_, value).ptr;
}

void TextSink::number(float value) {
  reserve(kLongestNumber);
  end_ = std::to_chars(end_, limit_, made_finite(value)).ptr;
}

void TextSink::number(double value) {
  reserve(kLongestNumber);
  end_ = std::to_chars(end_, limit_, made_finite(value)).ptr;
}

void TextSink::integer(double value) {
  reserve(kLongestNumber);
  end_ = std::to_chars(end_, limit_, made_finite(value), std::chars_format::fixed).ptr;
}

void TextSink::scalar(double value) {
  constexpr double kLong = 1e15;  // above this, the exponent is shorter
  value = made_finite(value);
  reserve(kLongestNumber);
  if (value != std::floor(value)) return number(value);
  if (std::abs(value) >= kLong) {
    end_ = std::to_chars(end_, limit_, value, std::chars_format::scientific).ptr;
    return;
  }
  integer(value);
  put('.');
}

void TextSink::quoted(std::string_view text) {
  put('"');
  const bool folder = text.ends_with('\\');
  if (folder) text.remove_suffix(1);
  for (std::size_t at = 0;;) {
    const auto quote = text.find('"', at);
    put(text.substr(at, quote - at));
    if (quote == std::string_view::npos) break;
    put("\\\"");
    at = quote + 1;
  }
  put(folder ? std::string_view("/\"") : std::string_view("\""));
}

void TextSink::hex(std::uint8_t byte) {
  constexpr char kDigits[] = "0123456789abcdef";
  reserve(2);
  *end_++ = kDigits[byte >> 4];
  *end_++ = kDigits[byte & 15];
}

}  // namespace oriel::mi
