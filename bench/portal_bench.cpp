// SPDX-License-Identifier: Apache-2.0
// What do portals spare where the sky comes through a window, or a picture that is named?
//
// A room is path traced without a portal, with one, and with the window in sixteen. Errors are
// relative squares against a converged picture, over all pixels; as they fall with the number of
// paths, error times processor time tells the error at equal time whatever the number.
#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "path_picture.h"
#include "prepare/testing/prepared_scene.h"
#include "shaders/registry.h"
#include "timing.h"

namespace {

using namespace oriel;

constexpr int kWidth = 60, kHeight = 45;
/// Opening in the wall at x = 0: y, then z.
constexpr float kOpening[] = {-.6f, .8f, .9f, 2.1f};

std::string quad(int i, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::string text = fmt::format("object \"q{}\" visible on shadow on trace on\n group\n", i);
  for (const Vec3& p : {a, b, c, d}) text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
  return text + fmt::format(
                    "v 0 v 1 v 2 v 3 c 0 1 2 3\n end group\nend object\n"
                    "instance \"q{0}_i\" \"q{0}\" material \"wall\" end instance\n",
                    i);
}

/// What is outside: statements before, and the camera's environment.
struct Surroundings {
  std::string statements, environment;
};

/// n x n portals, none for 0; the camera looks from the window wall into the room.
std::string room(const Surroundings& around, int n) {
  const auto [y0, y1, z0, z1] = kOpening;
  const float x = 4, y = 1.5f, z = 3;
  const Vec3 walls[][4] = {
      {Vec3(0, -y, 0), Vec3(x, -y, 0), Vec3(x, y, 0), Vec3(0, y, 0)},
      {Vec3(0, -y, z), Vec3(0, y, z), Vec3(x, y, z), Vec3(x, -y, z)},
      {Vec3(x, -y, 0), Vec3(x, -y, z), Vec3(x, y, z), Vec3(x, y, 0)},
      {Vec3(0, -y, 0), Vec3(0, -y, z), Vec3(x, -y, z), Vec3(x, -y, 0)},
      {Vec3(0, y, 0), Vec3(x, y, 0), Vec3(x, y, z), Vec3(0, y, z)},
      {Vec3(0, -y, 0), Vec3(0, y, 0), Vec3(0, y, z0), Vec3(0, -y, z0)},
      {Vec3(0, -y, z1), Vec3(0, y, z1), Vec3(0, y, z), Vec3(0, -y, z)},
      {Vec3(0, -y, z0), Vec3(0, y0, z0), Vec3(0, y0, z1), Vec3(0, -y, z1)},
      {Vec3(0, y1, z0), Vec3(0, y, z0), Vec3(0, y, z1), Vec3(0, y1, z1)},
      // Two shelves.
      {Vec3(2, .5f, .8f), Vec3(3, .5f, .8f), Vec3(3, 1.5f, .8f), Vec3(2, 1.5f, .8f)},
      {Vec3(3, -1.5f, 1.6f), Vec3(4, -1.5f, 1.6f), Vec3(4, 0, 1.6f), Vec3(3, 0, 1.6f)}};
  std::string text =
      "options \"opt\" object space trace on trace depth 4 4 8 \"indirect\" \"path\" end options\n"
      "material \"wall\" \"mia_material_x\" ( \"diffuse\" .6 .6 .6, \"reflectivity\" 0 ) end "
      "material\n" +
      around.statements;
  std::string members;
  int i = 0;
  for (const auto& w : walls) {
    members += fmt::format(" \"q{}_i\"", i);
    text += quad(i++, w[0], w[1], w[2], w[3]);
  }
  for (int k = 0; k < n * n; ++k) {
    const float w = (y1 - y0) / static_cast<float>(n), h = (z1 - z0) / static_cast<float>(n);
    const float cy = y0 + w * (static_cast<float>(k / n) + .5f),
                cz = z0 + h * (static_cast<float>(k % n) + .5f);
    members += fmt::format(" \"p{}_i\"", k);
    text += fmt::format(
        "light \"p{0}\" \"mia_portal_light\" ( \"cutoff_threshold\" 0 ) origin 0 0 0 "
        "rectangle {1} 0 0 0 {2} 0 3 3 end light\n"
        "instance \"p{0}_i\" \"p{0}\" visible on transform 0 0 1 0  1 0 0 0  0 1 0 0  {3} {4} 0 1 "
        "end instance\n",
        k, w, h, -cy, -cz);
  }
  return text + fmt::format(
                    "camera \"cam\" focal 1 aperture 1.6 aspect 1.3333 resolution {} {} "
                    "environment {} end camera\n"
                    "instance \"cam_i\" \"cam\" transform 0 0 -1 0  -1 0 0 0  0 1 0 0  "
                    "0 -1.5 .1 1 end instance\n"
                    "instgroup \"world\" \"cam_i\"{} end instgroup\n"
                    "render \"world\" \"cam_i\" \"opt\"\n",
                    kWidth, kHeight, around.environment, members);
}

struct Room : oriel::testing::PreparedScene {
  explicit Room(const std::string& text) : PreparedScene(text) {
    fmt::print(stderr, "{}", messages());
  }
};

void compare(const char* name, const Surroundings& around, int reference_samples) {
  constexpr int kSamples = 16, kRounds = 5;
  const Room rooms[] = {Room(room(around, 0)), Room(room(around, 1)), Room(room(around, 4))};
  const bench::Picture exact = bench::path_picture(*rooms[1].world, reference_samples, 1);
  const ThreadLimit limit(1);
  fmt::print("{}: error at equal time, {} paths a pixel\n", name, kSamples);
  double first = 0;
  const char* const kinds[] = {"no portal", "one portal", "16 portals"};
  for (int i = 0; i < 3; ++i) {
    std::vector<double> seconds, errors;
    for (int round = 0; round < kRounds; ++round) {
      bench::Picture picture;
      const auto seed = static_cast<std::uint32_t>(100 + round);
      seconds.push_back(bench::timed([&] {
                          picture = bench::path_picture(*rooms[i].world, kSamples, seed);
                        }).cpu);
      errors.push_back(bench::relative_error(picture, exact));
    }
    const double cost = bench::median(seconds), error = bench::median(errors);
    if (i == 0) first = cost * error;
    fmt::print(
        "  {:11} relative MSE {:.4f}   {:.3f} s   error times time {:.4f}   {:.1f} x lower\n",
        kinds[i], error, cost, error * cost, first / (error * cost));
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2) {
    fmt::print(stderr, "usage: portal_bench [PROBE]   (a latitude-longitude picture)\n");
    return 2;
  }
  compare("sky", {"", "\"mia_physicalsky\" ( \"sun_direction\" -.6 -.5 .5, \"haze\" 1 )"}, 1024);
  // Up in the picture is +y, so it lies on its side around the room.
  if (argc == 2)
    compare("probe",
            {fmt::format("color texture \"probe\" \"{}\"\n", argv[1]),
             "\"mib_lookup_spherical\" ( \"tex\" \"probe\" )"},
            1024);
  return EXIT_SUCCESS;
}
