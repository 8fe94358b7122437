// SPDX-License-Identifier: Apache-2.0
// Checkpoints: files with the state of a render, written as a whole and checked before use.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/checksum.h"
#include "base/durable_file.h"
#include "base/value_stream.h"

namespace oriel {

// Conventions
//   Binary, little endian: the 8 bytes "ORIELCHK", version (uint32), a mark of the byte order
//   (uint32, 0x01020304), the sizes of labels and body in bytes (uint64 each), Checksum64 of all
//   other bytes (uint64); labels: for each a name and a text, each with its length (uint32) before
//   it; body: the form of ValueWriter.

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
class CheckpointWriter : public ValueWriter<CheckpointWriter> {
 public:
  CheckpointWriter(const std::string& path, const CheckpointLabels& labels);

  /// Bytes written so far.
  std::uint64_t size() const { return file_.position(); }
  void commit();

 private:
  friend ValueWriter<CheckpointWriter>;
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
class CheckpointReader : public ValueReader<CheckpointReader> {
 public:
  explicit CheckpointReader(const std::string& path);
  ~CheckpointReader();
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;

  const CheckpointLabels& labels() const { return labels_; }

  /// Requires that the whole body was read.
  void end() const;

 private:
  friend ValueReader<CheckpointReader>;
  using Error = CheckpointError;
  std::uint64_t left() const { return size_ - at_; }
  void get(void* data, std::size_t size);
  void read(std::uint64_t at, void* data, std::size_t size) const;
  void read_labels(const std::string& bytes);

  int descriptor_ = -1;
  std::uint64_t at_ = 0, size_ = 0;
  CheckpointLabels labels_;
};

}  // namespace oriel
