// SPDX-License-Identifier: Apache-2.0
// Values in memory in the form of checkpoints, for messages between processes of one program.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "base/value_stream.h"

namespace oriel {

/// Writes to a string.
class ByteWriter : public ValueWriter<ByteWriter> {
 public:
  /// Makes room for further bytes.
  void reserve(std::size_t size) { bytes_.reserve(bytes_.size() + size); }
  std::string take() { return std::move(bytes_); }

 private:
  friend ValueWriter<ByteWriter>;
  void put(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

/// Reads what ByteWriter wrote.
/// Errors:  std::runtime_error if the bytes end early or arrays have other sizes.
class ByteReader : public ValueReader<ByteReader> {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  /// What was not read yet.
  std::string_view rest() const { return bytes_; }

 private:
  friend ValueReader<ByteReader>;
  using Error = std::runtime_error;
  std::size_t left() const { return bytes_.size(); }
  void get(void* data, std::size_t size) {
    if (size > 0) std::memcpy(data, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  std::string_view bytes_;
};

}  // namespace oriel
