// SPDX-License-Identifier: Apache-2.0
// Corrects common exporter errors in model files.
#pragma once

#include <string>

#include "base/diagnostic.h"

struct aiScene;

namespace oriel::models {

/// Drops polygons without area; polygons with invalid vertex indices are handled elsewhere.
/// Errors:  OR-MD-009 one note with their number.
/// Checked: ModelMend.ZeroAreaPolygonsAreDroppedWithOneNote
void drop_polygons_without_area(aiScene& model, Diagnostics& diagnostics);

/// Makes entirely transparent materials opaque. Old exporters of 3ds Max invert the scale: they
/// write `<transparency> 0` with a white `<transparent>` for every opaque material. Models rarely
/// contain materials that are meant to be invisible.
/// Errors:  OR-MD-010 one note with their names.
/// Checked: ModelMend.FullyTransparentColladaIsOpaque
void show_invisible_materials(aiScene& model, Diagnostics& diagnostics);

/// Halves the cone angles of spot lights in formats that store the full angle; scenes and glTF use
/// the half angle.
///
/// Model:   FBX: both angles. Collada: `falloff_angle`, the outer angle; assimp stores it as the
///          inner angle and invents an outer one.
/// Inputs:  suffix: of the file, in lower case; other formats are unchanged.
/// Source:  FbxLight::InnerAngle, OuterAngle; Collada 1.4.1, <spot>; files exported by Blender.
/// Checked: ModelFbx.SpotAnglesAreFullAngles, ModelMend.ColladaSpotAngles*
void halve_cones(aiScene& model, const std::string& suffix);

/// Corrects cameras with a horizontal field of view below 1.5 degrees: some Collada exporters wrote
/// radians. Such a narrow view (1.4 m focal length on full frame) is rarely intended.
/// Errors:  OR-MD-014 one note with their names.
/// Checked: ModelMend.CamerasInRadiansAreReported
void widen_narrow_cameras(aiScene& model, Diagnostics& diagnostics);

}  // namespace oriel::models
