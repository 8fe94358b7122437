// SPDX-License-Identifier: Apache-2.0
// Diagnostics for users: severity, stable code, location with its includes, hint.
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// Location in a file. `file` is an index into Diagnostics::files; line and column count from 1, 0
/// means unknown. All locations compare equal, so that scenes are compared by content.
struct SourceLocation {
  std::uint32_t file = 0;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  friend bool operator==(const SourceLocation&, const SourceLocation&) { return true; }
};

enum class Severity : std::uint8_t { Note, Warning, Error };

struct Diagnostic {
  Severity severity = Severity::Note;
  std::string code;  ///< stable, such as "OR-MI-012"
  SourceLocation where;
  std::string message;  ///< one sentence without a full stop
  std::string hint;     ///< how to fix the problem; may be empty
};

/// Collects diagnostics; thread-safe.
class Diagnostics {
 public:
  Diagnostics();

  /// Registers a file (index 0 is "no file") and where it was included from.
  std::uint32_t add_file(std::string path, SourceLocation included_from = {});
  const std::string& file(std::uint32_t index) const { return files_[index].path; }

  void report(Severity severity, std::string_view code, SourceLocation where, std::string message,
              std::string hint = {});
  void note(std::string_view code, SourceLocation w, std::string m, std::string hint = {}) {
    report(Severity::Note, code, w, std::move(m), std::move(hint));
  }
  void warning(std::string_view code, SourceLocation w, std::string m, std::string hint = {}) {
    report(Severity::Warning, code, w, std::move(m), std::move(hint));
  }
  void error(std::string_view code, SourceLocation w, std::string m, std::string hint = {}) {
    report(Severity::Error, code, w, std::move(m), std::move(hint));
  }

  const std::vector<Diagnostic>& all() const { return all_; }
  /// Removes all diagnostics after the first `count`, of work that is repeated.
  void forget_after(std::size_t count);
  std::size_t count(Severity severity) const;
  bool has(std::string_view code) const;

  /// "file:line:column: warning: message [code]", preceded by a line per include and followed by
  /// the hint.
  std::string format(const Diagnostic& diagnostic) const;

  /// Maximum number of stored messages per code; further ones are only counted, since an invalid
  /// file may cause millions.
  static constexpr std::size_t kMaxPerCode = 50;

 private:
  struct File {
    std::string path;
    SourceLocation included_from;
  };
  std::mutex mutex_;
  std::vector<File> files_;
  std::vector<Diagnostic> all_;
};

/// The candidate with the smallest edit distance to `name`, where a swap of neighbours counts one;
/// empty if all are too different (more than a third of the length) to be typing errors.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

/// The name in the folder of a missing file that is nearest to its name; empty as above.
std::string nearest_file(const std::string& missing);

/// The hint "did you mean "NAME"?" with the nearest candidate; empty as above.
std::string did_you_mean(std::string_view name, std::span<const std::string> candidates);

}  // namespace oriel
