// SPDX-License-Identifier: Apache-2.0
// The manifest of a folder of shader sources: flags of single sources, helpers, what to skip.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace oriel::app {

/// Name under which a folder's manifest is found.
inline constexpr const char* kManifestName = "oriel-shaders.txt";

/// A text file, one statement a line; words may be quoted, `#` begins a comment.
///
///   flags PATTERN WORD...   words for the compiler of the sources that match; the last ones win
///   skip PATTERN...         sources that are not built
///   include FOLDER...       folders of headers, as -I
///   helper PATH...          sources, folders or archives linked to every library, as --helper
///
/// Paths are relative to the manifest's folder, also those of -I words. A pattern has * and ?; one
/// without a slash matches the file name in any folder, others the path below the manifest.
class ShaderManifest {
 public:
  /// Errors:  UserError with file and line.
  /// Checked: ShaderManifestProgram.* in tests/cli
  explicit ShaderManifest(const std::filesystem::path& file);

  bool skips(const std::filesystem::path& source) const;
  std::vector<std::string> flags_of(const std::filesystem::path& source) const;
  const std::vector<std::string>& include_folders() const { return include_folders_; }
  const std::vector<std::string>& helpers() const { return helpers_; }

 private:
  struct Rule {
    std::string pattern;
    std::vector<std::string> words;
  };
  void read(const std::vector<std::string>& words, const std::string& where);
  bool matches(const std::string& pattern, const std::filesystem::path& source) const;
  std::string placed(const std::string& path) const;

  std::filesystem::path folder_;
  std::vector<Rule> flags_;
  std::vector<std::string> skipped_, include_folders_, helpers_;
};

}  // namespace oriel::app
