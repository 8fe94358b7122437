// SPDX-License-Identifier: Apache-2.0
// Files that are replaced as a whole: complete and on the disk, or unchanged.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace oriel {

/// A new file that replaces the target when it is complete.
///
/// Model:   the data goes to a temporary file with a random name in the folder of the target.
///          commit() flushes it to the disk, renames it to the target and flushes the folder.
///          Without commit() the temporary file is removed and the target is unchanged. A target
///          that is a symbolic link, folder, pipe or device is refused.
/// Errors:  std::runtime_error with the reason, without the path. After an error each later call
///          fails with the same reason, so that callers may ignore errors until commit().
/// Checked: DurableFile.* in durable_file_test.cpp, tests/faults
class DurableFile {
 public:
  /// Permissions are restricted by the umask of the process.
  explicit DurableFile(const std::string& target, mode_t permissions = 0666);
  ~DurableFile();
  DurableFile(const DurableFile&) = delete;
  DurableFile& operator=(const DurableFile&) = delete;

  void write(const void* data, std::size_t size);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Position of the next write, in bytes from the start.
  std::uint64_t position() const { return position_ + buffer_.size(); }
  void seek(std::uint64_t position);
  /// Throws the first error again.
  void check() const;
  void commit();

 private:
  void flush();
  [[noreturn]] void fail(int error);

  std::string target_, temporary_;
  std::string failure_;  ///< reason of the first error
  std::string buffer_;
  std::uint64_t position_ = 0;  ///< of the start of the buffer
  int descriptor_ = -1;
};

/// Why a file of this name may neither be created nor replaced: the path is a symbolic link, a
/// folder, a pipe or a device. Empty if it may, also if the file does not exist.
std::string target_fault(const std::string& path);

/// Replaces the file by this content. Errors as DurableFile, with the path.
void write_durably(const std::string& path, std::string_view content, mode_t permissions = 0666);

/// Why a file of Oriel's own format, which begins with `magic`, may not be written to `path`:
/// another file is there, or the name begins with a dot. Empty if it may. `kind` names the format.
std::string own_file_fault(const std::string& path, std::string_view magic, std::string_view kind);

/// Up to `count` first bytes of a regular file, without following a link; empty if there is none.
std::string first_bytes(const std::string& path, std::size_t count);

}  // namespace oriel
