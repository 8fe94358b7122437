// SPDX-License-Identifier: Apache-2.0
// Anisotropy axis of reflections, refractions and highlights, fitted to rendered light for each
// source of the base direction.
#include <cmath>

#include "shaders/architectural/mia_material.h"
#include "support/probe.h"

namespace oriel::testing {
namespace anisotropy_test {

/// "test_axis": as environment the doubled azimuth of the direction, (1 + cos 2 phi) / 2 and
/// (1 + sin 2 phi) / 2, and 1: means over a lobe give its axis whatever its shape.
constexpr ShaderSpec kTestAxis = {
    .name = "test_axis",
    .library = "test",
    .apply = kApplyEnvironment,
    .value =
        [](const Call& call, void* result) {
          const Vec3& d = call.point.ray_direction;
          const float r2 = d.x * d.x + d.y * d.y;
          const float c = r2 > 0 ? (d.x * d.x - d.y * d.y) / r2 : 0;
          const float s = r2 > 0 ? 2 * d.x * d.y / r2 : 0;
          *static_cast<Rgba*>(result) = Rgba((1 + c) / 2, (1 + s) / 2, 1, 1);
        },
};

const Registry& axis_registry() {
  static const Registry all = test_registry_with({&kTestAxis});
  return all;
}

Vec3 direction(float turns) { return Vec3(std::cos(turns * kTwoPi), std::sin(turns * kTwoPi), 0); }

/// The plate's base directions, turns from its own x axis, and how far the plate itself is turned.
constexpr float kTurned = 0.07f;
constexpr float kCoordinates = 0.05f, kCoordinatesOfSpace1 = 0.14f, kBump = 0.11f,
                kBumpOfSpace1 = 0.18f, kDerivative = 0.23f,
                kVector = 0.31f;  // the vector is in world space

/// A square from -1 to 1, front up, with two texture spaces and bump bases; coordinates run
/// along kCoordinates and kCoordinatesOfSpace1, 0.5 at the middle.
std::string plate(bool derivatives) {
  std::string vectors, vertices;
  const Vec3 corners[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const auto basis = [&](float turns) {
    return text_of(direction(turns)) + "\n" + text_of(direction(turns + .25f)) + "\n";
  };
  vectors += "0 0 1\n" + basis(kBump) + basis(kBumpOfSpace1) + basis(kDerivative);
  for (int i = 0; i < 4; ++i) {
    const Vec3 p = corners[i];
    vectors += text_of(p) + "\n";
    for (const float turns : {kCoordinates, kCoordinatesOfSpace1})
      vectors += text_of(Vec3(.5f + dot(p, direction(turns)) / 2,
                              .5f + dot(p, direction(turns + .25f)) / 2, 0)) +
                 "\n";
    vertices += fmt::format("v {} n 0 {} t {} 1 2 t {} 3 4\n", 7 + 3 * i,
                            derivatives ? "d 5 6" : "", 8 + 3 * i, 9 + 3 * i);
  }
  return fmt::format(
      "object \"plate\" visible on shadow on trace on\ngroup\n{}{}c 0 1 2 3\nend group\n"
      "end object\n",
      vectors, vertices);
}

enum class Output { Reflection, Refraction, ThinRefraction, Highlight };

const char* parameters_of(Output output) {
  switch (output) {
    case Output::Refraction:
      return "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"refr_ior\" 1.5, "
             "\"refr_gloss\" .5";
    case Output::ThinRefraction:
      return "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"thin_walled\" on, "
             "\"refr_gloss\" .5";
    case Output::Highlight:
      return "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
             "\"refl_gloss\" .5, \"refl_hl_only\" on";
    case Output::Reflection:
      break;
  }
  return "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, \"refl_gloss\" .5";
}

/// A plate of that output under the axis' environment, turned by kTurned unless `turned` is not
/// set; `extra` are elements before the material and `more` its parameters.
std::string plate_scene(Output output, const std::string& more, bool derivatives,
                        const std::string& extra = {}, const std::string& light = {},
                        bool turned = true) {
  SceneText scene;
  if (light.empty())
    scene.environment("\"test_axis\" ()");
  else
    scene.light("lamp", light);
  const float c = std::cos(kTurned * kTwoPi), s = std::sin(kTurned * kTwoPi);
  const std::string transform =
      turned ? fmt::format("transform {} {} 0 0 {} {} 0 0 0 0 1 0 0 0 0 1", c, -s, s, c) : "";
  scene.statement(extra)
      .statement(plate(derivatives))
      .statement(fmt::format("shader \"surface\" \"mia_material_x\" ( {}, \"anisotropy\" 5, {} )",
                             parameters_of(output), more))
      .statement(fmt::format("material \"m\" \"oriel_tex_vector\" ( \"vector\" {} ) = \"surface\" "
                             "end material",
                             text_of(direction(kVector) * 2.0f)))
      .statement(
          fmt::format("instance \"plate_i\" \"plate\" {} material \"m\" end instance", transform));
  std::string text = scene.str();
  const std::string members = "instgroup \"world\" \"cam_i\"";
  return text.insert(text.find(members) + members.size(), " \"plate_i\"");
}

/// Turns, 0...0.5, and how pronounced the axis is, 0...1.
struct Axis {
  float turns = 0, strength = 0;
};

Axis axis_of(float c, float s) {
  const float turns = std::atan2(s, c) / 2 / kTwoPi;
  return {turns < 0 ? turns + .5f : turns, std::hypot(c, s)};
}

/// Fits the axis of what the plate shows at a point to a viewer straight above.
Axis fitted(const Probe& probe, const Vec3& at = Vec3(0), int samples = 32768) {
  const Measured m = probe.onto(at, Vec3(0, 0, 1), 0, samples);
  return axis_of(2 * m.mean.x / m.mean.z - 1, 2 * m.mean.y / m.mean.z - 1);
}

/// The same from highlights of a distant light that moves on a circle.
Axis fitted_highlight(const std::string& more, bool derivatives) {
  constexpr int kAround = 40;
  float c = 0, s = 0, sum = 0;
  for (int i = 0; i < kAround; ++i) {
    const float turns = (static_cast<float>(i) + .5f) / kAround;
    const Vec3 way = -normalize(direction(turns) * .3f + Vec3(0, 0, 1));
    const std::string light =
        fmt::format("\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction {}", text_of(way));
    const Probe probe(plate_scene(Output::Highlight, more, derivatives, {}, light),
                      axis_registry());
    const float seen = probe.onto(Vec3(0), Vec3(0, 0, 1), 0, 64).mean.x;
    c += seen * std::cos(2 * turns * kTwoPi);
    s += seen * std::sin(2 * turns * kTwoPi);
    sum += seen;
  }
  return axis_of(c / sum, s / sum);
}

/// Between two axes.
float turns_apart(float a, float b) {
  const float d = std::abs(a - b) - .5f * std::floor(std::abs(a - b) / .5f);
  return std::min(d, .5f - d);
}

/// Turns. Rays: five times the largest error met; a ring of 40 lights aliases the narrow lobe.
constexpr float kRayTolerance = 0.0005f, kHighlightTolerance = 0.001f;

// acceptance: A3, A4
TEST(Anisotropy, EachSourceTurnsReflectionsRefractionsAndHighlightsAlike) {
  struct Source {
    int channel;
    float turns;
    bool derivatives;
    const char* name;
  };
  const Source sources[] = {{0, kTurned + kCoordinates, false, "texture space 0"},
                            {0, kTurned + kCoordinates, true, "texture space 0, derivatives given"},
                            {1, kTurned + kCoordinatesOfSpace1, false, "texture space 1"},
                            {-1, kTurned, false, "object"},
                            {-2, kTurned + kBump, false, "bump basis"},
                            {-3, kTurned + kDerivative, true, "derivatives"},
                            {-4, kVector, false, "vector"}};
  const std::pair<Output, const char*> outputs[] = {{Output::Reflection, "reflection"},
                                                    {Output::Refraction, "refraction"},
                                                    {Output::ThinRefraction, "thin refraction"},
                                                    {Output::Highlight, "highlight"}};
  for (const Source& source : sources)
    for (const auto& [output, output_name] : outputs)
      for (const float rotation : {0.0f, 0.1f}) {
        const std::string name =
            fmt::format("{} by {}, rotation {}", output_name, source.name, rotation);
        const std::string more = fmt::format(
            "\"anisotropy_channel\" {}, \"anisotropy_rotation\" {}", source.channel, rotation);
        const Axis axis =
            output == Output::Highlight
                ? fitted_highlight(more, source.derivatives)
                : fitted(Probe(plate_scene(output, more, source.derivatives), axis_registry()));
        EXPECT_LT(turns_apart(axis.turns, source.turns + rotation),
                  output == Output::Highlight ? kHighlightTolerance : kRayTolerance)
            << name << ": " << axis.turns << " for " << source.turns + rotation;
        EXPECT_GT(axis.strength, .3f) << name;
        figure(name + ", turns", std::fmod(source.turns + rotation, .5f), axis.turns, 0);
      }
}

/// A rotation that wraps around in the middle of the plate: 252/255 and 3/255 of a turn.
const std::string kSeam =
    "color texture \"seam\" [2 1 1] 'fc03'\n"
    "shader \"place\" \"mib_texture_vector\" ( \"select\" 0 )\n"
    "shader \"direct\" \"mib_texture_lookup\" ( \"tex\" \"seam\", \"coord\" = \"place\" )\n"
    "color texture \"inner\" \"mib_texture_lookup\" ( \"tex\" \"seam\", \"coord\" = \"place\" )\n"
    "shader \"chained\" \"mib_texture_lookup\" ( \"tex\" \"inner\", \"coord\" = \"place\" )\n";
constexpr float kLeft = 252.0f / 255, kRight = 3.0f / 255;

// acceptance: A2, A3
TEST(AnisotropyRotation, ATextureIsNeverAveragedAcrossItsSeam) {
  for (const char* const source : {"direct", "chained"}) {
    const Probe probe(
        plate_scene(Output::Reflection,
                    fmt::format("\"diffuse_roughness\" = \"{0}\", \"anisotropy_rotation\" = "
                                "\"{0}\", \"refl_gloss\" = \"{0}\"",
                                source),
                    false, kSeam),
        axis_registry());
    const ShaderNode* node = nullptr;
    for (const Material& m : probe.world().materials)
      if (m.name == "m") node = m.surface.back();
    ASSERT_NE(node, nullptr);
    int between = 0;
    for (const float width : {0.0f, 1e-3f, .1f, 1.0f, 10.0f})
      for (int i = 0; i < 1000; ++i) {
        ShadingPoint point;
        point.world = &probe.world();
        point.texture_spaces = 1;
        point.tex[0] = Vec3((static_cast<float>(i) + .5f) / 1000, .5f, 0);
        point.dpdu = Vec3(1, 0, 0);
        point.dpdv = Vec3(0, 1, 0);
        point.dpdx = Vec3(width, 0, 0);
        point.dpdy = Vec3(0, width, 0);
        node->with_params(point, [&](const Call& call) {
          const auto& p = call.as<MiaMaterialParams>();
          EXPECT_FLOAT_EQ(p.anisotropy_rotation, i < 500 ? kLeft : kRight) << width << ' ' << i;
          // The same shader at other parameters is filtered as ever.
          EXPECT_EQ(p.diffuse_roughness, p.refl_gloss);
          between += p.refl_gloss > .02f && p.refl_gloss < .98f;
        });
        EXPECT_EQ(point.look_up, LookUp::Filtered);
      }
    EXPECT_GT(between, 3000) << source;
  }
}

// acceptance: A2, A3
TEST(AnisotropyRotation, TheAxisTurnsByTheStepOfTheSeamOnly) {
  for (const char* const source : {"direct", "chained"}) {
    const Probe probe(
        plate_scene(Output::Reflection, fmt::format("\"anisotropy_rotation\" = \"{}\"", source),
                    false, kSeam, {}, false),
        axis_registry());
    // Right at the seam, and where interpolation would have turned by a quarter.
    for (const float distance : {.002f, .25f}) {
      const Vec3 along = direction(kCoordinates) * distance;
      const Axis left = fitted(probe, -along, 1 << 16), right = fitted(probe, along, 1 << 16);
      EXPECT_LT(turns_apart(left.turns, kLeft - .5f), kRayTolerance) << distance;
      EXPECT_LT(turns_apart(right.turns, kRight), kRayTolerance) << distance;
      EXPECT_NEAR(turns_apart(left.turns, right.turns), kRight + 1 - kLeft, 2 * kRayTolerance)
          << distance;
      EXPECT_GT(std::min(left.strength, right.strength), .3f);
    }
  }
}

}  // namespace anisotropy_test
}  // namespace oriel::testing
