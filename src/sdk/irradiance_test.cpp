// SPDX-License-Identifier: Apache-2.0
// Irradiance and occlusion functions of shaders.
#include <gtest/gtest.h>

#include "oriel/sdk/shader/irradiance.h"
#include "sdk/testing/bare_state.h"

namespace oriel::sdk {
namespace irradiance_test {

using testing::BareState;

// A diffuse environment of radiance L gives the irradiance pi L.
TEST(Irradiance, IsComputedForTheRequestedFace) {
  BareState bare;
  bare.look_down(0, 1);
  bare.numbers.above = Rgb(kPi);
  bare.numbers.below = Rgb(2 * kPi);
  miColor c;
  ASSERT_TRUE(mi_compute_irradiance(&c, &bare.state()));
  EXPECT_FLOAT_EQ(c.r, kPi);
  ASSERT_TRUE(mi_compute_irradiance_backside(&c, &bare.state()));
  EXPECT_FLOAT_EQ(c.r, 2 * kPi);
  ASSERT_TRUE(mi_compute_avg_radiance(&c, &bare.state(), 'f', nullptr));
  EXPECT_FLOAT_EQ(c.g, 1);
  ASSERT_TRUE(mi_compute_avg_radiance(&c, &bare.state(), 'b', nullptr));
  EXPECT_FLOAT_EQ(c.b, 2);
}

// Only the surface itself blocks rays, those below it.
TEST(AmbientOcclusion, IsTheFractionOfBlockedRays) {
  BareState bare;
  bare.look_down(0, 1);
  miAmboccl_options options = {};
  miAMBOCCL_DEFAULT(&options, &bare.state());
  for (const miUint rays : {1u, 4u}) {
    options.rays = rays;
    options.axis = {0, 0, 1};
    EXPECT_EQ(mi_ambient_occlusion(&bare.state(), &options, nullptr), 0);
    options.axis = {0, 0, -1};
    EXPECT_EQ(mi_ambient_occlusion(&bare.state(), &options, nullptr), 1);
  }
}

}  // namespace irradiance_test
}  // namespace oriel::sdk
