// SPDX-License-Identifier: Apache-2.0
// What a model file says and nobody can have meant.
#pragma once

#include <string>

#include "base/diagnostic.h"

struct aiScene;

namespace oriel::models {

/// Takes polygons without area out of the meshes; corners that do not exist are left to others.
/// Errors:  OR-MD-009 one note of how many.
/// Checked: ModelMend.PolygonsWithoutAreaGoInOneNote
void drop_polygons_without_area(aiScene& model, Diagnostics& diagnostics);

/// Materials that are entirely transparent become opaque. Old exporters of 3ds Max write that of
/// each material, `<transparency> 0` with a white `<transparent>`, having the scale the other way
/// round; what was never to be seen would not have been modelled.
/// Errors:  OR-MD-010 one note with their names.
/// Checked: ModelMend.ColladaThatIsNotThereAtAllIsOpaque
void show_invisible_materials(aiScene& model, Diagnostics& diagnostics);

/// Spots of formats that write the whole angle of a cone get the half of it, as glTF has it and as
/// scenes are built from.
///
/// Model:   FBX: both angles. Collada: `falloff_angle`, outside of which there is no light; assimp
///          gives it as the inner angle, with an outer one of its own.
/// Inputs:  suffix: of the file, in lower case; nothing is done for others.
/// Source:  FbxLight::InnerAngle, OuterAngle; Collada 1.4.1, <spot>; what Blender writes for both.
/// Checked: ModelFbx.SpotsAreWrittenWithTheirWholeAngle, ModelMend.ColladaSpots*
void halve_cones(aiScene& model, const std::string& suffix);

/// Cameras that see less than a degree and a half across: some exporters to Collada wrote radians,
/// and lenses of that length (1.4 m on full frame) are for the moon.
/// Errors:  OR-MD-014 one note with their names.
/// Checked: ModelMend.CamerasInRadiansAreToldOf
void widen_narrow_cameras(aiScene& model, Diagnostics& diagnostics);

}  // namespace oriel::models
