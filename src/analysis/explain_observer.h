// SPDX-License-Identifier: Apache-2.0
// What paths tell, put together: the surfaces of an explanation and their light.
#pragma once

#include <array>
#include <vector>

#include "analysis/explain.h"
#include "transport/path/path_observer.h"

namespace oriel {

/// Listens to the paths of one pixel.
///
/// Model:   a surface is what paths of one kind of way met from the surface before: an instance and
///          its material. Behind a diffuse surface only the first is kept apart; the light of all
///          further bounces is its own. Light that rays find of a source counts as that of the
///          surface which sent the ray, as samples of the source do.
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
  void on_light_sample(Place at, const ShadingPoint& point, const LightSampleEvent& asked) override;
  void on_lookup(Place at, int records, int photons) override;
  void on_occlusion(Place at, const Occlusion& occlusion, float free) override;

  /// What was heard. `plain`, `marked`: weights of both kinds of samples in the pixel.
  void tell(float positive, float negative, Explanation& explanation) const;

 private:
  /// A sum over samples, plain and marked ones apart, and how much single samples vary.
  struct Sum {
    std::array<Imath::Vec3<double>, 2> light{Imath::Vec3<double>(0.0), Imath::Vec3<double>(0.0)};
    double squares = 0;  ///< of luminances
    Rgb current{0};      ///< of the sample under way
    void keep(int kind);
  };
  struct Light {
    Aov part;
    std::size_t source;
    Sum sum;
  };
  struct Surface {
    ExplainedSurface facts;  ///< sums over `met` where means are wanted
    std::uint64_t met = 0, look_ups = 0, occlusions = 0;
    std::vector<std::size_t> lights, children;
  };
  static constexpr std::size_t kMostSurfaces = 1 << 14, kMostDepth = 24;

  static std::size_t surface_of(Place p) { return p >> 3; }
  static PathSegment way_of(Place p) { return static_cast<PathSegment>(p & 7); }
  std::size_t child(std::size_t from, PathSegment way, const ShadingPoint& point,
                    const Material& material);
  std::size_t depth_of(std::size_t surface) const;
  void note_lobes(const Closure& closure, ExplainedSurface& s) const;
  int blocker(const ShadingPoint& point, const LightSampleEvent& asked) const;

  const World& world_;
  std::vector<Surface> surfaces_;
  std::vector<Light> lights_;
  std::vector<std::size_t> touched_;  ///< lights of the sample under way
  std::array<Sum, kAovs> parts_;
  std::array<std::uint64_t, 2> samples_{};
  Rgb weight_{1};
  int kind_ = 0;  ///< of the sample under way: 1 = marked
};

}  // namespace oriel
