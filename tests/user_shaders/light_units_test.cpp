// SPDX-License-Identifier: Apache-2.0
// Light units in user shaders: lux.
#include "color/luminance.h"
#include "user_picture.h"

namespace oriel {
namespace light_units_test {

using testing::ShaderFolder;
using testing::UserPicture;
using testing::UserScene;

/// A Lambert surface, white, that shows the lights' part (mode 0) or the gathered part (mode 1).
constexpr const char* kCard =
    "#include <shader.h>\n"
    "struct card { miInteger gathered; };"
    "DLLEXPORT miBoolean card(miColor *r, miState *state, struct card *p) {"
    "  miColor sum = {0, 0, 0, 1}, one; miVector d; miScalar nl; miTag *lights; int i, n;"
    "  if (*mi_eval_integer(&p->gathered)) {"
    "    if (!mi_compute_irradiance(&sum, state)) return miFALSE;"
    "    sum.r /= M_PI; sum.g /= M_PI; sum.b /= M_PI;"
    "  } else {"
    "    n = mi_global_lights_info(&lights);"
    "    for (i = 0; i < n; i++) { int samples = 0; miColor mean = {0, 0, 0, 0};"
    "      while (mi_sample_light(&one, &d, &nl, state, lights[i], &samples)) {"
    "        mean.r += one.r * nl; mean.g += one.g * nl; mean.b += one.b * nl; }"
    "      if (samples) { sum.r += mean.r / samples; sum.g += mean.g / samples;"
    "                     sum.b += mean.b / samples; } }"
    "  }"
    "  *r = sum; r->a = 1; return miTRUE; }";

// acceptance: S1
TEST(LightUnits, SunAndSkyGiveShadersTheirIlluminance) {
  const ShaderFolder folder;
  folder.compile("card", kCard);
  const auto lux = [&](int gathered, const std::string& method) {
    // The sun at 45 degrees, haze 1; the ground, which the card does not see, black.
    const std::string sky =
        "shader \"sky\" \"mia_physicalsky\" ( \"rgb_unit_conversion\" 1 1 1, \"haze\" 1, "
        "\"sun_direction\" 1 0 1, \"ground_color\" 0 0 0 ) "
        "light \"sun\" \"mia_physicalsun\" ( \"rgb_unit_conversion\" 1 1 1, \"haze\" 1 ) "
        "direction -1 0 -1 end light instance \"sun_i\" \"sun\" end instance ";
    UserScene scene(folder,
                    "link \"card.so\" declare shader color \"card\" ( integer \"gathered\" ) apply "
                    "material end declare " +
                        sky + "material \"m\" \"card\" ( \"gathered\" " + std::to_string(gathered) +
                        " ) end material " + UserScene::square("m"),
                    "\"sun_i\" \"square_i\"", "finalgather on finalgather accuracy 400 " + method,
                    "environment = \"sky\"");
    const float y = luminance(UserPicture(scene, 32).mean());
    EXPECT_EQ(scene.messages(), "");
    return y;
  };
  // Horizontal illuminances of the sky's model by quadrature, .1 %.
  for (const std::string method : {"\"indirect\" \"path\"", "\"indirect\" \"fg\""}) {
    EXPECT_NEAR(lux(0, method), 56821, .002f * 56821) << method;
    EXPECT_NEAR(lux(1, method), 28913, .02f * 28913) << method;
  }
}

}  // namespace light_units_test
}  // namespace oriel
