// SPDX-License-Identifier: Apache-2.0
// What does one blurred look-up of the environment spare, against a hundred glossy rays?
//
// A glossy sphere in a room with windows, or under many small lamps: 100 samples of each
// reflection with the environment as it is, against 8 with mia_envblur around it and
// single_env_sample on. Errors are those against a converged picture, noise is what differs between
// two pictures of other random numbers; both root mean squares over the mean.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "color/luminance.h"
#include "prepare/testing/prepared_scene.h"
#include "shaders/registry.h"
#include "timing.h"
#include "transport/path/path.h"

namespace {

using namespace oriel;

constexpr int kSide = 96;
constexpr int kLamps = 60;
constexpr int kConverged = 4000, kTurns = 5;

/// Small lamps of very different brightness, all around.
void lamps(const Call& call, void* result) {
  const Vec3& d = call.point.ray_direction;
  float sum = .2f + .1f * d.z;
  for (int i = 0; i < kLamps; ++i) {
    const float z = 1 - 2 * (static_cast<float>(i) + .5f) / kLamps;
    const float r = std::sqrt(1 - z * z), phi = 2.399963f * static_cast<float>(i);
    const float away = dot(d, Vec3(r * std::cos(phi), r * std::sin(phi), z)) - 1;
    if (away > -.01f) sum += 4.0f * static_cast<float>(1 << (i % 6)) * std::exp(away * 1200);
  }
  *static_cast<Rgba*>(result) = Rgba(sum, sum, sum, 1);
}
constexpr ShaderSpec kLampsShader = {
    .name = "bench_lamps", .library = "bench", .apply = kApplyEnvironment, .value = lamps};

/// A grey room with three windows of different size, four to twenty times as bright.
void windows(const Call& call, void* result) {
  const Vec3& d = call.point.ray_direction;
  float sum = .3f + .1f * d.z;
  const auto window = [&](const Vec3& middle, float cosine, float level) {
    sum += level * smoothstep(cosine - .02f, cosine + .02f, dot(d, normalize(middle)));
  };
  window(Vec3(1, .5f, .3f), .9f, 2);
  window(Vec3(-1, .3f, .4f), .96f, 4);
  window(Vec3(.2f, -1, 1), .98f, 8);
  *static_cast<Rgba*>(result) = Rgba(sum, sum, sum, 1);
}
constexpr ShaderSpec kWindowsShader = {
    .name = "bench_windows", .library = "bench", .apply = kApplyEnvironment, .value = windows};

const Registry& registry() {
  static const Registry all([] {
    std::vector<const ShaderSpec*> specs = builtin_shaders().all();
    specs.push_back(&kLampsShader);
    specs.push_back(&kWindowsShader);
    return specs;
  }());
  return all;
}

std::string scene_of(const char* around, float gloss, int samples, bool blurred) {
  constexpr int kRings = 32;
  std::string points, faces;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j < 2 * kRings; ++j) {
      const float theta = kPi * static_cast<float>(i) / kRings;
      const float phi = kPi * static_cast<float>(j) / kRings;
      points += fmt::format("{} {} {}\n", std::sin(theta) * std::cos(phi),
                            std::sin(theta) * std::sin(phi), std::cos(theta));
      const int a = i * 2 * kRings + j, b = i * 2 * kRings + (j + 1) % (2 * kRings);
      if (i < kRings) faces += fmt::format("c {} {} {} {}\n", a, a + 2 * kRings, b + 2 * kRings, b);
    }
  std::string vertices;
  for (int i = 0; i < (kRings + 1) * 2 * kRings; ++i) vertices += fmt::format("v {0} n {0}\n", i);
  return fmt::format(
      "options \"opt\" object space trace on trace depth 2 2 4 end options\n"
      "shader \"around\" \"bench_{}\" ()\n"
      "material \"m\" \"mia_material_x\" ( \"diffuse_weight\" 0, \"reflectivity\" 1, "
      "\"brdf_0_degree_refl\" 1, \"refl_gloss\" {}, \"refl_gloss_samples\" {}, \"refl_depth\" 1, "
      "\"single_env_sample\" {} ) end material\n"
      "object \"ball\" visible on trace on\n group\n{}{}{} end group\nend object\n"
      "instance \"ball_i\" \"ball\" material \"m\" end instance\n"
      "camera \"cam\" focal 1 aperture .8 aspect 1 resolution {} {} environment {} end camera\n"
      "instance \"cam_i\" \"cam\" transform 1 0 0 0  0 1 0 0  0 0 1 0  0 0 -3 1 end instance\n"
      "instgroup \"world\" \"cam_i\" \"ball_i\" end instgroup\n"
      "render \"world\" \"cam_i\" \"opt\"\n",
      around, gloss, samples, blurred ? "on" : "off", points, vertices, faces, kSide, kSide,
      blurred ? "\"mia_envblur\" ( \"environment\" \"around\" )" : "= \"around\"");
}

using Picture = std::vector<Rgb>;

struct Scene : oriel::testing::PreparedScene {
  explicit Scene(const std::string& text) : PreparedScene(text, registry()) {
    fmt::print(stderr, "{}", messages());
  }
  Picture render(std::uint32_t seed) const {
    Picture picture(kSide * kSide, Rgb(0));
    PathSettings settings;
    settings.paths_of_pixel = 1;
    settings.indirect = false;
    parallel_for(kSide, [&](std::size_t line) {
      RayCounts counts;
      const int y = static_cast<int>(line);
      for (int x = 0; x < kSide; ++x) {
        sampling::Sampler sampler(x, y, 0, seed);
        // The middle of the pixel: what differs is the reflection's noise alone.
        const Vec2 raster(static_cast<float>(x) + .5f, static_cast<float>(y) + .5f);
        picture[line * kSide + static_cast<std::size_t>(x)] =
            trace_path(*world, world->camera.ray(raster), raster, settings, sampler, counts)
                .radiance;
      }
    });
    return picture;
  }
};

/// Within the ball's outline, with a margin.
bool on_ball(int pixel) {
  const int column = pixel % kSide, line = pixel / kSide;
  const float x = (static_cast<float>(column) + .5f) / kSide - .5f;
  const float y = (static_cast<float>(line) + .5f) / kSide - .5f;
  return std::hypot(x, y) < .4f;
}

/// Root mean square over the ball's inner part, of the mean of the converged picture.
double difference(const Picture& a, const Picture& b, const Picture& exact) {
  double sum = 0, n = 0, mean = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    if (!on_ball(i)) continue;
    const auto k = static_cast<std::size_t>(i);
    const auto d = static_cast<double>(luminance(a[k]) - luminance(b[k]));
    sum += d * d;
    mean += static_cast<double>(luminance(exact[k]));
    ++n;
  }
  return std::sqrt(sum / n) / (mean / n);
}

/// What the two ways cost and miss under one environment.
void compare(const char* around, float gloss) {
  const Scene converged(scene_of(around, gloss, kConverged, false)),
      many(scene_of(around, gloss, 100, false)), few(scene_of(around, gloss, 8, false)),
      blurred(scene_of(around, gloss, 8, true));
  const Picture exact = converged.render(99);
  std::vector<double> ratios, seconds[3];
  Picture pictures[3];
  const Scene* const scenes[] = {&many, &few, &blurred};
  for (int turn = 0; turn < kTurns; ++turn) {
    for (int k = 0; k < 3; ++k)
      seconds[k].push_back(bench::timed([&] {
                             for (int i = 0; i < 4; ++i) pictures[k] = scenes[k]->render(1);
                           }).cpu);
    ratios.push_back(seconds[0].back() / seconds[2].back());
  }
  std::sort(ratios.begin(), ratios.end());
  fmt::print(
      "{}, gloss {}: 100 rays over 8 with one blurred look-up: time {:.1f} ({:.1f} to {:.1f})\n",
      around, gloss, bench::median(ratios), ratios.front(), ratios.back());
  const char* const names[] = {"100 rays", "8 rays", "8 rays, one blurred look-up"};
  for (int k = 0; k < 3; ++k)
    fmt::print("  {}: error {:.4f}, noise {:.4f}, {:.3f} s\n", names[k],
               difference(pictures[k], exact, exact),
               difference(pictures[k], scenes[k]->render(2), exact) / std::sqrt(2.0),
               bench::median(seconds[k]) / 4);
}

}  // namespace

int main() {
  const ThreadLimit one(1);
  fmt::print("table of the default resolution: ");
  std::vector<double> prepare_blurred, prepare_sharp;
  for (int i = 0; i < kTurns; ++i) {
    prepare_blurred.push_back(
        bench::timed([] { Scene scene(scene_of("lamps", .5f, 8, true)); }).cpu);
    prepare_sharp.push_back(
        bench::timed([] { Scene scene(scene_of("lamps", .5f, 8, false)); }).cpu);
  }
  fmt::print("{:.2f} s\n", bench::median(prepare_blurred) - bench::median(prepare_sharp));
  for (const char* around : {"windows", "lamps"})
    for (const float gloss : {.7f, .5f, .3f}) compare(around, gloss);
}
