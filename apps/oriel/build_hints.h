// SPDX-License-Identifier: Apache-2.0
// What helps against the errors that compilers report for old shader sources.
#pragma once

#include <string>
#include <vector>

namespace oriel::app {

/// Hints for messages of GCC or Clang in English, each naming the option that helps; no hint twice.
class BuildHints {
 public:
  /// `folders`: where headers that a source misses are looked for.
  explicit BuildHints(std::vector<std::string> folders) : folders_(std::move(folders)) {}

  /// Reads the messages of one run of a compiler or linker.
  void read(const std::string& messages);

  const std::vector<std::string>& all() const { return hints_; }

 private:
  void read_line(const std::string& line);
  void missing_header(const std::string& name);
  void unknown_name(const std::string& name);
  void add(std::string hint);

  std::vector<std::string> folders_, hints_;
  bool failed_ = false;  ///< the messages that are read have an error
};

/// Text without the sequences that colour it on a terminal.
std::string without_colours(const std::string& text);

}  // namespace oriel::app
