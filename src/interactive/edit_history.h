// SPDX-License-Identifier: Apache-2.0
// Undo and redo of lists of edits.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace oriel::interactive {

/// The lists of edits of a session, oldest first.
///
/// Checked: EditHistory.*
class EditHistory {
 public:
  using Edits = std::vector<std::string>;

  const Edits& now() const { return steps_[at_]; }
  /// A new step, which removes undone ones. Steps with the same text for `gesture`, not empty, are
  /// one step: those of one drag.
  void push(Edits edits, const std::string& gesture = {});
  /// Replaces the present step, for lists that were read from a file.
  void replace(Edits edits) { steps_[at_] = std::move(edits); }
  bool undo();  ///< false: there is no earlier step
  bool redo();
  std::size_t undo_count() const { return at_; }
  std::size_t redo_count() const { return steps_.size() - 1 - at_; }

 private:
  static constexpr std::size_t kMaxSteps = 1000;
  std::vector<Edits> steps_ = {{}};
  std::size_t at_ = 0;
  std::string gesture_;
};

}  // namespace oriel::interactive
