// SPDX-License-Identifier: Apache-2.0
// Writes edits back into `.mi` text; the rest of the files stays byte for byte.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "interactive/prepared_scene.h"

namespace oriel::interactive {

/// An edit that cannot be written into the files.
struct SaveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Replaces the values of the edits in the files that define them.
///
/// Model:   the place of each value is known to the reader. The text from there to the end of the
///          value is replaced; a parameter or statement that the text lacks is inserted. Each file
///          is written as a whole.
/// Returns: the names of the changed files, relative to `folder`.
/// Errors:  SaveError: an element whose file is outside of `folder`, is compressed, or has changed
///          since it was read; an edit that has no place in the text. Nothing is written then.
/// Checked: SaveEdits.*
std::vector<std::string> save_into_files(PreparedScene& scene, const std::string& folder);

/// Writes a scene that includes the edited one, changes its elements incrementally and renders.
/// Errors:  SaveError, std::runtime_error if the file cannot be written.
/// Checked: SaveEdits.IncrementalFile*
void save_incremental(PreparedScene& scene, const std::string& path);

}  // namespace oriel::interactive
