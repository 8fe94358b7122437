// SPDX-License-Identifier: Apache-2.0
// What material files of OBJ say that assimp does not pass on.
#pragma once

#include <string>

#include "base/diagnostic.h"
#include "models/text_files.h"

struct aiScene;

namespace oriel::models {

/// Property of an OBJ material: the colour that it transmits (`Tf`); present only if it transmits.
#define ORIEL_MATKEY_FILTER "$oriel.filter", 0, 0

/// Corrects the materials of an OBJ file by its material files. The file's first comment becomes
/// the model's generator.
///
/// Model:   `d` decides over `Tr`, in either order. `Tf` counts only with the illumination models
///          for glass (`illum` 4, 6, 7, 9) or beside roughness and metalness (Pr, Pm) as Blender
///          writes it: other writers put `Tf 1 1 1` on opaque materials.
/// Inputs:  path: of the OBJ file, which its material files are relative to.
/// Errors:  OR-MD-015 material files that do not exist. Files that may not be read are added to
///          `files`.
/// Source:  Wavefront, "Advanced Visualizer Manual", appendix B1; what Blender 3.4 writes.
/// Checked: ImportedPanes.ObjDissolveAndFilterPassTheSun
void mend_obj_materials(aiScene& model, const std::string& path, ModelFiles& files,
                        Diagnostics& diagnostics);

}  // namespace oriel::models
