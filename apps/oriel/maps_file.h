// SPDX-License-Identifier: Apache-2.0
// Files with what a session computes before its picture, for all parts of the picture.
#pragma once

#include <string>

#include "checkpoints.h"

namespace oriel::app {

struct RenderArguments;

/// The file of a picture in a folder of maps: "frame-0001.maps".
std::string maps_path(const std::string& folder, RenderPlace place);

/// Writes the maps of a session after RenderSession::prepare().
/// Errors:  UserError.
void write_maps(const RenderArguments& arguments, RenderPlace place, RenderSession& session);

/// Reads the maps of a session before it runs.
/// Errors:  UserError if they are missing, damaged or of another render.
/// Checked: Maps.* in tests/faults
void read_maps(const RenderArguments& arguments, RenderPlace place, RenderSession& session);

}  // namespace oriel::app
