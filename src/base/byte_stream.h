// SPDX-License-Identifier: Apache-2.0
// Values in memory in the form of checkpoints, for messages between processes of one program.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace oriel {

/// Writes as CheckpointWriter does, to a string.
class ByteWriter {
 public:
  static constexpr bool kReads = false;
  template <class T>
  void value(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    put(&value, sizeof value);
  }
  template <class T>
  void array(const std::vector<T>& values) {
    list(values);
  }
  template <class T>
  void list(const std::vector<T>& values) {
    value(std::uint64_t{values.size()});
    put(values.data(), values.size() * sizeof(T));
  }
  std::string take() { return std::move(bytes_); }

 private:
  void put(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

/// Reads what ByteWriter wrote.
/// Errors:  std::runtime_error if the bytes end early or arrays have other sizes.
class ByteReader {
 public:
  static constexpr bool kReads = true;
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void value(T& value) {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    get(&value, sizeof value);
  }
  template <class T>
  void array(std::vector<T>& values) {
    if (count(sizeof(T)) != values.size()) throw std::runtime_error("arrays have other sizes");
    get(values.data(), values.size() * sizeof(T));
  }
  template <class T>
  void list(std::vector<T>& values) {
    values.resize(count(sizeof(T)));
    get(values.data(), values.size() * sizeof(T));
  }

  /// What was not read yet.
  std::string_view rest() const { return bytes_; }

 private:
  std::size_t count(std::size_t element_size) {
    std::uint64_t number = 0;
    value(number);
    if (number > bytes_.size() / element_size) throw std::runtime_error("a message ends early");
    return static_cast<std::size_t>(number);
  }
  void get(void* data, std::size_t size) {
    if (size > bytes_.size()) throw std::runtime_error("a message ends early");
    if (size > 0) std::memcpy(data, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  std::string_view bytes_;
};

}  // namespace oriel
