// SPDX-License-Identifier: Apache-2.0
// Writes a scene as .mi text.
#pragma once

#include <iosfwd>
#include <string>

#include "base/diagnostic.h"
#include "scene/scene.h"

namespace oriel::mi {

/// Writes the scene as text that reads back as an equal scene.
///
/// Model:   the order is commands, packages (as $include lines), declarations, phenomena, elements
///          in their order, and render commands. Names are always quoted. Numbers are the shortest
///          ones that read back as the same number. Uninterpreted text is unchanged. Polygons are
///          written in the general form `p`, trilists as groups.
/// Checked: writer_test.cpp, round_trip_test.cpp
void write_scene(const scene::Scene& scene, std::ostream& stream);

/// Replaces the file as a whole (DurableFile). The last line is a comment with a checksum. On
/// failure returns false, reports OR-MI-050 with the reason, and leaves an existing file unchanged.
bool write_scene(const scene::Scene& scene, const std::string& path, Diagnostics& diagnostics);

/// Whether the file was written by write_scene() and has not been edited since, by its checksum.
/// Checked: SceneFile.* in writer_test.cpp
bool is_unedited_scene(const std::string& path);

}  // namespace oriel::mi
