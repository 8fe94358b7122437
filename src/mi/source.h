// SPDX-License-Identifier: Apache-2.0
// One scene file in memory, with line and column lookup.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "mi/gzip.h"

namespace oriel::mi {

/// The text of one file, followed by zero bytes, so that scans need no end test. The file is read
/// into memory instead of mapped, because truncation of a mapped file by an exporter would crash
/// the reader.
class Source {
 public:
  /// Reads a file, optionally gzip-compressed. Returns null and a reason if the file is unreadable
  /// or its text exceeds the limits. `path` is its name in messages.
  static std::unique_ptr<Source> load(OpenFile& file, const std::string& path,
                                      const TextLimits& limits, SourceFault& fault);
  static std::unique_ptr<Source> from_text(std::string_view text, std::string path);
  // Both decode UTF-16 with a byte order mark and drop trailing zero bytes.

  const char* begin() const { return text_.get(); }
  const char* end() const { return text_.get() + size_; }
  std::size_t size() const { return size_; }
  /// The line end character: '\r' in files of classic Mac OS, otherwise '
  /// '.
  char newline() const { return newline_; }
  const std::string& path() const { return path_; }

  /// Line and column of a character, counted from 1. Counts from the position of the previous call,
  /// so calls in reading order are fast.
  SourceLocation locate(const char* at);
  /// Whether `at` has only blanks before it on its line.
  bool starts_line(const char* at) const;
  /// Releases the memory of the lines before `at` if there is enough of it. The released text reads
  /// as zero bytes. Line numbers stay correct.
  void forget_before(const char* at);

  std::uint32_t file = 0;  ///< index in Diagnostics

 private:
  Source(std::size_t size, std::string path);
  void examine();
  std::unique_ptr<char[]> text_;
  std::size_t size_ = 0;
  char newline_ = '\n';
  std::string path_;
  std::size_t forgotten_ = 0;  ///< bytes released
  const char* last_ = nullptr;
  const char* line_start_ = nullptr;
  std::uint32_t line_ = 1;
};

}  // namespace oriel::mi
