// SPDX-License-Identifier: Apache-2.0
// The part files of one render, checked before they are merged.
#pragma once

#include <string>
#include <vector>

#include "parts.h"

namespace oriel::app {

/// A file of PartSet.
struct PartFile {
  std::string path;
  PicturePart part;
  RenderPlace place;
  int round = 0;
  CheckpointLabels labels;
};

/// Part files of one or more pictures of a render.
///
/// Model:   the files are complete if they are intact, were written by this program, belong to one
///          render, and are all finished parts of their pictures in the same round.
/// Checked: Parts.* in tests/faults
class PartSet {
 public:
  explicit PartSet(const std::vector<std::string>& paths);

  /// What prevents merging, one line per file; empty if nothing does.
  const std::vector<std::string>& faults() const { return faults_; }
  /// The words of the command that rendered the parts, and its working folder.
  std::vector<std::string> words() const;
  std::string folder() const;
  /// Frames, in increasing order, separated by commas.
  std::string frames() const;
  /// The parts of a picture, in order.
  std::vector<const PartFile*> parts_of(RenderPlace place) const;

 private:
  void read(const std::string& path);
  void require_one_render();
  void require_all_parts();
  void fault(const std::string& path, const std::string& why);
  std::string note(const char* name) const;

  std::vector<PartFile> files_;
  std::vector<std::string> faults_;
};

}  // namespace oriel::app
