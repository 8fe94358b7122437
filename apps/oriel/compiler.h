// SPDX-License-Identifier: Apache-2.0
// Runs a compiler: without a shell, its messages where the user sees them.
#pragma once

#include <mutex>
#include <string>
#include <vector>

namespace oriel::app {

/// The words of a text between blanks.
std::vector<std::string> words_of(const std::string& text);

/// What compiles: a program and the words that stand before its own arguments ("ccache", "gcc").
using CompilerCommand = std::vector<std::string>;

/// The compiler of a language, and how it came to be chosen. Threads may run it at the same time.
class Compiler {
 public:
  /// `asked`: what the user wrote, or empty; `variable`: of the environment, asked next; then the
  /// names in `usual`, as far as they are installed.
  Compiler(std::string language, std::string option, const std::string& asked, const char* variable,
           const std::vector<std::string>& usual);

  /// Runs it; false: it ended with an error and printed it. Messages are in English and are
  /// written to the file `log`.
  ///
  /// Errors: UserError when no such program is installed.
  bool run(const std::vector<std::string>& arguments, const std::string& log);

 private:
  std::string language_, option_;
  std::mutex mutex_;
  std::vector<CompilerCommand> candidates_;
};

}  // namespace oriel::app
