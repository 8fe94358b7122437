// SPDX-License-Identifier: Apache-2.0
#include "merge_picture.h"

#include <fmt/format.h>

#include "checkpoint_labels.h"
#include "command.h"
#include "render_frames.h"

namespace oriel::app {

MergeResult merge_picture(const PartSet& set, RenderPlace place, const RenderArguments& arguments,
                          RenderSession& session) {
  const std::vector<const PartFile*> parts = set.parts_of(place);
  if (parts.empty())
    throw UserError(fmt::format("there is no part of {} of frame {}",
                                place.eye == Eye::Middle ? "the picture" : "one eye", place.frame));
  const CheckpointLabels identity =
      labels_of_picture(arguments.scene.path, option_labels(arguments), session);
  for (const PartFile* file : parts) {
    const auto refuse = [&](const std::string& why) {
      throw UserError(fmt::format("cannot merge '{}': {}", file->path, why));
    };
    try {
      CheckpointReader in(file->path);
      CheckpointLabels labels = in.labels();
      if (labels != file->labels) refuse("the file changes while it is merged");
      erase_notes(labels);
      const std::string difference = label_difference(labels, identity, false);
      if (!difference.empty()) refuse("it belongs to another render: " + difference);
      session.add_part(in, file->part);
    } catch (const CheckpointError& e) {
      refuse(e.what());
    }
  }
  const std::string& first = parts.front()->path;
  try {
    if (session.judge_parts()) return {};
  } catch (const CheckpointError& e) {
    throw UserError(fmt::format("cannot merge '{}' and the other parts: {}", first, e.what()));
  }
  MergeResult result{round_path(first), 0};
  const std::vector<std::uint32_t>& targets = session.next_targets();
  for (const std::uint32_t target : targets) result.samples += target;
  if (!targets.empty()) result.samples /= static_cast<double>(targets.size());
  write_round(result.round, identity, parts.front()->round + 1, targets);
  return result;
}

}  // namespace oriel::app
