// SPDX-License-Identifier: Apache-2.0
// Stages and checks that cases of the mia_ shaders share.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "effects.h"
#include "runtime/environment.h"
#include "runtime/shading_point.h"

namespace oriel::effects {

/// A parameter value, and its expected effect on a measurement with another value.
struct Made {
  std::string value;
  std::function<Rgb(const Rgb&)> of;
};

/// As gives, for figures of few digits: each channel within that share of the figure.
Case gives_about(const std::string& parameter, Stage stage, const std::string& others,
                 std::vector<Given> values, float share = 2e-3f);
/// Each parameter value gives the expected result relative to `base`.
Case makes(const std::string& parameter, Stage stage, const std::string& others,
           const std::string& base, std::vector<Made> values);

/// Measurement with this value, in a stage.
Measured measured_with(const std::string& parameter, const Stage& stage, const std::string& others,
                       const std::string& value);
/// Measured without chance.
Measured exactly(const Rgb& mean);
/// Fails unless each channel is within that share of the expected one.
void expect_about(const Rgb& value, const Rgb& expected, float share = 2e-3f);

/// Unit vector, z up, x at azimuth 0; degrees.
Vec3 toward(float elevation, float azimuth = 0);

/// The Rec. 709 luminance of what another stage measures, in all channels.
Stage luminance_of(Stage stage);

/// Tables of the environment's light with few entries: look-ups alone need no others.
inline const PrepareOptions kCoarse{.coarse_tables = true};
/// The shader as environment of that scene, as rays of a kind see it along a direction.
Stage seen_by(RayKind kind, const Vec3& direction, SceneText scene = SceneText(),
              float roughness = 0, const PrepareOptions& prepared = kCoarse);
/// The mean of that over the upper half space by the cosine: what a level white card shows.
Stage level_card(SceneText scene = SceneText());

/// Applies the shader as lens shader of a camera with focal 1 and aperture 1 to a uniform colour.
/// Returns the colour of the square picture at `place`, 0 to 1 from the lower left corner. `camera`
/// holds further statements of the camera.
Stage lens_map(const Rgb& color, Vec2 place = Vec2(.5f), const std::string& camera = {});

}  // namespace oriel::effects
