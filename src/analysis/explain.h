// SPDX-License-Identifier: Apache-2.0
// Explains the colour of a pixel: surfaces that its paths hit, and their light by source.
#pragma once

#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "render/session.h"
#include "runtime/world.h"

namespace oriel {

// Conventions
//   Colours are radiance in pixel units before exposure, and are shares of the colour of the pixel:
//   the light of all surfaces plus `unexplained` is that colour.

/// Kind of path segment that leads to a surface.
enum class PathSegment : std::uint8_t {
  Eye,           ///< from the camera
  Diffuse,       ///< diffuse reflection at the previous surface
  Translucency,  ///< diffuse transmission through the previous surface
  Reflection,
  Refraction,  ///< through a refracting interface
  Straight     ///< through a thin wall, undeflected
};

/// Light of one type from one source at a surface.
struct ExplainedLight {
  Aov part = Aov::Other;   ///< light-path AOV relative to the surface
  std::size_t source = 0;  ///< index into Explanation::sources
  Rgb light{0};
  double variance = 0;  ///< variance of the luminance of one sample
};

/// Samples of one light at a surface.
struct ExplainedLightSource {
  int light = -1;                    ///< index into World::lights; -1 = the environment
  Rgb unshadowed{0}, unoccluded{0};  ///< sums of samples, without and with occlusion
  std::uint64_t samples = 0;
  std::map<int, double> blockers;  ///< luminance occluded by each instance (first occluder)
};

/// A lobe of the material, averaged over the samples.
struct ExplainedLobe {
  LobeKind kind = LobeKind::Diffuse;
  Rgb weight{0};
  float roughness = 0;  ///< depends on the kind: radians, or the mean of alpha
  float eta = 1;
};

/// A parameter that is connected to another shader, at one shading point of the pixel.
struct ExplainedParameter {
  std::string name, source;   ///< name of the parameter; name of the connected shader
  std::vector<float> values;  ///< one number, three for a vector, four for a colour
};

/// A surface that paths reached from the camera or from another surface.
struct ExplainedSurface {
  PathSegment segment = PathSegment::Eye;
  std::size_t from = 0;  ///< index into Explanation::surfaces
  int instance = -1;     ///< index into World::instances; -1 = the camera
  const Material* material = nullptr;
  double hits = 0;  ///< mean number of paths per sample that hit it
  Vec3 position{0}, normal{0};
  float distance = 0;   ///< along the last ray
  float cosine = 0;     ///< of the view direction and the shading normal
  float back_side = 0;  ///< share of the paths that hit its back
  std::vector<ExplainedLobe> lobes;
  Rgb emission{0};
  float opacity = 1;
  std::vector<ExplainedParameter> parameters;
  std::vector<ExplainedLight> light;
  std::vector<ExplainedLightSource> lights;
  double records = 0, photons = 0;  ///< mean number of records and photons used per lookup
  double free = 1;                  ///< mean result of occlusion queries
  Occlusion occlusion;              ///< samples 0: not queried
  bool behind = false;  ///< seen by a diffuse bounce only; includes the light of deeper bounces

  Rgb total() const;  ///< light of this surface alone
};

/// A tone mapping step from the film to the displayed colour.
struct ExplainedMapping {
  const ShaderNode* shader = nullptr;
  bool output = false;  ///< output shader; else lens shader
  Rgb before{0}, after{0};
};

/// Explanation of one pixel.
struct Explanation {
  int x = 0, y = 0;  ///< from the upper left corner
  std::uint32_t samples = 0;
  Rgb colour{0}, variance{0};  ///< variance: of the mean
  Rgb shown{0};                ///< after lens shaders
  std::vector<ExplainedMapping> mappings;
  /// names of the light sources, indexed like World::light_layers
  std::vector<std::string> sources;
  std::vector<ExplainedSurface> surfaces;  ///< the first is the camera
  std::array<Rgb, kAovs> parts;            ///< the colour by light-path AOV of the first surface
  std::array<double, kAovs> noise{};       ///< variance of the luminance of one sample, by AOV
  Rgb unexplained{0};                      ///< light that lens and state shaders added or removed

  /// Light of a surface and of all surfaces behind it.
  Rgb total(std::size_t surface) const;
};

/// Assigns a separate light layer to each source: lights, emissive instances, the environment. If
/// there are too many, names that differ only in trailing digits share a layer, and the last ones
/// are merged.
void separate_light_layers(World& world);

/// Renders one pixel and explains its colour.
///
/// Model:   renders a session of one pixel with an ExplainObserver. Its samples are those of a
///          picture with the same sample count, and its maps are those of the whole picture.
/// Inputs:  picture: budget, seed, window and map files of the picture; x, y: counted from the
///          upper left; outputs: output shaders of the camera; its exposures are evaluated.
/// Checked: Explain.* in tests/explain/explain_test.cpp, tests/cli/explain_test.cpp
Explanation explain_pixel(World& world, const SessionSettings& picture, int x, int y,
                          const NodeList& outputs, const Progressive::Callbacks& callbacks = {},
                          const std::atomic<bool>* cancel = nullptr);

}  // namespace oriel
