// SPDX-License-Identifier: Apache-2.0
// The pixels of a picture from those of its parts.
#pragma once

#include "part_set.h"

namespace oriel::app {

struct MergeResult {
  std::string round;   ///< file with the next round of the parts; empty if the picture is complete
  double samples = 0;  ///< mean of a pixel after that round
};

/// Fills a session of the whole picture with the parts. If a noise target needs further samples,
/// the next round is written beside the parts.
/// Errors:  UserError that names the part that does not fit the render or cannot be read.
/// Checked: Parts.* in tests/faults
MergeResult merge_picture(const PartSet& parts, RenderPlace place, const RenderArguments& arguments,
                          RenderSession& session);

}  // namespace oriel::app
