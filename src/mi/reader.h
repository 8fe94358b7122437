// SPDX-License-Identifier: Apache-2.0
// Reads mental ray scene files (.mi) into a scene.
#pragma once

#include <cstdint>
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
  int includes = 100'000;  ///< in all: files that include each other twice grow exponentially
  int nesting = 256;       ///< of parameter values, groups in braces and brackets
  std::uint64_t file_size = std::uint64_t{16} << 30;  ///< bytes of one file
};

struct ReadOptions {
  std::vector<std::string> include_paths;
  /// Stems of the shader packages the host supplies itself ("base", "architectural"): an include
  /// whose file name is stem + ".mi" is satisfied without a file and noted in Scene::packages.
  std::vector<std::string> packages;
  /// Whether the host knows a shader type that the file does not declare.
  std::function<bool(std::string_view)> knows_shader;
  std::map<std::string, std::string, std::less<>> variables;  ///< for $ifdef
  /// The host compiles C sources in the scene: it is not said that they are never run.
  bool trusts_code = false;
  ReadLimits limits;
};

class ReaderState;

/// Reads a scene file frame by frame.
///
/// Whatever is wrong becomes a diagnostic (codes.h) and reading goes on: a syntax error costs the
/// element it is in, a missing include its contents. Nothing in a file is ever run. Included files
/// must lie below the scene's folder or an include path.
class Reader {
 public:
  /// `options` are copied, `diagnostics` must outlive the reader.
  Reader(const std::string& path, ReadOptions options, Diagnostics& diagnostics);
  /// Text in memory; `name` stands for its path in messages and for relative includes.
  static Reader from_text(std::string_view text, ReadOptions options, Diagnostics& diagnostics,
                          std::string name = "scene.mi");
  ~Reader();
  Reader(Reader&&) noexcept;

  /// Reads until and including the next `render` statement, applying everything to `scene`; the
  /// statement is appended to Scene::renders and every name that nothing defines is reported.
  /// Returns false when the file ends without another `render`. Pass the same scene every time.
  bool next_frame(scene::Scene& scene);

  /// Whether nothing follows the frame just read.
  bool at_end();
  bool opened() const;  ///< false: the file could not be read, and a diagnostic says why

 private:
  explicit Reader(std::unique_ptr<ReaderState> state);
  std::unique_ptr<ReaderState> state_;
};

/// Reads on to the end, all frames applied one after the other.
scene::Scene read_all(Reader& reader);
/// The same of a whole file.
scene::Scene read_scene(const std::string& path, ReadOptions options, Diagnostics& diagnostics);
scene::Scene read_text(std::string_view text, ReadOptions options, Diagnostics& diagnostics,
                       std::string name = "scene.mi");

}  // namespace oriel::mi
