// SPDX-License-Identifier: Apache-2.0
// Writes a scene as .mi text.
#pragma once

#include <iosfwd>
#include <string>

#include "base/diagnostic.h"
#include "scene/scene.h"

namespace oriel::mi {

/// Writes the scene so that reading the text gives an equal one.
///
/// Model:   commands, packages (as $include lines), declarations and phenomena first, then the
///          elements in their order, then what to render. Names always stand in quotes; numbers in
///          the shortest form that reads back as the same number; kept text as it was.
///          Polygons are written in the general form `p`, tri-lists as groups.
/// Checked: writer_test.cpp, round_trip_test.cpp
void write_scene(const scene::Scene& scene, std::ostream& stream);

/// The same into a file. Returns false, after OR-MI-050 with the reason, where that fails; then
/// a file that stood there before is untouched.
bool write_scene(const scene::Scene& scene, const std::string& path, Diagnostics& diagnostics);

}  // namespace oriel::mi
