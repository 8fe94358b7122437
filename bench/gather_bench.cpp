// SPDX-License-Identifier: Apache-2.0
// How much longer do paths take to look as good as final gathering does?
//
//     gather_bench [room] [interior] [emulated] [interpolated]      all when none is named
//
// Pictures are exposed alike, encoded for a screen and compared with a converged one by FLIP. Final
// gathering has 16 samples for each pixel; paths get more and more until their mean FLIP is as low.
// Then both take turns for the time. What reflections cost that final gathering or interpolation
// makes up is measured likewise. Converged pictures are kept in the temporary folder: delete them
// when the scenes change.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/parallel.h"
#include "bench_scenes.h"
#include "color/luminance.h"
#include "color/srgb.h"
#include "image/files.h"
#include "image/flip.h"
#include "prepare/testing/prepared_scene.h"
#include "render/session.h"
#include "shaders/registry.h"
#include "timing.h"

namespace {

using namespace oriel;
using scene::IndirectMethod;

constexpr int kSamples = 16;
/// Beyond what was rendered the line through the last points goes on, this far at most.
constexpr double kFurthest = 4;

/// Linear light, RGB.
Image linear_image(const RenderSession& session) {
  const Film& film = session.film();
  Image image(film.width(), film.height(), 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int k = 0; k < 3; ++k) image.at(x, y)[k] = film.pixel(x, y).beauty[k];
  return image;
}

struct Scene : oriel::testing::PreparedScene {
  /// Inputs:  path: what includes are relative to.
  explicit Scene(const std::string& text, int width = 0, int height = 0,
                 const std::string& path = "scene.mi")
      : PreparedScene(text, builtin_shaders(), {.width = width, .height = height}, path) {
    for (const Diagnostic& d : diagnostics.all())
      if (d.severity != Severity::Note) fmt::print(stderr, "{}\n", diagnostics.format(d));
    if (!world) throw std::runtime_error("the scene cannot be rendered");
  }

  /// Passes of gather points, photons and grids are part of it.
  Image render(IndirectMethod method, int samples, std::uint32_t seed) const {
    world->options.indirect = method;
    RenderSession session = begin(samples, seed);
    session.run();
    return linear_image(session);
  }
  RenderSession begin(int samples, std::uint32_t seed) const {
    SessionSettings settings;
    settings.budget.samples = static_cast<std::uint32_t>(samples);
    settings.seed = seed;
    return RenderSession(*world, settings);
  }
};

float luminance_at(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return luminance(Rgb(p[0], p[1], p[2]));
}

double mean_luminance(const Image& image) {
  double sum = 0;  // double: of many pixels
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += static_cast<double>(luminance_at(image, x, y));
  return sum / static_cast<double>(image.pixel_count());
}

/// Luminance of blocks of 8 x 8 pixels: what an eye takes for a splotch, not for noise.
std::vector<double> blocks(const Image& image) {
  constexpr int kBlock = 8;
  std::vector<double> means;
  for (int y = 0; y + kBlock <= image.height; y += kBlock)
    for (int x = 0; x + kBlock <= image.width; x += kBlock) {
      double sum = 0;
      for (int j = 0; j < kBlock; ++j)
        for (int i = 0; i < kBlock; ++i)
          sum += static_cast<double>(luminance_at(image, x + i, y + j));
      means.push_back(sum / (kBlock * kBlock));
    }
  return means;
}

struct Error {
  double flip = 0;    ///< mean over the picture
  double blocks = 0;  ///< of block means: root of the mean squared relative difference
};

/// A converged picture and the exposure it is looked at with.
class Reference {
 public:
  /// Two pictures of `samples` each, from the temporary folder when they are there.
  Reference(const std::string& key, const Scene& scene, int samples) {
    const Image halves[] = {picture(key, scene, samples, 1000), picture(key, scene, samples, 1001)};
    linear_ = halves[0];
    for (std::size_t i = 0; i < linear_.pixels.size(); ++i)
      linear_.pixels[i] = (halves[0].pixels[i] + halves[1].pixels[i]) / 2;
    double logs = 0;
    for (int y = 0; y < linear_.height; ++y)
      for (int x = 0; x < linear_.width; ++x)
        logs += std::log(std::max(1e-6, static_cast<double>(luminance_at(linear_, x, y))));
    // The geometric mean becomes middle grey.
    exposure_ = .18 / std::exp(logs / static_cast<double>(linear_.pixel_count()));
    shown_ = shown(linear_);
    blocks_ = blocks(linear_);
    const Error between = error(halves[0]);
    fmt::print(
        "  converged: 2 x {} paths; one half off the mean of both: FLIP {:.4f}, blocks {:.4f}\n",
        samples, between.flip, between.blocks);
    std::fflush(stdout);
  }

  Error error(const Image& linear) const {
    double sum = 0;
    const std::vector<double> b = blocks(linear);
    for (std::size_t i = 0; i < b.size(); ++i) {
      const double d = (b[i] - blocks_[i]) / blocks_[i];
      sum += d * d;
    }
    return {mean_value(flip_error(shown(linear), shown_)),
            std::sqrt(sum / static_cast<double>(b.size()))};
  }
  double brightness(const Image& linear) const {
    return mean_luminance(linear) / mean_luminance(linear_);
  }

 private:
  static Image picture(const std::string& key, const Scene& scene, int samples,
                       std::uint32_t seed) {
    const std::string path = (std::filesystem::temp_directory_path() /
                              fmt::format("oriel_gather_bench_{:016x}_{}_{}.exr",
                                          std::hash<std::string>{}(key), samples, seed))
                                 .string();
    if (std::filesystem::exists(path)) return read_image(path);
    const Image image = scene.render(IndirectMethod::Path, samples, seed);
    write_image(path, image, {.format = SampleFormat::Float});
    return image;
  }
  Image shown(Image image) const {
    for (float& v : image.pixels) v = srgb_encode(clamp01(v * static_cast<float>(exposure_)));
    return image;
  }

  Image linear_, shown_;
  std::vector<double> blocks_;
  double exposure_ = 1;
};

struct CurvePoint {
  double samples;
  Error error;
};

/// Errors of a picture of paths as it grows, until it is as good as `goal` or has `most` samples.
std::vector<CurvePoint> curve_of_paths(const Scene& scene, const Reference& reference,
                                       const Error& goal, int most) {
  scene.world->options.indirect = IndirectMethod::Path;
  RenderSession session = scene.begin(most, 7);
  std::vector<CurvePoint> curve;
  std::atomic<bool> cancel{false};
  Progressive::Callbacks callbacks;
  callbacks.pass = [&](const Progress& progress) {
    if (progress.mean_samples < 4 || cancel) return;
    curve.push_back({progress.mean_samples, reference.error(linear_image(session))});
    if (curve.back().error.flip <= goal.flip) cancel = true;
  };
  session.run(callbacks, &cancel);
  return curve;
}

struct Reached {
  double samples;
  const char* how;
};

/// Where the curve comes down to `goal`, straight between points on log-log paper.
Reached samples_for(const std::vector<CurvePoint>& curve, double Error::*what, double goal) {
  const auto line = [&](const CurvePoint& a, const CurvePoint& b) {
    const double slope =
        std::log(b.error.*what / (a.error.*what)) / std::log(b.samples / a.samples);
    return slope < 0 ? b.samples * std::pow(goal / (b.error.*what), 1 / slope) : HUGE_VAL;
  };
  if (curve.front().error.*what <= goal) return {curve.front().samples, "at most "};
  for (std::size_t i = 1; i < curve.size(); ++i)
    if (curve[i].error.*what <= goal) return {line(curve[i - 1], curve[i]), ""};
  const CurvePoint& last = curve.back();
  const auto half = std::find_if(curve.begin(), curve.end(), [&](const CurvePoint& p) {
    return p.samples * 2 >= last.samples;
  });
  const double there = half->samples < last.samples ? line(*half, last) : HUGE_VAL;
  if (there > kFurthest * last.samples) return {kFurthest * last.samples, "more than "};
  return {there, "extrapolated "};
}

void compare(const char* name, const Scene& scene, const Reference& reference, int most,
             int rounds) {
  fmt::print("  {}\n", name);
  const Image gathered = scene.render(IndirectMethod::FinalGather, kSamples, 1);
  const Error goal = reference.error(gathered);
  fmt::print("    final gathering, {} samples   FLIP {:.4f}   blocks {:.4f}   mean {:.3f}\n",
             kSamples, goal.flip, goal.blocks, reference.brightness(gathered));
  std::fflush(stdout);
  const std::vector<CurvePoint> curve = curve_of_paths(scene, reference, goal, most);
  for (const CurvePoint& p : curve)
    fmt::print("    {:5.0f} paths                   FLIP {:.4f}   blocks {:.4f}\n", p.samples,
               p.error.flip, p.error.blocks);
  std::fflush(stdout);

  std::vector<double> gather_seconds, path_seconds, ratios;
  const ThreadLimit limit(1);
  for (int round = 0; round < rounds; ++round) {
    const auto cost = [&](IndirectMethod method) {
      const auto seed = static_cast<std::uint32_t>(round + 1);
      return bench::timed([&] { scene.render(method, kSamples, seed); }).cpu;
    };
    gather_seconds.push_back(cost(IndirectMethod::FinalGather));
    path_seconds.push_back(cost(IndirectMethod::Path) / kSamples);
    ratios.push_back(path_seconds.back() / gather_seconds.back());
  }
  const Reached by_flip = samples_for(curve, &Error::flip, goal.flip),
                by_blocks = samples_for(curve, &Error::blocks, goal.blocks);
  const double ratio = bench::median(ratios);
  const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
  fmt::print("    final gathering takes {:.2f} s, a path for each pixel {:.4f} s\n",
             bench::median(gather_seconds), bench::median(path_seconds));
  fmt::print("    as good by FLIP: {}{:.0f} paths, {:.1f} times as long ({:.1f} to {:.1f})\n",
             by_flip.how, by_flip.samples, by_flip.samples * ratio, by_flip.samples * *low,
             by_flip.samples * *high);
  fmt::print("    as good by blocks: {}{:.0f} paths, {:.1f} times as long\n", by_blocks.how,
             by_blocks.samples, by_blocks.samples * ratio);
  std::fflush(stdout);
}

void compare_rooms() {
  fmt::print("sky-lit room, 320 x 240\n");
  const std::string text = bench::sky_lit_room(true);
  const Scene with(text), without(bench::sky_lit_room(false));
  // The portal brings the same light with less noise.
  const Reference reference(text, with, 512);
  compare("with a portal", with, reference, 256, 3);
  compare("without", without, reference, 256, 3);
}

void compare_interior() {
  fmt::print("interior, 480 x 320\n");
  const std::string path = ORIEL_SOURCE_DIR "/scenes/interior/interior.mi";
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  const Scene scene(text.str(), 480, 320, path);
  const Reference reference(text.str(), scene, 192);
  compare("sun and sky", scene, reference, 96, 1);
}

/// Time of the second scene by that of the first, in turns.
void compare_cost(const char* name, const std::string& plain, const std::string& other,
                  IndirectMethod method) {
  constexpr int kRounds = 3;
  const ThreadLimit limit(1);
  // The plain one runs twice: the ratio of its times differs from 1 by noise alone.
  const Scene scenes[] = {Scene(plain, 160, 120), Scene(plain, 160, 120), Scene(other, 160, 120)};
  std::vector<double> ratios[3];
  for (int round = 0; round < kRounds; ++round) {
    double first = 0;
    for (int i = 0; i < 3; ++i) {
      const double t = bench::timed([&] { scenes[i].render(method, kSamples, 1); }).cpu;
      if (i == 0) first = t;
      ratios[i].push_back(t / first);
    }
  }
  const auto [low, high] = std::minmax_element(ratios[2].begin(), ratios[2].end());
  fmt::print("  {}: {:.3f} ({:.3f} to {:.3f}); the plain one against itself {:.3f}\n", name,
             bench::median(ratios[2]), *low, *high, bench::median(ratios[1]));
  std::fflush(stdout);
}

void compare_emulated() {
  fmt::print("soft reflections of gathered light, sky-lit room, 160 x 120\n");
  const std::string emulated = "\"reflectivity\" .5, \"refl_gloss\" .4, \"refl_hl_only\" on";
  for (const bool portal : {true, false})
    compare_cost(portal ? "with a portal, refl_hl_only everywhere by diffuse"
                        : "without, so without highlights",
                 bench::sky_lit_room(portal), bench::sky_lit_room(portal, emulated, emulated),
                 IndirectMethod::FinalGather);
}

void compare_interpolated() {
  fmt::print("floor that interpolates without samples, sky-lit room with a portal, 160 x 120\n");
  const std::string mirror = "\"reflectivity\" .5, \"brdf_0_degree_refl\" 1",
                    trick = mirror + ", \"refl_gloss_samples\" 0, \"refl_interpolate\" on";
  for (const auto method : {IndirectMethod::Path, IndirectMethod::FinalGather})
    compare_cost(
        method == IndirectMethod::Path ? "paths, by a mirror" : "final gathering, by a mirror",
        bench::sky_lit_room(true, mirror), bench::sky_lit_room(true, trick), method);
}

}  // namespace

int main(int argc, char** argv) {
  const auto wanted = [&](std::string_view name) {
    return argc < 2 || std::find(argv + 1, argv + argc, name) != argv + argc;
  };
  if (wanted("room")) compare_rooms();
  if (wanted("interior")) compare_interior();
  if (wanted("emulated")) compare_emulated();
  if (wanted("interpolated")) compare_interpolated();
  return EXIT_SUCCESS;
}
