// SPDX-License-Identifier: Apache-2.0
// Renders composed scenes with the outputs of their materials, to look at by name.
#pragma once

#include <set>

#include "output/output.h"
#include "output/output_names.h"
#include "probe.h"

namespace oriel::analytic {

/// A rendered picture with its layers.
class Picture {
 public:
  explicit Picture(const SceneText& scene, std::uint32_t samples = 64, bool outputs = true)
      : Picture(scene.str(), samples, outputs) {}
  explicit Picture(const std::string& scene, std::uint32_t samples = 64, bool outputs = true) {
    const Probe probe(scene);
    RenderSession session(probe.world(), {.budget = {.samples = samples}, .outputs = outputs});
    session.run();
    layers_ = film_layers(session, LayerSet(LayerGroup::Outputs));
  }

  const std::vector<Layer>& layers() const { return layers_; }
  const Image& layer(const std::string& name) const {
    const Layer* found = find_layer(layers_, name);
    if (!found) throw std::runtime_error("no layer " + name);
    return found->image;
  }
  Rgb at(const std::string& name, int x, int y) const {
    const Image& image = layer(name);
    const float* p = image.at(x, y);
    return image.channels == 1 ? Rgb(*p) : Rgb(p[0], p[1], p[2]);
  }
  /// Of all pixels.
  Rgb mean(const std::string& name) const {
    const Image& image = layer(name);
    Imath::Vec3<double> sum(0.0);  // double: a mean of thousands
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) sum += Imath::Vec3<double>(at(name, x, y));
    return Rgb(Imath::V3f(sum / double(image.pixel_count())));
  }

 private:
  std::vector<Layer> layers_;
};

inline constexpr const char* kResults[] = {"diffuse_result", "spec_result",    "refl_result",
                                           "refr_result",    "tran_result",    "indirect_result",
                                           "add_result",     "opacity_result", "other"};

/// All light of the picture is in those results, the others are black to the last bit.
inline void expect_only(const Picture& p, const std::set<std::string>& wanted,
                        const std::string& what) {
  for (const std::string name : kResults) {
    if (wanted.count(name))
      EXPECT_GT(p.mean(name).x, 1e-3f) << what << ": " << name;
    else
      EXPECT_EQ(p.mean(name), Rgb(0)) << what << ": " << name;
  }
}

/// Where b is zero or nearly so, the brightest channel bounds the rounding.
inline void expect_near(const Rgb& a, const Rgb& b, float relative, const std::string& what) {
  const float floor = 2e-7f * std::max(1.0f, max_component(b));
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(a[k], b[k], std::max(relative * std::abs(b[k]), floor)) << what << ' ' << k;
}

}  // namespace oriel::analytic
