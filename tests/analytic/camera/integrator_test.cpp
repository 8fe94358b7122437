// SPDX-License-Identifier: Apache-2.0
// Interface of integrators, and their table.
#include "render/integrator.h"

#include <set>

#include "render/eye_rays.h"
#include "render/indirect_plan.h"
#include "support/expect_near.h"
#include "support/portal_scenes.h"

namespace oriel::testing {
namespace integrator_test {

/// Returns the ray direction, for any scene.
class DirectionIntegrator final : public Integrator {
 public:
  void trace(const Camera::Ray& eye, Vec2, float paths_of_pixel, PathRecord& record,
             sampling::Sampler&, RayCounts&) const override {
    record.radiance = Rgb(eye.direction.x, eye.direction.y, eye.direction.z);
    paths = paths_of_pixel;
  }
  mutable float paths = 0;
};

TEST(Integrators, EachMethodOfTheOptionsHasOneRow) {
  std::set<scene::IndirectMethod> methods;
  for (const IntegratorSpec& row : integrators()) {
    EXPECT_TRUE(methods.insert(row.method).second) << row.name;
    EXPECT_EQ(find_integrator(row.name), &row);
    if (row.method == scene::IndirectMethod::Scene) continue;
    scene::RenderOptions options;
    options.indirect = row.method;
    EXPECT_STREQ(plan_indirect(options).name(), row.name);
  }
  EXPECT_EQ(methods.size(), 6u);
  EXPECT_EQ(find_integrator("bidirectional"), nullptr);
}

TEST(Integrators, CameraSamplesShowTheResultOfTheIntegrator) {
  SceneText text;
  text.lambert("grey", .5f).camera("focal 1 aperture 1 aspect 1 resolution 8 8");
  const Probe probe = probe_of(text);
  const DirectionIntegrator integrator;
  PathRecord record;
  sampling::Sampler sampler(3, 4, 0);
  RayCounts counts;
  trace_eye_rays(probe.world(), integrator, Vec2(4, 4), 32, record, sampler, counts);
  expect_near(record.radiance, Rgb(0, 0, -1), 1e-6f, "the middle of the picture");
  EXPECT_EQ(integrator.paths, 32);
}

TEST(Integrators, RaysOfALensShareTheSamplesOfThePixel) {
  SceneText text;
  text.lambert("grey", .5f)
      .camera(
          "lens \"mia_lens_bokeh\" ( \"on\" on, \"plane\" 5, \"radius\" .5, \"samples\" 4 ) "
          "focal 1 aperture 1 aspect 1 resolution 8 8");
  const Probe probe = probe_of(text);
  const DirectionIntegrator integrator;
  PathRecord record;
  sampling::Sampler sampler(3, 4, 0);
  RayCounts counts;
  trace_eye_rays(probe.world(), integrator, Vec2(4, 4), 32, record, sampler, counts);
  EXPECT_EQ(integrator.paths, 32 * 4);
  EXPECT_NEAR(record.radiance.z, -1, .02f) << "lens rays of the middle cross at distance 5";
}

}  // namespace integrator_test
}  // namespace oriel::testing
