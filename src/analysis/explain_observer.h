// SPDX-License-Identifier: Apache-2.0
// Accumulates path events to the surfaces of an explanation and their light.
#pragma once

#include <array>
#include <vector>

#include "analysis/explain.h"
#include "transport/path/path_observer.h"

namespace oriel {

/// Observes the paths of one pixel.
///
/// Model:   a surface is an instance and its material, reached from a previous surface by one type
///          of path segment. Behind a diffuse surface only the next surface is separate; it
///          includes the light of all further bounces. If a scattered ray hits a light source, the
///          light counts at the surface that scattered the ray, like its light samples.
class ExplainObserver final : public PathObserver {
 public:
  explicit ExplainObserver(const World& world);

  void begin_sample(bool negative) override;
  void set_weight(const Rgb& weight) override { weight_ = weight; }
  void end_sample(const Rgb& radiance) override;
  Place on_hit(Place from, ShadingPoint& point, const Material& material,
               const Closure& closure) override;
  Place on_scatter(Place at, LobeKind kind) override;
  void on_light(Place at, const LightPart& part, std::size_t layer, const Rgb& radiance) override;
  void on_light_sample(Place at, const ShadingPoint& point, const LightSampleEvent& event) override;
  void on_lookup(Place at, int records, int photons) override;
  void on_occlusion(Place at, const Occlusion& occlusion, float free) override;

  /// Writes the result. `positive`, `negative`: filter weights of positive and negative samples in
  /// the pixel.
  void write_to(float positive, float negative, Explanation& explanation) const;

 private:
  /// Sum over samples, separate for positive and negative filter samples, and its second moment.
  struct Sum {
    std::array<Imath::Vec3<double>, 2> light{Imath::Vec3<double>(0.0), Imath::Vec3<double>(0.0)};
    double squares = 0;  ///< of luminance
    Rgb current{0};      ///< of the current sample
    void end_sample(int kind);
  };
  struct Light {
    Aov part;
    std::size_t source;
    Sum sum;
  };
  struct Surface {
    ExplainedSurface facts;  ///< sums, to be divided by `hits` for means
    std::uint64_t hits = 0, lookups = 0, occlusions = 0;
    std::vector<std::size_t> lights, children;
  };
  static constexpr std::size_t kMaxSurfaces = 1 << 14, kMaxDepth = 24;

  static std::size_t surface_of(Place p) { return p >> 3; }
  static PathSegment segment_of(Place p) { return static_cast<PathSegment>(p & 7); }
  std::size_t child(std::size_t from, PathSegment segment, const ShadingPoint& point,
                    const Material& material);
  std::size_t depth_of(std::size_t surface) const;
  void add_lobes(const Closure& closure, ExplainedSurface& s) const;
  int blocker(const ShadingPoint& point, const LightSampleEvent& event) const;

  const World& world_;
  std::vector<Surface> surfaces_;
  std::vector<Light> lights_;
  std::vector<std::size_t> touched_;  ///< lights of the current sample
  std::array<Sum, kAovs> parts_;
  std::array<std::uint64_t, 2> samples_{};
  Rgb weight_{1};
  int kind_ = 0;  ///< of the current sample: 1 = negative filter sample
};

}  // namespace oriel
