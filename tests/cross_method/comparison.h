// SPDX-License-Identifier: Apache-2.0
// Renders a scene with path tracing, final gathering and photons, and compares the images.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "color/luminance.h"
#include "output/output.h"
#include "output/output_names.h"
#include "prepare/testing/prepared_scene.h"
#include "render/session.h"
#include "support/scene_text.h"

namespace oriel::cross_method {

using scene::IndirectMethod;
using testing::SceneText;
using testing::text_of;

struct Method {
  IndirectMethod id;
  const char* name;  ///< as the command line has it
};
inline constexpr Method kPath{IndirectMethod::Path, "path"},
    kPathCache{IndirectMethod::PathCache, "path+cache"},
    kFinalGather{IndirectMethod::FinalGather, "fg"},
    kBoth{IndirectMethod::FinalGatherPhotons, "fg+photons"};

/// Whether the rows of the tables are printed.
inline bool figures_wanted() { return std::getenv("ORIEL_FIGURES") != nullptr; }

using Values = std::vector<double>;  // double: sums of thousands

inline double mean_of(const Values& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / double(values.size());
}

/// Mean over pixels of the squared difference by the squared reference. Dark pixels count as a
/// tenth of the picture's mean.
inline double relative_mse(const Values& a, const Values& reference) {
  const double mean = mean_of(reference), dark = 0.01 * mean * mean;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double r = reference[i], d = a[i] - r;
    sum += d * d / (r * r + dark);
  }
  return sum / double(a.size());
}

/// A mean over pictures and its standard error.
struct Level {
  double mean = 0, error = 0;
  explicit Level(const Values& of_pictures) : mean(mean_of(of_pictures)) {
    const double n = double(of_pictures.size());
    for (const double v : of_pictures) error += (v - mean) * (v - mean);
    error = n > 1 ? std::sqrt(error / (n - 1) / n) : 0;
  }
};

/// Luminance of some pictures of one scene.
struct Measured {
  std::vector<Values> pictures;
  Values pixels;         ///< means over the pictures
  Level picture;         ///< of whole pictures
  Level indirect;        ///< of their layer indirect_result
  double noise_mse = 0;  ///< relative MSE that `pixels` has by noise alone; from two pictures on
  double seconds = 0;    ///< of one picture
};

/// A scene to be rendered by several methods.
class Comparison {
 public:
  explicit Comparison(const SceneText& text) : scene_(text.str()) {
    if (!scene_.world) throw std::runtime_error(scene_.messages());
    for (const Diagnostic& d : scene_.diagnostics.all())
      if (d.severity >= Severity::Warning) ADD_FAILURE() << scene_.diagnostics.format(d);
  }

  /// Pictures with seeds of their own, each of `samples` for a pixel.
  Measured render(const Method& method, std::uint32_t samples, int pictures) {
    scene_.world->options.indirect = method.id;
    const auto start = std::chrono::steady_clock::now();
    std::vector<Values> all;
    Values wholes, indirects;
    for (int i = 0; i < pictures; ++i) {
      RenderSession session(
          *scene_.world,
          {.budget = {.samples = samples}, .seed = std::uint32_t(i + 1), .outputs = true});
      session.run();
      const auto layers = film_layers(session, LayerSet(LayerGroup::Outputs));
      all.push_back(luminances(layers.front().image));
      wholes.push_back(mean_of(all.back()));
      indirects.push_back(mean_of(luminances(find_layer(layers, "indirect_result")->image)));
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    Measured m{all, means(all), Level(wholes), Level(indirects), 0, took.count() / pictures};
    if (pictures > 1)
      for (const Values& one : all)
        m.noise_mse += relative_mse(one, m.pixels) / (pictures - 1) / pictures;
    return m;
  }

 private:
  static Values luminances(const Image& image) {
    Values values;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const float* p = image.at(x, y);
        values.push_back(luminance(Rgb(p[0], p[1], p[2])));
      }
    return values;
  }
  static Values means(const std::vector<Values>& all) {
    Values sum(all.front().size(), 0);
    for (const Values& one : all)
      for (std::size_t i = 0; i < one.size(); ++i) sum[i] += one[i] / double(all.size());
    return sum;
  }

  oriel::testing::PreparedScene scene_;
};

}  // namespace oriel::cross_method
