// SPDX-License-Identifier: Apache-2.0
// The picture files of a frame: tested before the render, written during and after it.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "output/output.h"
#include "output/output_place.h"

namespace oriel::app {

/// How much of the picture exists when the render ends.
enum class PictureState { Empty, FirstPass, Complete };

/// Writes the files of one frame after another.
///
/// Model:   while rendering, the picture NAME.exr is written to NAME.part.exr, or with `live` to
///          NAME.exr itself. At the end it replaces NAME.exr, and NAME.part.exr is removed. A
///          picture whose first pass is incomplete replaces no existing file and stays in
///          NAME.part.exr. A file that cannot be written is tried again after later passes and at
///          the end; then the picture is written to NAME.part.exr or to a new folder in the
///          temporary folder.
/// Errors:  OR-RN-065: a warning during the render, an error at the end.
/// Checked: tests/faults
class FramePictures {
 public:
  /// Writes one file; throws if this fails.
  using Writer = std::function<void(const PictureFile&)>;

  FramePictures(OutputRoots roots, bool live, Diagnostics& diagnostics)
      : roots_(std::move(roots)), live_(live), diagnostics_(diagnostics) {}

  /// Tests all paths of the next frame. Returns false if none of them can be written.
  bool test(const std::vector<std::string>& paths, SourceLocation where);
  void write_pass(const std::vector<PictureFile>& files, const Writer& write);
  void write_final(const std::vector<PictureFile>& files, PictureState state, const Writer& write);
  /// Files of the last write_final().
  const std::vector<std::string>& written() const { return written_; }

 private:
  std::string part_path(const PictureFile& file) const;
  void warn(const std::string& path, const std::string& why);
  void write_elsewhere(const PictureFile& file, const std::string& why, const Writer& write);

  OutputRoots roots_;
  bool live_;
  Diagnostics& diagnostics_;
  SourceLocation where_;
  std::set<std::string> targets_;   ///< of this frame
  std::set<std::string> reported_;  ///< targets with a warning
  std::set<std::string> parts_;     ///< NAME.part.exr files of this process
  std::vector<std::string> written_;
};

}  // namespace oriel::app
