// SPDX-License-Identifier: Apache-2.0
// Units of lights and emission in files of programs that write watts.
#pragma once

#include <optional>
#include <string>

#include "base/diagnostic.h"

struct aiScene;

namespace oriel::models {

/// Lumens of a watt in programs that convert between both (glTF issue 2214): 555 nm.
inline constexpr float kLumensOfWatt = 683;

/// Factors from the numbers of a file to candela, lux and cd/m2.
struct LightUnits {
  float point = 1, directional = 1, emission = 1;
  bool operator==(const LightUnits&) const = default;
};

/// Inputs:  generator: as the file names the program that wrote it; suffix: of the file.
/// Model:   Blender: a point light of P watts has P / (4 pi) W/sr, also as a spot; suns are in
///          W/m2, emission in W/(m2 sr). glTF: from version 3.4 of the exporter lights are
///          converted to candela and lux, emission is not; before, watts are written as candela.
///          FBX, Collada: watts.
/// Source:  Blender 3.4: io_scene_gltf2 (convert_lighting_mode), io_scene_fbx.
/// Checked: LightUnits.*
LightUnits light_units(const std::string& generator, const std::string& suffix);

/// Property of a material: factor of its emission.
#define ORIEL_MATKEY_EMISSION_SCALE "$oriel.emission", 0, 0

/// Corrects what Blender writes: units of lights and emission; metalness, which FBX has as
/// ReflectionFactor; and the grey of white FBX lights in files with a camera, whose template has
/// the camera's default colour .8.
/// Inputs:  emission_scale: in place of the factor for emission; unset: that of light_units.
/// Errors:  OR-MD-016 one note of the factors where there is light to scale.
/// Checked: LightUnits.*
void mend_light_units(aiScene& model, const std::string& suffix,
                      std::optional<float> emission_scale, Diagnostics& diagnostics);

}  // namespace oriel::models
