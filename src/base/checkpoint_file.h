// SPDX-License-Identifier: Apache-2.0
// Checkpoints: files with the state of a render, written as a whole and checked before use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/checksum.h"
#include "base/durable_file.h"

namespace oriel {

// Conventions
//   Binary, little endian: the 8 bytes "ORIELCHK", version (uint32), a mark of the byte order
//   (uint32, 0x01020304), the sizes of labels and body in bytes (uint64 each), Checksum64 of all
//   other bytes (uint64); labels: for each a name and a text, each with its length (uint32) before
//   it; body: values as in memory, and arrays with their number of elements (uint64) before them.

inline constexpr std::string_view kCheckpointMagic = "ORIELCHK";

/// Texts that identify the render of a checkpoint, by name.
using CheckpointLabels = std::map<std::string, std::string>;

/// Why a checkpoint cannot be used.
struct CheckpointError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Writes a checkpoint, which replaces the file at commit().
///
/// Errors:  std::runtime_error with the reason, without the path, as DurableFile.
/// Checked: CheckpointFile.*
class CheckpointWriter {
 public:
  CheckpointWriter(const std::string& path, const CheckpointLabels& labels);

  static constexpr bool kReads = false;
  template <class T>
  void value(const T& value) {
    static_assert(std::is_arithmetic_v<T>);
    put(&value, sizeof value);
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
    put(values.data(), values.size() * sizeof(T));
  }
  /// Bytes written so far.
  std::uint64_t size() const { return file_.position(); }
  void commit();

 private:
  void put(const void* data, std::size_t size);

  DurableFile file_;
  std::uint64_t labels_size_ = 0;
  Checksum64 sum_;
};

/// Reads a checkpoint.
///
/// Model:   the constructor checks size, version and checksum of the whole file. What is read later
///          is still checked: no array is larger than expected or than the rest of the file.
/// Errors:  CheckpointError with the reason, without the path.
/// Checked: CheckpointFile.*
class CheckpointReader {
 public:
  explicit CheckpointReader(const std::string& path);
  ~CheckpointReader();
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;

  const CheckpointLabels& labels() const { return labels_; }

  static constexpr bool kReads = true;
  template <class T>
  void value(T& value) {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    get(&value, sizeof value);
  }
  /// Fills an array. Another number of elements in the file is an error.
  template <class T>
  void array(std::vector<T>& values) {
    if (count(sizeof(T)) != values.size()) throw CheckpointError("its arrays have other sizes");
    get(values.data(), values.size() * sizeof(T));
  }
  /// Fills and resizes an array.
  template <class T>
  void list(std::vector<T>& values) {
    values.resize(count(sizeof(T)));
    get(values.data(), values.size() * sizeof(T));
  }
  /// Requires that the whole body was read.
  void end() const;

 private:
  std::size_t count(std::size_t element_size);
  void get(void* data, std::size_t size);
  void read(std::uint64_t at, void* data, std::size_t size) const;
  void read_labels(const std::string& bytes);

  int descriptor_ = -1;
  std::uint64_t at_ = 0, size_ = 0;
  CheckpointLabels labels_;
};

}  // namespace oriel
