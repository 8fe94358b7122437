// SPDX-License-Identifier: Apache-2.0
// A scene as JSON and binary arrays, for programs that do not read the scene language.
#pragma once

#include <string>

#include "base/diagnostic.h"

namespace oriel::scene {
class Scene;
}

namespace oriel::app {

class SceneMotion;

/// The two files of a dump.
struct SceneDump {
  std::string json;    ///< elements, placements, shader calls, and where arrays begin
  std::string binary;  ///< little-endian float32 and uint32 arrays
};

/// Dumps what the last render statement shows. The format is described in docs/models.md.
///
/// Model:   objects are tessellated; positions of their vertices are unchanged. Matrices map local
///          to world space for row vectors. Shader calls are written as in the scene, without
///          evaluation.
/// Inputs:  binary_name: name of the file with the arrays, as it will be written. motion: of all
///          frames.
/// Errors:  OR-MD-031 one note for each kind of geometry that is left out.
/// Checked: SceneDumpTest.*
SceneDump dump_scene(const scene::Scene& scene, const std::string& binary_name,
                     const SceneMotion& motion, Diagnostics& diagnostics);

}  // namespace oriel::app
