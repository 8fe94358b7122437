// SPDX-License-Identifier: Apache-2.0
// From a model of another program, or a scene, to a .mi file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "trust_options.h"

namespace oriel::app {

/// What the user asked for.
struct ConvertArguments {
  std::string model, output, size, up;
  std::vector<std::string> include_paths;  ///< for scenes
  std::vector<float> sun;                  ///< azimuth and elevation, degrees; or empty
  std::optional<float> emission_scale;
  std::optional<float> animation_time;  ///< seconds
  std::string sky;                      ///< picture of the environment; empty: none
  float sky_rotation = 0;               ///< degrees
  bool daylight = false, quiet = false;
  bool force = false;  ///< replace a scene that the user wrote or edited
  TrustArguments trust = {};
};

/// The result names pictures in the folder of the model.
TrustArguments trust_of_result(const ConvertArguments& arguments);

bool is_mi(const std::filesystem::path& path);
/// Whether the name is that of a model, by its suffix.
bool is_model(const std::filesystem::path& path);

/// Reads the model, adds what a picture needs and writes the scene to `to`.
///
/// Model:   A camera of the file that sees the model takes the picture, else one of our own. For
///          the model's own lights a light meter exposes. In daylight the exposure is that of a
///          sunny day; for a camera of the file that of the meter, and where
///          next to no light comes, as inside of what is closed, the camera is one of our own.
/// Returns: whether all textures of the model were written, too.
/// Errors:  UserError where something cannot be read or written, or where the scene exists and is
///          not an unedited result of a conversion; OR-MD-007, OR-MD-013.
/// Checked: ConvertTest.*
bool convert_model(const ConvertArguments& a, const std::string& to);

}  // namespace oriel::app
