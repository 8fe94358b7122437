// SPDX-License-Identifier: Apache-2.0
// Observer of the hits and contributions of the paths of a picture: how a colour is
// explained.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/closure.h"
#include "runtime/material.h"
#include "runtime/shading_point.h"
#include "transport/path/aov.h"

namespace oriel {

/// Part of the light of a path: of the first material's outputs, and of the surface where it came.
struct LightPart {
  Aov of_first, here;
};

/// Told by the paths themselves, so what it hears is what the picture is made of. One thread at a
/// time. Paths that shaders ask for, and those before the picture, tell nothing: their light is
/// part of what the shader brings.
///
/// Checked: Explain.* in tests/explain/explain_test.cpp
class PathObserver {
 public:
  /// Where a path stands, in numbers that the witness gives out; 0 = the eye.
  using Place = std::uint32_t;
  static constexpr Place kEye = 0;

  virtual ~PathObserver() = default;

  /// A sample of the pixel begins; `negative`: as FilmSample. What comes until end() is its light.
  virtual void begin_sample(bool negative) = 0;
  /// From here on what comes counts so much: rays of a lens share a sample.
  virtual void set_weight(const Rgb& weight) = 0;
  virtual void end_sample(const Rgb& radiance) = 0;

  /// The way from a place ended at a surface. The point's tracer is null.
  virtual Place on_hit(Place from, ShadingPoint& point, const Material& material,
                       const Closure& closure) = 0;
  /// The path goes on from a surface by a lobe of that kind.
  virtual Place on_scatter(Place at, LobeKind kind) = 0;
  /// Light toward the eye; layer: as World::light_layers count.
  virtual void on_light(Place at, const LightPart& part, std::size_t layer,
                        const Rgb& radiance) = 0;

  /// A sample of a light, lit or not.
  struct LightSampleEvent {
    int light = -1;  ///< index into World::lights; -1 = the environment
    Vec3 wi{0};      ///< to the light
    float reach = 0;
    Rgb unshadowed{0};  ///< what the surface would show of it; black: it faces away
    Rgb open{1};        ///< share of the light that arrives
  };
  virtual void on_light_sample(Place at, const ShadingPoint& point,
                               const LightSampleEvent& asked) = 0;
  /// Gathered points or photons spoke for the light at a surface.
  virtual void on_lookup(Place at, int records, int photons) = 0;
  /// Occlusion was asked for; `free`: as free_share().
  virtual void on_occlusion(Place at, const Occlusion& occlusion, float free) = 0;
};

}  // namespace oriel
