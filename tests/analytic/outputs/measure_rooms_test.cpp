// SPDX-License-Identifier: Apache-2.0
// Irradiance sensors in rooms with a window: portals do not change readings; methods agree.
#include "analysis/measure.h"
#include "color/luminance.h"
#include "output/output.h"
#include "render/session.h"
#include "support/picture.h"
#include "support/portal_scenes.h"

namespace oriel::testing {
namespace measure_rooms_test {

TEST(MeasureRooms, APortalChangesNoReadingBehindIt) {
  const SceneText open = room(kSky, .5f);
  SceneText closed = open, split = open;
  add_window(closed);
  add_window(split, 4, "\"cutoff_threshold\" 0");
  const std::vector<IrradianceSensor> meters = {{Vec3(1, 0, .8f), kUp},
                                                {Vec3(2.5f, .5f, .8f), kUp}};
  const auto read = [&](const SceneText& scene, double precision) {
    return measure_illuminance(probe_of(scene).world(), meters, 1, {.precision = precision});
  };
  const auto brute = read(open, .015), one = read(closed, .006), many = read(split, .006);
  for (std::size_t i = 0; i < meters.size(); ++i) {
    // Two intervals of 95 % each, at four standard errors.
    const double apart = 2.1 * std::hypot(brute[i].half_width, one[i].half_width);
    EXPECT_NEAR(one[i].value, brute[i].value, apart) << i;
    EXPECT_NEAR(many[i].value, one[i].value,
                2.1 * std::hypot(many[i].half_width, one[i].half_width))
        << i;
    EXPECT_LT(apart, .04 * brute[i].value);
  }
}

/// Mean lux over the picture of the room's floor.
double mean_lux(const std::string& method) {
  SceneText scene = room(kSky, .5f);
  add_window(scene);
  scene.method(method).camera("focal 1 aperture 1 aspect 1.5 resolution 24 16",
                              "0 0 -1 0  -1 0 0 0  0 1 0 0  0 -1.5 -.1 1");
  RenderedScene rendered(scene.str(), {.budget = {.samples = 128}, .irradiance = true}, registry());
  double sum = 0;
  std::size_t count = 0;
  for (const Layer& layer : film_layers(rendered.session(), LayerSet("illuminance")))
    if (layer.name == "illuminance")
      for (const float v : layer.image.pixels) sum += v, ++count;
  return sum / static_cast<double>(count);
}

TEST(MeasureRooms, TheLayerIsTheSameByPathsAndByGathering) {
  const double path = mean_lux("path"), gathered = mean_lux("fg");
  ASSERT_GT(path, 0);
  EXPECT_NEAR(gathered, path, .02 * path);
}

}  // namespace measure_rooms_test
}  // namespace oriel::testing
