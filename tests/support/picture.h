// SPDX-License-Identifier: Apache-2.0
// Renders composed scenes with the outputs of their materials, accessible by name.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "output/output.h"
#include "render/session.h"
#include "support/expect_near.h"
#include "support/probe.h"

namespace oriel::testing {

/// A session of a composed scene that has run.
class RenderedScene {
 public:
  explicit RenderedScene(const SceneText& scene, SessionSettings settings)
      : RenderedScene(scene.str(), std::move(settings)) {}
  explicit RenderedScene(const std::string& scene, SessionSettings settings,
                         const Registry& registry = test_registry())
      : probe_(scene, registry), session_(probe_.world(), std::move(settings)) {
    session_.run();
  }

  const RenderSession& session() const { return session_; }
  Rgba at(int x, int y) const { return session_.film().pixel(x, y).beauty; }
  /// Of all pixels of the beauty.
  Rgb mean() const;

 private:
  Probe probe_;
  RenderSession session_;
};

/// The mean over a film's beauty.
Rgb mean_of(const Film& film);

/// A rendered picture with its layers.
class Picture {
 public:
  explicit Picture(const SceneText& scene, std::uint32_t samples = 64, bool outputs = true)
      : Picture(scene.str(), samples, outputs) {}
  explicit Picture(const std::string& scene, std::uint32_t samples = 64, bool outputs = true);

  const std::vector<Layer>& layers() const { return layers_; }
  const Image& layer(const std::string& name) const;
  Rgb at(const std::string& name, int x, int y) const;
  /// Of all pixels.
  Rgb mean(const std::string& name) const;

 private:
  std::vector<Layer> layers_;
};

inline constexpr const char* kResults[] = {"diffuse_result", "spec_result",    "refl_result",
                                           "refr_result",    "tran_result",    "indirect_result",
                                           "add_result",     "opacity_result", "other"};

/// All light of the picture is in those results, the others are black to the last bit.
void expect_only(const Picture& p, const std::set<std::string>& wanted, const std::string& what);

/// Where b is zero or nearly so, the brightest channel bounds the rounding.
inline void expect_near_color(const Rgb& a, const Rgb& b, float relative, const std::string& what) {
  expect_near_relative(a, b, relative, what, 2e-7f * std::max(1.0f, max_component(b)));
}

}  // namespace oriel::testing
