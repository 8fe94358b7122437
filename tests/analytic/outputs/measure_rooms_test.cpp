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

/// Mean lux over the picture.
double mean_lux(SceneText scene, const std::string& method) {
  scene.method(method);
  RenderedScene rendered(scene.str(), {.budget = {.samples = 128}, .irradiance = true}, registry());
  double sum = 0;
  std::size_t count = 0;
  for (const Layer& layer : film_layers(rendered.session(), LayerSet("illuminance")))
    if (layer.name == "illuminance")
      for (const float v : layer.image.pixels) sum += v, ++count;
  return sum / static_cast<double>(count);
}

TEST(MeasureRooms, TheLayerIsTheSameByPathsAndByGathering) {
  SceneText floor = room(kSky, .5f);
  add_window(floor);
  floor.camera("focal 1 aperture 1 aspect 1.5 resolution 24 16",
               "0 0 -1 0  -1 0 0 0  0 1 0 0  0 -1.5 -.1 1");
  const double path = mean_lux(floor, "path"), gathered = mean_lux(floor, "fg");
  ASSERT_GT(path, 0);
  EXPECT_NEAR(gathered, path, .02 * path);
}

// Caustic photons do not lie on surfaces without a diffuse lobe.
TEST(MeasureRooms, TheLayerHasTheLightOfMirrorsOnBlackSurfaces) {
  SceneText scene("trace depth 8 8 12 photon trace depth 8 8 12 shadow segments caustic on");
  scene.material("black", "\"diffuse_weight\" 0, \"reflectivity\" 0")
      .material("mirror",
                "\"diffuse_weight\" 0, \"reflectivity\" 1, \"refl_color\" 1 1 1, "
                "\"brdf_0_degree_refl\" 1")
      .plate("black")
      .square("mirror", Vec3(0, 0, 2), 3, -kUp)
      .light("lamp",
             "\"physical_light\" ( \"color\" 9 9 9 ) origin 0 0 1 direction 0 0 1 rectangle "
             "2 0 0 0 2 0 3 3",
             "visible on")
      .camera("focal 1 aperture .1 aspect 1 resolution 24 24",
              "1 0 0 0  0 1 0 0  0 0 1 0  0 0 -.5 1");
  const double path = mean_lux(scene, "path");
  ASSERT_GT(path, 0);
  for (const char* method : {"fg", "photons", "fg+photons"})
    EXPECT_NEAR(mean_lux(scene, method), path, .02 * path) << method;
}

}  // namespace measure_rooms_test
}  // namespace oriel::testing
