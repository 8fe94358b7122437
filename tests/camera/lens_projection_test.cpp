// SPDX-License-Identifier: Apache-2.0
// Lens projections of known points, measured with an environment that shows directions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "prepare/testing/prepared_scene.h"
#include "render/session.h"

namespace oriel {
namespace lens_projection_test {

using testing::PreparedScene;

/// "test_direction": the direction that a ray looks in, as a colour around .5.
const ShaderSpec kDirection = {
    .name = "test_direction",
    .library = "test",
    .apply = kApplyEnvironment,
    .value =
        [](const Call& call, void* result) {
          const Vec3 c = call.point.ray_direction * 0.5f + Vec3(0.5f);
          *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, 1);
        },
};

const Registry& registry() {
  static const Registry all([] {
    std::vector<const ShaderSpec*> specs = builtin_shaders().all();
    specs.push_back(&kDirection);
    return specs;
  }());
  return all;
}

/// A camera at (5, 6, 7), tilted up by the angle whose sine is .6, with that lens.
struct Seen {
  PreparedScene scene;
  std::unique_ptr<RenderSession> session;
  Seen(int width, int height, const std::string& lens, bool tilted = false,
       std::optional<Window> crop = {})
      : scene(fmt::format("options \"opt\" object space filter box 1 1 end options\n"
                          "$include \"oriel.mi\"\n"
                          "declare shader color \"test_direction\" ( ) version 1 end declare\n"
                          "camera \"cam\" focal 1 aperture 1 aspect {} resolution {} {} "
                          "environment \"test_direction\" ( ) lens {} end camera\n"
                          "instance \"cam_i\" \"cam\" transform {} end instance\n"
                          "instgroup \"root\" \"cam_i\" end instgroup "
                          "render \"root\" \"cam_i\" \"opt\"\n",
                          static_cast<double>(width) / height, width, height, lens,
                          tilted ? "1 0 0 0  0 .8 -.6 0  0 .6 .8 0  0 0 0 1"
                                 : "1 0 0 0  0 1 0 0  0 0 1 0  -5 -6 -7 1"),
              registry()) {
    EXPECT_EQ(scene.messages(), "");
    SessionSettings settings;
    settings.budget.samples = 16;
    settings.crop = crop;
    session = std::make_unique<RenderSession>(*scene.world, settings);
    session->run();
  }
  /// Pixels of the window, from its top left.
  Rgba pixel(int x, int y) const { return session->film().pixel(x, y).beauty; }
  Vec3 direction(int x, int y) const {
    const Rgba c = pixel(x, y);
    return normalize(Vec3(c.r, c.g, c.b) * 2 - Vec3(1));
  }
  /// The pixel that looks nearest to that direction, from the lower left, and by how much it errs.
  struct Found {
    Vec2 place;
    float angle;
  };
  Found find(const Vec3& direction_wanted) const {
    Found best{Vec2(0), 10};
    const int height = session->film().height();
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < session->film().width(); ++x) {
        const float angle =
            std::acos(clamp(dot(direction(x, y), normalize(direction_wanted)), -1, 1));
        if (angle < best.angle)
          best = {Vec2(static_cast<float>(x) + .5f, static_cast<float>(height - y) - .5f), angle};
      }
    return best;
  }
};

void expect_at(const Seen& seen, const Vec3& direction, const Vec2& pixel, const char* what) {
  const Vec2 found = seen.find(direction).place;
  EXPECT_LE(std::abs(found.x - pixel.x), .75f) << what << ": " << found.x << " for " << pixel.x;
  EXPECT_LE(std::abs(found.y - pixel.y), .75f) << what << ": " << found.y << " for " << pixel.y;
}

TEST(LensProjections, APanoramaShowsKnownPointsAtTheirAngles) {
  const Seen all(72, 36, "\"oriel_lens_panorama\" ( )");
  expect_at(all, Vec3(0, 0, -1), Vec2(36, 18), "ahead");
  expect_at(all, Vec3(1, 0, 0), Vec2(54, 18), "right: a quarter of 72 pixels further");
  expect_at(all, Vec3(-1, 0, -1), Vec2(27, 18), "half left");
  expect_at(all, Vec3(0, 1, -1), Vec2(36, 27), "45 degrees up");
  const Seen wall(60, 30, "\"oriel_lens_panorama\" ( \"projection\" 1, \"horizontal\" 180 )");
  // A half turn over 60 pixels: one pixel is pi / 60 of the wall, up as well.
  expect_at(wall, Vec3(1, 0, -1), Vec2(45, 15), "half right");
  expect_at(wall, Vec3(0, .5f, -1), Vec2(30, 15 + .5f * 60 / kPi), "half a radius up");
}

TEST(LensProjections, AFisheyeShowsKnownPointsByItsLawAndNothingOutside) {
  const Seen round(60, 40, "\"oriel_lens_fisheye\" ( )");
  // 90 degrees lie at the rim, 20 pixels from the middle.
  expect_at(round, Vec3(1, 0, -1), Vec2(40, 20), "45 degrees, equidistant: half way");
  expect_at(round, Vec3(0, std::sqrt(3.0f), -1), Vec2(30, 20 + 20 * 2 / 3.0f), "60 degrees up");
  EXPECT_EQ(round.pixel(1, 1), Rgba(0, 0, 0, 0));
  const Seen solid(40, 40, "\"oriel_lens_fisheye\" ( \"mapping\" 1 )");
  expect_at(solid, Vec3(1, 0, -1), Vec2(20 + 20 * std::sin(kPi / 8) / std::sin(kPi / 4), 20),
            "equisolid");
  const Seen full(40, 40, "\"oriel_lens_fisheye\" ( \"full_frame\" on )");
  EXPECT_NEAR(full.direction(0, 0).z, 0, .05f) << "corners lie at the rim";
}

TEST(LensProjections, ACubeShowsSixFaces) {
  const Seen faces(96, 16, "\"oriel_lens_cube\" ( \"layout\" 1 )");
  const Vec3 axes[] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
  for (int face = 0; face < 6; ++face)
    EXPECT_GT(dot(faces.direction(16 * face + 8, 8), axes[face]), .99f) << face;
  // 45 degrees aside lies on the edge of the face ahead; half of it at tan = .5.
  expect_at(faces, Vec3(.5f, 0, -1), Vec2(4 * 16 + 12, 8), "on the face ahead");
}

TEST(LensProjections, AShiftMovesTheFilm) {
  const Seen seen(40, 20, "\"oriel_lens_shift\" ( \"horizontal\" .25, \"vertical\" -.5 )");
  // The picture is 1 x .5 at distance 1: 40 pixels a unit, and the view moves right and down.
  expect_at(seen, Vec3(0, 0, -1), Vec2(20 - 10, 10 + 10), "ahead");
  expect_at(seen, Vec3(.5f, -.25f, -1), Vec2(40 - 10, 10 - 10 + 10), "a point of the plane");
}

TEST(LensProjections, TwoPointPerspectiveKeepsVerticalLinesParallel) {
  const Seen positive(40, 40, "\"oriel_lens_shift\" ( )", true);
  const Seen upright(40, 40, "\"oriel_lens_shift\" ( \"keep_verticals\" on )", true);
  const Vec3 ahead(0, .6f, -.8f);
  expect_at(positive, ahead, Vec2(20, 20), "the middle");
  expect_at(upright, ahead, Vec2(20, 20), "stays the middle");
  // A vertical edge at x = .3 of a wall at z = -1: tan 36.87 = .75 is the middle's height.
  for (const float height : {.4f, .75f, 1.1f}) {
    expect_at(upright, Vec3(.3f, height, -1), Vec2(20 + .3f * 40, 20 + (height - .75f) * 40),
              "one column");
  }
  const auto column = [&](const Seen& s, float height) {
    return s.find(Vec3(.3f, height, -1)).place.x;
  };
  EXPECT_GT(std::abs(column(positive, .4f) - column(positive, 1.1f)), 1) << "else they converge";
}

TEST(LensProjections, CropsAreTheSamePixels) {
  for (const char* lens :
       {"\"oriel_lens_panorama\" ( )", "\"oriel_lens_fisheye\" ( )", "\"oriel_lens_cube\" ( )",
        "\"oriel_lens_shift\" ( \"keep_verticals\" on )"}) {
    const Seen whole(24, 18, lens), part(24, 18, lens, false, Window{5, 4, 15, 12});
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 10; ++x)
        EXPECT_EQ(part.pixel(x, y), whole.pixel(5 + x, 18 - 12 + y)) << lens << x << "," << y;
  }
}

}  // namespace lens_projection_test
}  // namespace oriel
