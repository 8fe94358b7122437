// SPDX-License-Identifier: Apache-2.0
// Layers of values of the first surface.
#include "output/output.h"
#include "support/picture.h"
#include "support/probe.h"

namespace oriel::testing {
namespace surface_values_test {

TEST(SurfaceValues, ThePositionLayerIsThePointOfTheFirstSurface) {
  SceneText scene;
  scene.lambert("grey", .5f).square("grey", Vec3(0, 0, -4), 1, Vec3(0, 0, 1));
  scene.camera("focal 1 aperture 1 aspect 1 resolution 16 16");
  const RenderedScene rendered(
      scene, {.budget = {.samples = 4}, .surface_values = LayerSet("position").surface_values()});
  const auto layers = film_layers(rendered.session(), LayerSet("position"));
  const Layer* layer = find_layer(layers, "position");
  ASSERT_TRUE(layer);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      // The picture is 4 wide at that distance, the square half of it.
      const float u = (static_cast<float>(x) - 7.5f) / 4, v = (7.5f - static_cast<float>(y)) / 4;
      const float* at = layer->image.at(x, y);
      if (std::abs(u) > 1.2f || std::abs(v) > 1.2f) {
        EXPECT_EQ(Vec3(at[0], at[1], at[2]), Vec3(0)) << x << ' ' << y;
      } else if (std::abs(u) < .8f && std::abs(v) < .8f) {
        EXPECT_NEAR(at[0], u, .13f);
        EXPECT_NEAR(at[1], v, .13f);
        EXPECT_NEAR(at[2], -4, 1e-5f);
      }
    }
}

TEST(SurfaceValues, AreAbsentUnlessRequested) {
  SceneText scene;
  scene.lambert("grey", .5f).square("grey", Vec3(0, 0, -4), 1, Vec3(0, 0, 1));
  scene.camera("focal 1 aperture 1 aspect 1 resolution 4 4");
  const RenderedScene rendered(scene, {.budget = {.samples = 1}});
  EXPECT_FALSE(find_layer(film_layers(rendered.session(), LayerSet("position")), "position"));
}

}  // namespace surface_values_test
}  // namespace oriel::testing
