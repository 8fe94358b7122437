// SPDX-License-Identifier: Apache-2.0
// Cases that show what a parameter of a shader changes: a scene around the shader's call is
// measured for several values of the parameter, and what is measured must change as the manual
// says.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "support/probe.h"

namespace oriel::effects {

using testing::kUp;
using testing::Measured;
using testing::Probe;
using testing::SceneText;
using testing::text_of;

/// A scene around a shader's call (`.mi` text: "name" ( "parameter" value, ... )) and what is
/// measured in it.
using Stage = std::function<Measured(const std::string& call)>;

/// One parameter and a check of its documented effect.
struct Case {
  std::string parameter;  ///< "shader.parameter"
  std::function<void()> check;
};
using Cases = std::vector<Case>;
inline void PrintTo(const Case& c, std::ostream* out) { *out << c.parameter; }

/// A value as `.mi` writes it and what must be measured with it.
struct Given {
  std::string value;
  Rgb expected;
};

/// The call of a shader. `parameters` is "name value, name value"; of repeated names the last
/// counts. Values may hold brackets and strings, and connections: `= "shader"`.
std::string call_of(std::string_view shader, const std::string& parameters);

/// The measured value increases with each parameter value, in this channel, beyond noise.
Case rises(const std::string& parameter, Stage stage, const std::string& others,
           std::vector<std::string> values, int channel = 0);
/// The same downward.
Case falls(const std::string& parameter, Stage stage, const std::string& others,
           std::vector<std::string> values, int channel = 0);
/// Each parameter value gives the result of a closed form.
Case gives(const std::string& parameter, Stage stage, const std::string& others,
           std::vector<Given> values);
/// The second value gives `factor` times what the first does, in all channels.
Case scales(const std::string& parameter, Stage stage, const std::string& others,
            const std::string& one, const std::string& other, float factor);
/// Any other check; `check` takes the measurements.
Case shows(const std::string& parameter, std::function<void()> check);

/// A further thing to show of the same parameter.
Case both(Case first, const Case& second);

/// Brighter by more than chance.
void expect_more(const Measured& more, const Measured& less, int channel = 0);

// Stages.

/// Result of a shader of any plain type as light, `seen` of a square of 20 units at z = -5 with
/// texture coordinates 0 to 1, by a camera at the origin that looks down -z: radiance at the given
/// place of its picture (0 to 1 from the lower left corner). `elements` are further elements before
/// the material's: textures, shaders, lights with their instances. Alpha is not shown.
Stage value(const std::string& elements = {}, Vec2 place = Vec2(.5f, .5f));
/// The same for a member of a struct result.
Stage member(const std::string& name, const std::string& elements = {},
             Vec2 place = Vec2(.5f, .5f));

/// The shader as the material of a square that faces the camera above it, at `degrees` from its
/// normal, under a sun of radiance-to-be 1 from straight above (a white Lambert surface shows 1)
/// and no sky.
Stage material_in_sun(float degrees = 0, int samples = 256);
/// The same under a sky of radiance 1 without a sun.
Stage material_in_sky(float degrees = 0, int samples = 4096);

/// The shader of a light at (0, 0, 2) that shines down onto a white Lambert square at the origin,
/// seen at `at`. `element` are the light's further statements.
Stage light(const std::string& element = "origin 0 0 2", const Vec3& at = Vec3(0),
            int samples = 256);

/// Elements that define material "m" as what shows a call's result, or that member of it, as light;
/// `elements` come before. Needs known_shaders().
std::string shown_as_light(const std::string& call, const std::string& elements = {},
                           const std::string& result = {});
/// All built-in shaders and those for tests.
const Registry& known_shaders();

/// The shader as the scene's environment, seen along that direction.
Stage environment(const Vec3& direction, int samples = 64);

// Shaders for tests, known in every stage:
//   test_show ( color, scalar, vector, integer, boolean ): all of it added, as light of a material
//   test_place ( scale ): the place of the point in world space as a colour
//   test_sky ( above, below, up ): an environment of two half spaces

}  // namespace oriel::effects
