// SPDX-License-Identifier: Apache-2.0
// Values and arrays in the form of checkpoints: what writers and readers of bytes have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace oriel {

// Conventions
//   Values as in memory, and arrays with their number of elements (uint64) before them.

/// Functions of a writer that has put(data, size).
template <class Writer>
class ValueWriter {
 public:
  static constexpr bool kReads = false;
  template <class T>
  void value(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    writer().put(&value, sizeof value);
  }
  /// An array whose size the reader knows.
  template <class T>
  void array(const std::vector<T>& values) {
    list(values);
  }
  /// An array of any size.
  template <class T>
  void list(const std::vector<T>& values) {
    value(std::uint64_t{values.size()});
    writer().put(values.data(), values.size() * sizeof(T));
  }

 private:
  Writer& writer() { return static_cast<Writer&>(*this); }
};

/// Functions of a reader that has get(data, size), the bytes left(), and a type Error.
template <class Reader>
class ValueReader {
 public:
  static constexpr bool kReads = true;
  template <class T>
  void value(T& value) {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    get(&value, sizeof value);
  }
  /// Fills an array. Another number of elements is an error.
  template <class T>
  void array(std::vector<T>& values) {
    if (count(sizeof(T)) != values.size())
      throw typename Reader::Error("its arrays have other sizes");
    get(values.data(), values.size() * sizeof(T));
  }
  /// Fills and resizes an array.
  template <class T>
  void list(std::vector<T>& values) {
    values.resize(count(sizeof(T)));
    get(values.data(), values.size() * sizeof(T));
  }

 private:
  Reader& reader() { return static_cast<Reader&>(*this); }
  void get(void* data, std::size_t size) {
    require(size <= reader().left());
    reader().get(data, size);
  }
  /// The number of elements of an array, which the rest of the bytes has.
  std::size_t count(std::size_t element_size) {
    std::uint64_t number = 0;
    value(number);
    require(number <= reader().left() / element_size);
    return static_cast<std::size_t>(number);
  }
  static void require(bool is_complete) {
    if (!is_complete) throw typename Reader::Error("it is damaged: its arrays end early");
  }
};

}  // namespace oriel
