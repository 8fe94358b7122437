// SPDX-License-Identifier: Apache-2.0
// Rooms without portals have as little noise as with portals.
#include "scenes.h"

namespace oriel::cross_method {
namespace openings_test {

/// Largest ratio of squared errors to those of the same room with portals: .8 of the speed.
constexpr double kLargestRatio = 1 / .8;
/// Largest difference of means in standard errors.
constexpr double kSigmas = 4;

struct Case {
  const char* name;
  SceneText (*scene)();
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

const Vec3 kDoorLow(-2, -1.5f, -4), kDoorHigh(-2, .6f, -3.2f);

/// An even sky through the window and a door opposite.
SceneText even_sky() {
  SceneText scene = start();
  room(scene, "x+ x-");
  wall_with_hole(scene, "green", 0, 2, kLow, kHigh, kWindowLow, kWindowHigh);
  wall_with_hole(scene, "red", 0, -2, kLow, kHigh, kDoorLow, kDoorHigh);
  scene.environment(
      "\"mib_color_interpolate\" ( \"num\" 1, \"color_0\" 1 1 1, \"color_1\" 1 1 1 )");
  return scene;
}

/// A window with a pane and two bars, furniture, sun and sky.
SceneText with_bars() {
  SceneText scene = furnished();
  scene.material("glass",
                 "\"reflectivity\" 1, \"transparency\" 1, \"diffuse_weight\" 0, \"refr_ior\" 1.5, "
                 "\"brdf_fresnel\" on, \"thin_walled\" on");
  scene.polygon("glass", {Vec3(1.9f, -.35f, -3.6f), Vec3(1.9f, -.35f, -1.4f),
                          Vec3(1.9f, 1.05f, -1.4f), Vec3(1.9f, 1.05f, -3.6f)});
  scene.box("grey", Vec3(1.96f, -.3f, -2.52f), Vec3(1.99f, 1, -2.48f));
  scene.box("grey", Vec3(1.96f, .34f, -3.5f), Vec3(1.99f, .36f, -1.5f));
  return scene;
}

/// A rectangle that faces the middle of the room.
void add_portal(SceneText& scene, const char* name, const Vec3& low, const Vec3& high) {
  const Vec3 middle = (low + high) * .5f, size = high - low;
  const float s = middle.x > 0 ? 1.0f : -1.0f;
  // The light's z is -x of the world at the window, +x at the door; its y is y.
  scene.light(name,
              fmt::format("\"mia_portal_light\" ( \"cutoff_threshold\" 0 ) origin 0 0 0 rectangle "
                          "{} 0 0 0 {} 0 3 3",
                          size.z, size.y),
              fmt::format("visible on transform 0 0 {0} 0  0 1 0 0  {1} 0 0 0  {2} {3} {4} 1", -s,
                          s, -s * middle.z, -middle.y, s * middle.x));
}

class RoomsWithoutPortals : public ::testing::TestWithParam<Case> {};

// acceptance: Q4
TEST_P(RoomsWithoutPortals, HaveAsLittleNoiseAsWithPortals) {
  SceneText with = GetParam().scene();
  add_portal(with, "window_portal", kWindowLow, kWindowHigh);
  if (GetParam().scene == even_sky) add_portal(with, "door_portal", kDoorLow, kDoorHigh);
  Comparison without_portals(GetParam().scene()), with_portals(with);
  constexpr std::uint32_t kSamples = 16;
  constexpr int kPictures = 8;
  const Measured found = without_portals.render(kPath, kSamples, kPictures);
  const Measured placed = with_portals.render(kPath, kSamples, kPictures);
  EXPECT_LT(found.noise_mse / placed.noise_mse, kLargestRatio);
  EXPECT_NEAR(found.picture.mean, placed.picture.mean,
              kSigmas * std::hypot(found.picture.error, placed.picture.error));
  if (figures_wanted())
    fmt::print("| {} | {:.3f} | {:.4f} |\n", GetParam().name, found.noise_mse / placed.noise_mse,
               found.picture.mean / placed.picture.mean);
}

INSTANTIATE_TEST_SUITE_P(CrossMethod, RoomsWithoutPortals,
                         ::testing::Values(Case{"sky_window", sky_window},
                                           Case{"even_sky", even_sky}, Case{"furnished", furnished},
                                           Case{"with_bars", with_bars}),
                         [](const auto& i) { return std::string(i.param.name); });

}  // namespace openings_test
}  // namespace oriel::cross_method
