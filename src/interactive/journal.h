// SPDX-License-Identifier: Apache-2.0
// Unsaved edits in a file, which survive the end of the process.
#pragma once

#include <string>
#include <vector>

namespace oriel::interactive {

/// The file of the edits of one scene: one edit per line, replaced as a whole at each change, so
/// that it is complete whenever the process ends; a failure of power may lose the last changes.
/// Checked: SaveEdits.JournalsReturnWhatWasWritten
class EditJournal {
 public:
  explicit EditJournal(std::string path) : path_(std::move(path)) {}

  /// The edits of the file; none if there is no file.
  std::vector<std::string> read() const;
  /// Removes the file if there are no edits. A failure is ignored: the session continues.
  void write(const std::vector<std::string>& edits) const;

 private:
  std::string path_;
};

/// The journal of a scene in the user's state folder ($XDG_STATE_HOME or ~/.local/state,
/// oriel/studio); empty if there is none.
std::string journal_path(const std::string& scene);

}  // namespace oriel::interactive
