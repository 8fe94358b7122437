// SPDX-License-Identifier: Apache-2.0
// Parts of pictures that are rendered separately: names and labels of their files.
//
// Conventions
//   The parts of the picture NAME.exr are the files NAME.part-K-of-N, checkpoints without caches of
//   indirect light. Names of labels that begin with "at " say where in the render a file is; all
//   others identify the render and are the same in all its parts.
//   Rounds: with a noise target or distributed samples, the samples of a pixel depend on the whole
//   picture. When all parts have the same number of rounds, `oriel merge` decides on the next one
//   and writes NAME.round, which contains the number of samples that each pixel has to reach.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "checkpoints.h"
#include "render/tiles.h"

namespace oriel::app {

struct RenderArguments;

inline constexpr const char *kPartNote = "at part", *kRoundNote = "at round",
                            *kPartEndNote = "at end of part", *kCommandNote = "at command",
                            *kFolderNote = "at folder";

/// "2/7". Errors:  UsageError.
PicturePart read_part(const std::string& text);
/// "2 of 7".
std::string part_name(const PicturePart& part);
/// The same as of a label; nothing if it is none.
std::optional<PicturePart> part_of_name(const std::string& text);
/// The file of a part: that of the picture with another suffix.
std::string part_path(const std::string& picture, const PicturePart& part);
/// The file of rounds, from the file of a picture or of a part.
std::string round_path(const std::string& picture_or_part);

/// A part of one picture while it is rendered.
///
/// Model:   an existing file of the part continues. Checkpoints are written as in every render.
/// Errors:  UserError if the file of the part or of the round belongs to another render.
/// Checked: Parts.* in tests/faults
class PartRender {
 public:
  /// Inputs:  picture: path of the first picture file.
  PartRender(const RenderArguments& arguments, const CheckpointRequest& request,
             const PicturePart& part, RenderPlace place, const std::string& picture,
             Diagnostics& diagnostics);

  void begin(RenderSession& session);
  /// Whether an earlier run finished the part; there is nothing to render.
  bool was_finished() const { return was_finished_; }
  /// Writes the file after the session ended. Returns false if this fails, which is reported.
  bool end(RenderSession& session, bool finished);
  Checkpoints& file() { return *file_; }
  const std::string& path() const { return path_; }

 private:
  void write_notes(bool finished);
  void read_round(RenderSession& session);

  PicturePart part_;
  RenderPlace place_;
  std::string path_, round_path_;
  CheckpointLabels notes_;
  std::optional<Checkpoints> file_;
  int round_ = 0;
  bool was_finished_ = false;
};

/// Writes the next round of the parts after RenderSession::judge_parts(). `identity`: labels of
/// their render. Errors:  std::runtime_error.
void write_round(const std::string& path, const CheckpointLabels& identity, int round,
                 const std::vector<std::uint32_t>& targets);

/// The number of a label; nothing if it is missing or greater than `most`.
std::optional<int> label_number(const CheckpointLabels& labels, const std::string& name, int most);

}  // namespace oriel::app
