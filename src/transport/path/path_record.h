// SPDX-License-Identifier: Apache-2.0
// What the paths of one camera sample leave: radiance, its parts, and the first surface.
#pragma once

#include <array>
#include <bitset>
#include <optional>
#include <span>
#include <vector>

#include "runtime/light_layers.h"
#include "runtime/material.h"
#include "transport/path/aov.h"
#include "transport/path/path_observer.h"

namespace oriel {

struct BounceReads;

/// The first surface that a camera path meets.
struct FirstSurface {
  int instance = -1;                   ///< index into World::instances; -1 = nothing
  const Material* material = nullptr;  ///< one of World::materials
};

/// The values that every path returns.
struct PathResult {
  Rgb radiance{0};  ///< pixel units, linear
  float alpha = 0;
  float depth = 0;  ///< distance to the first surface, scene units; 0 = none
  /// World, shading normal, and sum of the material's levels: of the first surface that is not only
  /// a mirror or clear glass, seen through those; else of the first surface.
  Vec3 normal{0};
  Rgb albedo{0};
  Rgb irradiance{0};  ///< of the first surface, if requested; see irradiance_sensor.h
  FirstSurface first;
};

/// Values of the first surface of a sample that layers show.
enum class SurfaceValue : std::uint8_t {
  Motion,    ///< raster_motion()
  Position,  ///< world, scene units
  Count
};
inline constexpr auto kSurfaceValues = static_cast<std::size_t>(SurfaceValue::Count);
using SurfaceValues = std::bitset<kSurfaceValues>;

/// Optional values of a record. Irradiance costs a second path.
struct RecordRequest {
  bool aovs = false, irradiance = false, first_surfaces = false;
  SurfaceValues surface_values = {};
  std::size_t light_layers = 0;  ///< World::light_layers.count(), or 0
};

/// The result of one camera sample, filled by its paths and read by the film. add() is the only way
/// to record light. Rays that shaders trace have records of their own (for_shader()), since the
/// shader decides how their light counts.
///
/// Checked: tests/analytic (outputs, light layers, motion), tests/explain
struct PathRecord : PathResult {
  PathRecord() = default;
  /// Inputs:  user_buffers: of World::user_buffers; shaders read and write them. observer:
  /// optional.
  explicit PathRecord(const RecordRequest& request, std::span<Rgba> buffers = {},
                      PathObserver* path_observer = nullptr)
      : requested(request), user_buffers(buffers), observer(path_observer) {
    reset();
  }
  PathRecord(const PathRecord&) = delete;
  PathRecord& operator=(const PathRecord&) = delete;

  RecordRequest requested;
  std::optional<AovValues> aovs;                    ///< the radiance by AOV
  LightParts by_light;                              ///< the radiance by light layer
  std::array<Vec3, kSurfaceValues> surface_values;  ///< by SurfaceValue, 0 unless requested
  std::vector<FirstSurface> first_surfaces;         ///< one per camera path
  std::span<Rgba> user_buffers;
  PathObserver* observer = nullptr;
  BounceReads* bounce_reads =
      nullptr;  ///< receives what the path reads of coarse records; optional

  /// For the next sample. User buffers belong to the caller.
  void reset() {
    static_cast<PathResult&>(*this) = {};
    if (requested.aovs) aovs.emplace();
    by_light.clear(requested.light_layers);
    surface_values.fill(Vec3(0));
    first_surfaces.clear();
  }

  bool wants(SurfaceValue value) const {
    return requested.surface_values[static_cast<std::size_t>(value)];
  }
  Vec3& operator[](SurfaceValue value) { return surface_values[static_cast<std::size_t>(value)]; }
  bool has_layers() const { return requested.light_layers > 0; }

  void add(PathObserver::Place place, const LightPart& part, std::size_t layer, const Rgb& light) {
    radiance += light;
    if (aovs) (*aovs)[part.of_first] += light;
    if (has_layers()) by_light.of[layer] += light;
    if (observer) observer->on_light(place, part, layer, light);
  }
  /// The same for light that is known by layers.
  void add(PathObserver::Place place, const LightPart& part, const Rgb& factor, const Rgb& light,
           const LightParts& layers) {
    radiance += factor * light;
    if (aovs) (*aovs)[part.of_first] += factor * light;
    for (std::size_t i = 0; i < requested.light_layers; ++i) {
      by_light.of[i] += factor * layers.of[i];
      if (observer) observer->on_light(place, part, i, factor * layers.of[i]);
    }
  }
  /// At the end of a camera path.
  void note_first_surface(const FirstSurface& surface) {
    if (requested.first_surfaces) first_surfaces.push_back(surface);
  }

  /// Scales all light.
  void scale(float factor);

  /// The record as the mean of several paths, each in a record of its own: begin, add, end. Depth
  /// and irradiance are means over the paths that hit something, the motion is that of the first.
  void begin_mean();
  void add_path(const PathRecord& path, const Rgb& weight, float share);
  void end_mean();

 private:
  int paths_ = 0, hits_ = 0;  ///< of the mean
};

}  // namespace oriel
