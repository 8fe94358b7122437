// SPDX-License-Identifier: Apache-2.0
// Illuminance layer: irradiance of the first surface, independent of its material.
#include "output/output.h"
#include "support/picture.h"
#include "support/probe.h"

namespace oriel::testing {
namespace measure_layers_test {

/// A plate facing the camera under a uniform sky of 100, with a light of 1000 cd 2 in front of it.
constexpr double kExact = 100 * kPi + 250;

SceneText plate(const std::string& material, const std::string& options) {
  SceneText scene(options);
  scene.uniform_sky(100).material("m", material).square("m", Vec3(0, 0, -4), 5, Vec3(0, 0, 1));
  scene.light("lamp", "\"physical_light\" ( \"color\" 4000 4000 4000 ) origin 0 0 -2");
  return scene.camera("focal 2000 aperture 1 aspect 1 resolution 4 4");
}

struct Rendered : RenderedScene {
  explicit Rendered(const SceneText& scene, bool irradiance = true)
      : RenderedScene(
            scene, {.budget = {.samples = 256}, .irradiance = irradiance, .unit_luminance = 1}) {}
  Image layer(const std::string& name) const {
    const auto layers = film_layers(session(), LayerSet(name));
    const Layer* found = find_layer(layers, name);
    return found ? found->image : Image();
  }
  double mean_lux() const {
    const Image image = layer("illuminance");
    double sum = 0;
    for (const float v : image.pixels) sum += v;
    return sum / static_cast<double>(image.pixels.size());
  }
};

constexpr const char* kBlack = "\"diffuse_weight\" 0, \"reflectivity\" 0";
constexpr const char* kMirror =
    "\"diffuse_weight\" 0, \"reflectivity\" 1, \"refl_color\" 1 1 1, \"brdf_0_degree_refl\" 1";
constexpr const char* kGlass = "\"diffuse_weight\" 0, \"transparency\" 1, \"refr_ior\" 1.5";
constexpr const char* kWhite = "\"diffuse\" 1 1 1, \"reflectivity\" 0";

TEST(MeasureLayers, IlluminanceIsTheSameOnEverySurface) {
  const std::string options = "trace depth 8 8 12 shadow segments ";
  for (const char* material : {kWhite, kBlack, kMirror, kGlass})
    EXPECT_NEAR(Rendered(plate(material, options)).mean_lux(), kExact, .01 * kExact) << material;
}

TEST(MeasureLayers, AskingChangesNoOtherLayer) {
  const SceneText scene = plate(kWhite, "trace depth 8 8 12");
  const Rendered with(scene), without(scene, false);
  EXPECT_EQ(with.layer("").pixels, without.layer("").pixels);
  EXPECT_TRUE(without.layer("illuminance").empty());
}

TEST(MeasureLayers, LuminanceOfAWhiteSurfaceIsItsIlluminanceByPi) {
  const Rendered r(plate(kWhite, "trace depth 8 8 12"));
  double sum = 0;
  const Image luminance = r.layer("luminance");
  for (const float v : luminance.pixels) sum += v;
  EXPECT_NEAR(sum / static_cast<double>(luminance.pixels.size()), kExact / kPi, .01 * kExact / kPi);
}

}  // namespace measure_layers_test
}  // namespace oriel::testing
