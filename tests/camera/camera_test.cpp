// SPDX-License-Identifier: Apache-2.0
// Camera statements: image positions of known points, and clipping planes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "prepare/testing/prepared_scene.h"
#include "render/session.h"

namespace oriel {
namespace camera_test {

using testing::PreparedScene;

/// Cards of those sides across the view at those distances, nearest first.
std::string view(const std::string& camera, const std::vector<std::pair<double, double>>& cards) {
  std::string text = "options \"opt\" object space end options camera \"cam\" " + camera +
                     " end camera instance \"cam_i\" \"cam\" end instance\n"
                     "material \"m\" \"mib_illum_lambert\" ( ) end material\n";
  std::string members = "\"cam_i\"";
  for (const auto& [distance, side] : cards) {
    const double h = side / 2;
    text += fmt::format(
        "object \"o{0}\" visible trace group {1} {1} {2} {3} {1} {2} {3} {3} {2} {1} {3} {2} "
        "v 0 v 1 v 2 v 3 p 0 1 2 3 end group end object "
        "instance \"i{0}\" \"o{0}\" material [ \"m\" ] end instance\n",
        distance, -h, -distance, h);
    members += fmt::format(" \"i{}\"", distance);
  }
  return text + "instgroup \"root\" " + members +
         " end instgroup render \"root\" \"cam_i\" \"opt\"\n";
}

struct Seen {
  PreparedScene scene;
  std::unique_ptr<RenderSession> session;
  explicit Seen(const std::string& camera,
                const std::vector<std::pair<double, double>>& cards = {{4, 1}})
      : scene(view(camera, cards)) {
    EXPECT_EQ(scene.messages(), "");
    SessionSettings settings;
    settings.budget.samples = 64;
    session = std::make_unique<RenderSession>(*scene.world, settings);
    session->run();
  }
  /// Pixels covered, and the middle of what covers them, from the lower left.
  struct Cover {
    double area = 0;
    Vec2 middle{0};
  };
  Cover cover() const {
    Cover c;
    const Window& w = session->window();
    for (int y = 0; y < w.height(); ++y)
      for (int x = 0; x < w.width(); ++x) {
        const float a = session->film().pixel(x, y).beauty.a;
        c.area += a;
        c.middle += w.pixel_centre(x, y) * a;
      }
    if (c.area > 0) c.middle = c.middle / static_cast<float>(c.area);
    return c;
  }
  float depth(int x, int y) const { return session->film().pixel(x, y).depth; }
};

TEST(CameraStatements, HalfTheApertureIsSeenAtTheFocalLength) {
  // 1 unit at 4 is .5 at focal 2: of a film of 1 half the width, 20 pixels of 40.
  const Seen::Cover c = Seen("focal 2 aperture 1 aspect 1 resolution 40 40").cover();
  EXPECT_NEAR(c.area, 400, 4);
  EXPECT_NEAR(c.middle.x, 20, .1);
  EXPECT_NEAR(c.middle.y, 20, .1);
}

TEST(CameraStatements, PixelShapeFollowsFromAspect) {
  // An aspect of 2 over 40 x 40 pixels: each covers twice as much across as up.
  const Seen::Cover c = Seen("focal 2 aperture 1 aspect 2 resolution 40 40").cover();
  EXPECT_NEAR(c.area, 20 * 40, 8);
}

TEST(CameraStatements, AnOffsetShiftsTheFilmInPixels) {
  const Seen::Cover c = Seen("focal 2 aperture 1 aspect 1 resolution 40 40 offset 3 -4").cover();
  EXPECT_NEAR(c.middle.x, 20 - 3, .1);
  EXPECT_NEAR(c.middle.y, 20 + 4, .1);
}

TEST(CameraStatements, AtInfinityTheApertureIsTheWidthInSceneUnits) {
  const std::string camera = "focal infinity aperture 4 aspect 1 resolution 40 40";
  // Independent of the distance: 1 unit of 4 is 10 of 40 pixels.
  EXPECT_NEAR(Seen(camera).cover().area, 100, 2);
  EXPECT_NEAR(Seen(camera, {{40, 1}}).cover().area, 100, 2);
}

TEST(CameraStatements, ClipPlanesLieAcrossTheView) {
  const std::string camera = "focal 1 aperture 1 aspect 1 resolution 20 20 ";
  const std::vector<std::pair<double, double>> cards = {{2, 20}, {4, 20}};
  EXPECT_NEAR(Seen(camera, cards).depth(10, 10), 2, .01);
  EXPECT_NEAR(Seen(camera + "clip 3 9", cards).depth(10, 10), 4, .02);
  EXPECT_EQ(Seen(camera + "clip .5 1.5", cards).depth(10, 10), 0);
  // Planes, not spheres: the corner of the card at 2 is 2.4 away and still before the plane at 2.1.
  const Seen corner(camera + "clip .5 2.1", cards);
  EXPECT_NEAR(corner.depth(0, 0), 2 * std::sqrt(1 + 2 * sqr(.475f)), .02);
  const Seen parallel("focal infinity aperture 1 aspect 1 resolution 8 8 clip 3 9", cards);
  EXPECT_NEAR(parallel.depth(0, 0), 4, .001);
}

TEST(CameraStatements, AWindowIsCutOutOfTheWholePicture) {
  const std::string camera = "focal 2 aperture 1 aspect 1 resolution 40 40 ";
  const Seen whole(camera), part(camera + "window 8 10 23 29");
  const Window& w = part.session->window();
  EXPECT_EQ(w, (Window{8, 10, 24, 30})) << "ends are included";
  for (int y = 0; y < w.height(); ++y)
    for (int x = 0; x < w.width(); ++x)
      EXPECT_EQ(part.session->film().pixel(x, y).beauty,
                whole.session->film().pixel(w.x0 + x, 40 - w.y1 + y).beauty);
}

}  // namespace camera_test
}  // namespace oriel
