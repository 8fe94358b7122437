// SPDX-License-Identifier: Apache-2.0
// A room by a thousand lamps against the same room by one lamp of their flux in their place: how
// much longer until the error is the same?
#include <fmt/format.h>

#include <string>
#include <vector>

#include "path_picture.h"
#include "prepare/testing/prepared_scene.h"
#include "timing.h"

namespace {

using namespace oriel;

constexpr int kWidth = 60, kHeight = 45, kSamples = 16, kRounds = 5, kReferenceSamples = 2048;
/// Colour of all lamps together.
constexpr float kColor = 40;
/// Half the side of the square under the ceiling that they hang in.
constexpr float kSpread = 1.2f;

std::string box(const char* name, const Vec3& lo, const Vec3& hi) {
  std::string text = fmt::format("object \"{}\" visible on shadow on trace on\n group\n", name);
  for (int i = 0; i < 8; ++i)
    text +=
        fmt::format("{} {} {}\n", i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
  return text + fmt::format(
                    "v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7\n"
                    "c 0 2 3 1 c 4 5 7 6 c 0 1 5 4 c 2 6 7 3 c 0 4 6 2 c 1 3 7 5\n"
                    " end group\nend object\n"
                    "instance \"{0}_i\" \"{0}\" material \"wall\" end instance\n",
                    name);
}

/// n x n square lamps that fill the same square.
std::string room(int n) {
  std::string text =
      "options \"opt\" object space trace on trace depth 4 4 8 \"indirect\" \"path\" end options\n"
      "material \"wall\" \"mia_material_x\" ( \"diffuse\" .6 .6 .6, \"reflectivity\" 0 ) end "
      "material\n";
  text += box("room", Vec3(-2, -2, 0), Vec3(2, 2, 3)) +
          box("table", Vec3(-.8f, -.5f, .7f), Vec3(.8f, .5f, .75f)) +
          box("shelf", Vec3(-2, -1, 0), Vec3(-1.5f, 1, 1.8f));
  std::string members = "\"room_i\" \"table_i\" \"shelf_i\"";
  const float cell = 2 * kSpread / static_cast<float>(n);
  const float color = kColor / static_cast<float>(n * n);
  for (int k = 0; k < n * n; ++k) {
    const float x = -kSpread + cell * (static_cast<float>(k % n) + .5f);
    const float y = -kSpread + cell * (static_cast<float>(k / n) + .5f);
    members += fmt::format(" \"lamp{}_i\"", k);
    text += fmt::format(
        "light \"lamp{0}\" \"physical_light\" ( \"color\" {1} {1} {1} ) origin {2} {3} 2.9 "
        "direction 0 0 -1 rectangle {4} 0 0 0 {4} 0 end light\n"
        "instance \"lamp{0}_i\" \"lamp{0}\" end instance\n",
        k, color, x, y, cell);
  }
  return text +
         fmt::format(
             "camera \"cam\" focal 1 aperture 1.6 aspect 1.3333 resolution {} {} end camera\n"
             "instance \"cam_i\" \"cam\" transform 0 0 1 0  1 0 0 0  0 1 0 0  0 -1.5 -1.9 1 "
             "end instance\n"
             "instgroup \"world\" \"cam_i\" {} end instgroup\n"
             "render \"world\" \"cam_i\" \"opt\"\n",
             kWidth, kHeight, members);
}

}  // namespace

int main() {
  double first = 0;
  for (const int n : {1, 4, 32}) {
    const oriel::testing::PreparedScene scene(room(n));
    if (!scene.world) {
      fmt::print(stderr, "{}", scene.messages());
      return 1;
    }
    const bench::Picture exact = bench::path_picture(*scene.world, kReferenceSamples, 1);
    const ThreadLimit limit(1);
    std::vector<double> seconds, errors;
    for (int round = 0; round < kRounds; ++round) {
      bench::Picture picture;
      const auto seed = static_cast<std::uint32_t>(100 + round);
      seconds.push_back(
          bench::timed([&] { picture = bench::path_picture(*scene.world, kSamples, seed); }).cpu);
      errors.push_back(bench::relative_error(picture, exact));
    }
    const double cost = bench::median(seconds) * bench::median(errors);
    if (n == 1) first = cost;
    fmt::print(
        "{:5} lamps: mean {:.4f}, relative MSE {:.5f}, {:.3f} s, time to equal error {:.2f} x\n",
        n * n, bench::mean_luminance(exact), bench::median(errors), bench::median(seconds),
        cost / first);
    std::fflush(stdout);
  }
  return 0;
}
