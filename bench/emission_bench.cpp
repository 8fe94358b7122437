// SPDX-License-Identifier: Apache-2.0
// A room that a small glowing mesh lights: error by samples of the mesh and by rays alone, for the
// same time; and how long a million glowing triangles take to prepare.
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "lights/emission.h"
#include "path_picture.h"
#include "prepare/testing/prepared_scene.h"
#include "timing.h"

namespace {

using namespace oriel;

constexpr int kWidth = 60, kHeight = 45, kSamples = 16, kRounds = 5, kReferenceSamples = 1024;

std::string object(const std::string& name, const std::string& material,
                   const std::vector<Vec3>& points, const std::vector<std::vector<int>>& faces) {
  std::string text = fmt::format("object \"{}\" visible on shadow on trace on\n group\n", name);
  for (const Vec3& p : points) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  for (std::size_t i = 0; i < points.size(); ++i) text += fmt::format("v {}\n", i);
  for (const auto& f : faces) text += fmt::format("c {}\n", fmt::join(f, " "));
  return text + fmt::format(
                    " end group\nend object\n"
                    "instance \"{0}_i\" \"{0}\" material \"{1}\" end instance\n",
                    name, material);
}

std::string box(const std::string& name, const Vec3& lo, const Vec3& hi) {
  std::vector<Vec3> p;
  p.reserve(8);
  for (int i = 0; i < 8; ++i)
    p.emplace_back(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
  return object(
      name, "wall", p,
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}});
}

/// A sphere of n rings of 2 n quads.
std::string bulb(const std::string& name, const Vec3& centre, float radius, int n) {
  std::vector<Vec3> p;
  std::vector<std::vector<int>> faces;
  const int m = 2 * n;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j < m; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(n);
      const float phi = kTwoPi * static_cast<float>(j) / static_cast<float>(m);
      p.push_back(centre + Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                std::cos(theta)) *
                               radius);
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const int a = i * m + j, b = i * m + (j + 1) % m, c = a + m, d = b + m;
      if (i == 0)
        faces.push_back({a, c, d});
      else if (i == n - 1)
        faces.push_back({a, c, b});
      else
        faces.push_back({a, c, d, b});
    }
  return object(name, "glow", p, faces);
}

std::string scene_text(const std::string& lamp) {
  return fmt::format(
             "options \"opt\" object space trace on trace depth 4 4 8 \"indirect\" \"path\" end "
             "options\n"
             "material \"wall\" \"mia_material_x\" ( \"diffuse\" .6 .6 .6, \"reflectivity\" 0 ) "
             "end "
             "material\n"
             "material \"glow\" \"mia_material_x\" ( \"diffuse_weight\" 0, \"reflectivity\" 0, "
             "\"additional_color\" 200 180 150 ) end material\n") +
         box("room", Vec3(-2, -2, 0), Vec3(2, 2, 3)) +
         box("table", Vec3(-.8f, -.5f, .7f), Vec3(.8f, .5f, .75f)) +
         box("shelf", Vec3(-2, -1, 0), Vec3(-1.5f, 1, 1.8f)) + lamp +
         fmt::format(
             "camera \"cam\" focal 1 aperture 1.6 aspect 1.3333 resolution {} {} end camera\n"
             "instance \"cam_i\" \"cam\" transform 0 0 1 0  1 0 0 0  0 1 0 0  0 -1.5 -1.9 1 "
             "end instance\n"
             "instgroup \"world\" \"cam_i\" \"room_i\" \"table_i\" \"shelf_i\" \"lamp_i\" end "
             "instgroup\n"
             "render \"world\" \"cam_i\" \"opt\"\n",
             kWidth, kHeight);
}

struct Cost {
  double error, seconds;
  double product() const { return error * seconds; }
};

Cost cost_of(const World& world, const bench::Picture& exact, bool sampled) {
  const ThreadLimit limit(1);
  std::vector<double> seconds, errors;
  for (int round = 0; round < kRounds; ++round) {
    bench::Picture picture;
    const auto seed = static_cast<std::uint32_t>(100 + round);
    seconds.push_back(bench::timed([&] {
                        picture =
                            bench::path_picture(world, kSamples, seed, {.mesh_lights = sampled});
                      }).cpu);
    errors.push_back(bench::relative_error(picture, exact));
  }
  return {bench::median(errors), bench::median(seconds)};
}

}  // namespace

int main() {
  const std::vector<std::pair<std::string, std::string>> lamps = {
      {"square of 2 triangles", object("lamp", "glow",
                                       {Vec3(-.15f, -.15f, 2.9f), Vec3(-.15f, .15f, 2.9f),
                                        Vec3(.15f, .15f, 2.9f), Vec3(.15f, -.15f, 2.9f)},
                                       {{0, 1, 2, 3}})},
      {"bulb of 3968 triangles", bulb("lamp", Vec3(0, 0, 2.5f), .06f, 32)},
  };
  for (const auto& [name, lamp] : lamps) {
    const oriel::testing::PreparedScene scene(scene_text(lamp));
    if (!scene.world) {
      fmt::print(stderr, "{}", scene.messages());
      return 1;
    }
    const bench::Picture exact = bench::path_picture(*scene.world, kReferenceSamples, 1);
    const Cost rays = cost_of(*scene.world, exact, false);
    const Cost sampled = cost_of(*scene.world, exact, true);
    fmt::print(
        "{}: mean {:.4f}; rays alone: relative MSE {:.4f}, {:.3f} s; sampled: {:.5f}, {:.3f} s; "
        "error at equal time {:.1f} x less\n",
        name, bench::mean_luminance(exact), rays.error, rays.seconds, sampled.error,
        sampled.seconds, rays.product() / sampled.product());
    std::fflush(stdout);
  }
  const oriel::testing::PreparedScene many(scene_text(bulb("lamp", Vec3(0, 0, 2.5f), .06f, 512)));
  std::vector<EmissionKind> emissive;
  MeshLights lights;
  const bench::Seconds asked = bench::timed([&] { emissive = emissive_materials(*many.world); });
  const bench::Seconds built =
      bench::timed([&] { lights = mesh_lights_of(*many.world, emissive); });
  fmt::print("{} emissive triangles in {} clusters: {:.3f} s, of all processors {:.3f} s\n",
             lights.size(), lights.clusters(), asked.wall + built.wall, asked.cpu + built.cpu);
  return 0;
}
