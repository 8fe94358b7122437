// SPDX-License-Identifier: Apache-2.0
// Names for what a scene contains, which the page compares.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace oriel::studio {

/// Names the content of a scene: its files and the edits of them.
///
/// Model:   the same name after edits were written into the files, and after that was taken back.
///          Names of different processes differ.
/// Checked: SceneContent.* in tests/studio
class SceneContent {
 public:
  SceneContent();

  /// The name for these edits of the present files.
  std::string name(const std::vector<std::string>& edits) const;
  /// Call after the edits were written into the files. `inverse`: the edits that take that back;
  /// may be empty.
  void save(const std::vector<std::string>& edits, const std::vector<std::string>& inverse);
  /// Call after the files may have changed otherwise.
  void forget();

 private:
  std::string files_;  ///< name of the present files
  std::map<std::vector<std::string>, std::string> known_;
};

}  // namespace oriel::studio
