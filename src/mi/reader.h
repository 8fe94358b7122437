// SPDX-License-Identifier: Apache-2.0
// Reads mental ray scene files (.mi).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "scene/scene.h"

namespace oriel::mi {

struct ReadLimits {
  int include_depth = 64;
  int nesting = 256;  ///< of parameter values, braces and brackets
};

/// An include, or the file of a placeholder, that was found.
struct IncludedFile {
  std::string name;  ///< as written
  std::string path;
  SourceLocation where;  ///< of the directive; of a placeholder's file: line 1 of the file with it
};

struct ReadOptions {
  std::vector<std::string> include_paths;
  /// Stems of the shader packages that the host provides ("base", "architectural"). An include of
  /// stem + ".mi" is satisfied without a file and recorded in Scene::packages.
  std::vector<std::string> packages;
  /// Returns true for shader types that the host provides without a declaration in the file.
  std::function<bool(std::string_view)> knows_shader;
  std::map<std::string, std::string, std::less<>> variables;  ///< defined for $ifdef
  /// The host compiles C code in the scene; suppresses the warning that such code is not run.
  bool trusts_code = false;
  /// Optional observer of the files that are read.
  std::function<void(const IncludedFile&)> on_include;
  ReadLimits limits;
  /// Policy for files that the scene names. The reader permits the folder of the scene and the
  /// include paths.
  FileAccess files;
  SceneBudgets budgets;
};

class ReaderState;

/// Reads a scene file frame by frame.
///
/// Errors become diagnostics (codes.h) and reading continues: a syntax error affects one element, a
/// missing include only its contents. The reader never runs code in a file. The scene gets the
/// policy for files and the budgets (Scene::files, Scene::budgets).
class Reader {
 public:
  /// Copies `options`. `diagnostics` must outlive the reader.
  Reader(const std::string& path, ReadOptions options, Diagnostics& diagnostics);
  /// Reads text in memory. `name` is its path in diagnostics and for relative includes.
  static Reader from_text(std::string_view text, ReadOptions options, Diagnostics& diagnostics,
                          std::string name = "scene.mi");
  ~Reader();
  Reader(Reader&&) noexcept;

  /// Reads up to and including the next `render` statement into `scene`. Appends the statement to
  /// Scene::renders and reports all undefined names. Returns false if the file ends without another
  /// `render`. Requires the same scene in every call.
  bool next_frame(scene::Scene& scene);

  /// Whether the file ends after the last frame that was read.
  bool at_end();
  bool opened() const;  ///< false after a read error, which was reported

 private:
  explicit Reader(std::unique_ptr<ReaderState> state);
  std::unique_ptr<ReaderState> state_;
};

/// Reads all frames into one scene.
scene::Scene read_all(Reader& reader);
/// Reads a whole file.
scene::Scene read_scene(const std::string& path, ReadOptions options, Diagnostics& diagnostics);
scene::Scene read_text(std::string_view text, ReadOptions options, Diagnostics& diagnostics,
                       std::string name = "scene.mi");

}  // namespace oriel::mi
