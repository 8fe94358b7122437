// SPDX-License-Identifier: Apache-2.0
// How the colour of a pixel came about, as facts: what its paths met, which light each step
// brought.
#pragma once

#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "render/session.h"
#include "runtime/world.h"

namespace oriel {

// Conventions
//   Colours are radiance in pixel units, before exposures, and are shares of the pixel's colour:
//   all light of all surfaces, and what is `unexplained`, sums to it.

/// How the paths came to a surface.
enum class PathSegment : std::uint8_t {
  Eye,           ///< from the camera
  Diffuse,       ///< a diffuse surface is lit by it
  Translucency,  ///< the same through the surface
  Reflection,
  Refraction,  ///< through an interface that bends
  Straight     ///< through a thin wall
};
inline constexpr std::size_t kWays = 6;

/// One kind of light at a surface, of one source.
struct ExplainedLight {
  Aov part = Aov::Other;   ///< of the surface where it came
  std::size_t source = 0;  ///< index into Explanation::sources
  Rgb light{0};
  double variance = 0;  ///< of the luminance that one sample finds
};

/// What a light does at a surface.
struct ExplainedLamp {
  int light = -1;  ///< index into World::lights; -1 = the environment
  Rgb unshadowed{0}, arrived{0};
  std::uint64_t samples = 0;
  std::map<int, double> blockers;  ///< luminance that an instance keeps away, first met
};

/// A lobe of the material in the mean: what the surface does with light.
struct ExplainedLobe {
  LobeKind kind = LobeKind::Diffuse;
  Rgb weight{0};
  float roughness = 0;  ///< as the kind has it: radians, or the mean of alpha
  float eta = 1;
};

/// A parameter that other shaders give, at one point that the pixel shows.
struct ExplainedParameter {
  std::string name, source;   ///< of the parameter; name of the shader that gives it
  std::vector<float> values;  ///< one number, three of a vector, four of a colour
};

/// A surface, or what a way from one leads to.
struct ExplainedSurface {
  PathSegment way = PathSegment::Eye;
  std::size_t from = 0;  ///< index into Explanation::surfaces
  int instance = -1;     ///< index into World::instances; -1 = the eye
  const Material* material = nullptr;
  double met = 0;  ///< paths that met it, in the mean over samples of the pixel
  Vec3 position{0}, normal{0};
  float distance = 0;   ///< along its last ray
  float cosine = 0;     ///< of view and shading normal
  float back_side = 0;  ///< share of the paths that saw it from behind
  std::vector<ExplainedLobe> lobes;
  Rgb emission{0};
  float opacity = 1;
  std::vector<ExplainedParameter> parameters;
  std::vector<ExplainedLight> light;
  std::vector<ExplainedLamp> lamps;
  double records = 0, photons = 0;  ///< that spoke at a look-up, in the mean
  double free = 1;                  ///< mean answer where occlusion was asked for
  Occlusion occlusion;              ///< samples 0: it was not
  bool behind = false;              ///< it only lights a diffuse surface: deeper bounces are in it

  Rgb total() const;  ///< of its own light
};

/// A step of the colour on its way to what is looked at.
struct ExplainedMapping {
  const ShaderNode* shader = nullptr;
  bool output = false;  ///< an output shader, else one of the lens
  Rgb before{0}, after{0};
};

/// Of one pixel.
struct Explanation {
  int x = 0, y = 0;  ///< from the upper left
  std::uint32_t samples = 0;
  Rgb colour{0}, variance{0};  ///< variance: of the mean
  Rgb shown{0};                ///< after lens shaders
  std::vector<ExplainedMapping> mappings;
  std::vector<std::string> sources;        ///< of light, as World::light_layers counts
  std::vector<ExplainedSurface> surfaces;  ///< the first is the eye itself
  std::array<Rgb, kAovs> parts;            ///< the colour by the first material's outputs
  std::array<double, kAovs> noise{};       ///< variance of one sample's luminance, by the same
  Rgb unexplained{0};                      ///< what lens and state shaders made of it

  /// All light that came by a surface: its own and that of what is behind it.
  Rgb total(std::size_t surface) const;
};

/// Keeps each source of light of the world apart: lights, glowing instances, the environment. Of
/// too many those of like names (digits at the end apart) share a layer, then the last ones.
void part_sources(World& world);

/// Renders one pixel and tells how its colour came about.
///
/// Model:   a session of one pixel with a witness: its samples are those of a picture of so many
///          samples, its maps those of the whole picture.
/// Inputs:  asked: budget, seed, window and map files of the picture; x, y: from the upper left, in
///          the picture; outputs: of the camera, the exposures among them are followed.
/// Checked: Explain.* in tests/explain/explain_test.cpp, tests/cli/explain_test.cpp
Explanation explain_pixel(World& world, const SessionSettings& asked, int x, int y,
                          const NodeList& outputs, const Progressive::Callbacks& callbacks = {},
                          const std::atomic<bool>* cancel = nullptr);

}  // namespace oriel
