// SPDX-License-Identifier: Apache-2.0
// Objects and assemblies whose contents stand in files of their own.
#pragma once

#include "mi/parse.h"
#include "mi/reader.h"

namespace oriel::mi {

/// Reads the files that placeholders of the scene name, also those that such files bring, before a
/// picture is made. What they define is added to the scene and noted in Scene::loaded, so that it
/// is not written back; a name that is there already keeps its meaning.
///
/// Model:   an object stands for the object of its name in its file, or the only one there; an
///          assembly for the group of its name, or the last one. Files are found and limited as
///          includes of the file that holds the placeholder are.
/// Errors:  OR-MI-010 to 014 as for includes, OR-MI-026 when the file holds nothing to stand for,
///          OR-MI-023 when names are there already. Each placeholder is tried once.
/// Checked: Placeholder.*
void load_placeholders(Parse& parse);

/// The same for one object or assembly of a scene that was read before, by name, and for the
/// placeholders that its file holds.
void load_placeholder(scene::Scene& scene, const std::string& name, const ReadOptions& options,
                      Diagnostics& diagnostics);

}  // namespace oriel::mi
