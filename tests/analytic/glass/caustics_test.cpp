// SPDX-License-Identifier: Apache-2.0
// Transparent shadows and refractive caustics in one picture.
#include "support/picture.h"

namespace oriel::testing {
namespace caustics_test {

/// The sun shines along x, past two balls of tinted glass, on a wall at x = 1.5 that shows 1; the
/// camera sees the wall beside them. The upper ball makes refractive caustics.
class TwoBalls {
 public:
  explicit TwoBalls(const std::string& caustic) {
    const auto glass = [](const char* name, const char* refracts) {
      return std::pair(std::string(name),
                       fmt::format("\"reflectivity\" 0, \"diffuse_weight\" 0, \"transparency\" 1, "
                                   "\"refr_ior\" 1.5, \"refr_color\" .8 .8 .8, "
                                   "\"do_refractive_caustics\" {}",
                                   refracts));
    };
    SceneText s("trace depth 4 8 10 shadow segments photon trace depth 8 8 16 caustic " + caustic);
    const auto on = glass("on", "on"), off = glass("off", "off");
    s.lambert("wall", .5f)
        .material(on.first, on.second)
        .material(off.first, off.second)
        .polygon("wall",
                 {Vec3(1.5f, -2, -6), Vec3(1.5f, -2, -1), Vec3(1.5f, 2, -1), Vec3(1.5f, 2, -6)})
        .sphere("on", Vec3(.3f, .8f, -3), .5f)
        .sphere("off", Vec3(.3f, -.8f, -3), .5f)
        // Its flux through the disc around the scene, whose diagonal is that of 1.7 x 4 x 5.
        .light("sun",
               fmt::format("\"physical_light\" ( \"color\" 2 2 2 ) direction 1 0 0 energy {0} {0} "
                           "{0} caustic photons 80000",
                           2 * kPi * (1.7f * 1.7f + 4 * 4 + 5 * 5) / 4))
        .camera("focal 1 aperture 2 aspect 1 resolution 128 128");
    std::string text = s.str();
    text.replace(text.find("\"path\""), 6, "\"scene\"");
    picture_.emplace(text, 4, false);
  }
  /// What the wall shows at height y behind the balls: the mean of a few pixels.
  float at(float y) const {
    const int row = static_cast<int>(std::lround(63.5f - y / 6 * 128));
    float sum = 0;
    for (int i = -1; i <= 1; ++i) sum += picture_->layers().front().image.at(96, row + i)[0];
    return sum / 3;
  }

 private:
  std::optional<Picture> picture_;
};

// acceptance: T9
TEST(RefractiveCaustics, MixWithTransparentShadowsInOnePicture) {
  const TwoBalls with("on caustic accuracy 100 .05");
  EXPECT_NEAR(with.at(0), 1.03f, .03f) << "beside the balls; rays of the rim come this far";
  EXPECT_NEAR(with.at(-.8f), .64f, .02) << "straight through two tinted surfaces";
  EXPECT_NEAR(with.at(-1.1f), .64f, .02);
  // The focus is .45 before the wall: light of the ball's outline falls on a third of it.
  EXPECT_GT(with.at(.8f), 1.2f);
  EXPECT_LT(with.at(1.22f), .2f) << "opaque shadow around the focus";
  EXPECT_LT(with.at(.38f), .2f);
  const TwoBalls without("off");
  EXPECT_NEAR(without.at(.8f), .64f, .02) << "without photons light goes straight";
  EXPECT_NEAR(without.at(-.8f), .64f, .02);
  EXPECT_NEAR(without.at(0), 1, .01);
}

}  // namespace caustics_test
}  // namespace oriel::testing
