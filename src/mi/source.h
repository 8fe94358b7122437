// SPDX-License-Identifier: Apache-2.0
// One file of a scene in memory, and where in it a character stands.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/diagnostic.h"

namespace oriel::mi {

/// The text of one file. Followed by zero bytes, so that scans need no end test. Read into memory
/// rather than mapped: an exporter that truncates the file meanwhile must not kill the reader.
class Source {
 public:
  /// Reads a file, compressed by gzip or not. Returns null and a reason when it cannot be read or
  /// its text is larger than `max_size`.
  static std::unique_ptr<Source> load(const std::string& path, std::uint64_t max_size,
                                      std::string& reason);
  static std::unique_ptr<Source> from_text(std::string_view text, std::string path);
  // Both decode UTF-16 with a byte order mark and drop zero bytes at the end of the text.

  const char* begin() const { return text_.get(); }
  const char* end() const { return text_.get() + size_; }
  std::size_t size() const { return size_; }
  /// The character that ends lines: '\r' in files of old Macintoshes, else '\n' (after '\r' or
  /// not).
  char newline() const { return newline_; }
  const std::string& path() const { return path_; }

  /// Line and column of a character, counted from 1. Cheap when asked in reading order: it counts
  /// from the place asked for last.
  SourceLocation locate(const char* at);
  /// True when only blanks stand before `at` on its line.
  bool starts_line(const char* at) const;
  /// Gives memory of the lines before `at` back to the system, where there is enough of it; they
  /// read as zero bytes from then on. Lines go on being counted.
  void forget_before(const char* at);

  std::uint32_t file = 0;  ///< index in Diagnostics

 private:
  Source(std::size_t size, std::string path);
  void examine();
  std::unique_ptr<char[]> text_;
  std::size_t size_ = 0;
  char newline_ = '\n';
  std::string path_;
  std::size_t forgotten_ = 0;  ///< bytes given back
  const char* last_ = nullptr;
  const char* line_start_ = nullptr;
  std::uint32_t line_ = 1;
};

}  // namespace oriel::mi
