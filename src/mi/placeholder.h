// SPDX-License-Identifier: Apache-2.0
// Placeholders: objects and assemblies with their contents in separate files.
#pragma once

#include "mi/parse.h"
#include "mi/reader.h"

namespace oriel::mi {

/// Reads the files of all placeholders in the scene, including placeholders in these files, before
/// rendering. The new elements are added to the scene and to Scene::loaded, so that the writer
/// skips them. Elements of the scene are not replaced.
///
/// Model:   an object gets the object of the same name in its file, or the last one; an assembly
///          gets the group of the same name, or the last one. Files are searched and limited like
///          includes of the file with the placeholder.
/// Errors:  OR-MI-010 to 014 as for includes, OR-MI-026 if the file lacks a matching element,
///          OR-MI-023 for names that the scene already defines. Each placeholder is tried once.
/// Checked: Placeholder.*
void load_placeholders(Parse& parse);

/// Loads one placeholder of a complete scene, by name, and the placeholders in its file.
void load_placeholder(scene::Scene& scene, const std::string& name, const ReadOptions& options,
                      Diagnostics& diagnostics);

}  // namespace oriel::mi
