// SPDX-License-Identifier: Apache-2.0
// Output shaders run in the order of the list of the camera, built-in or user-defined.
#include <cmath>

#include "user_picture.h"

namespace oriel {
namespace output_order_test {

using testing::ShaderFolder;
using testing::UserPicture;
using testing::UserScene;

/// A surface of .0625, and a shader that adds a quarter to the picture and puts what it was given
/// into buffer 0.
const char* const kAdd =
    "#include <shader.h>\n"
    "DLLEXPORT miBoolean even(miColor *r, miState *state, void *p) {"
    "  r->r = r->g = r->b = .0625; r->a = 1; return miTRUE; }"
    "DLLEXPORT miBoolean add(void *r, miState *state, void *p) {"
    "  miImg_image *b = mi_output_image_open(state, miRC_IMAGE_USER + 0); miColor c;"
    "  miImg_image *z = mi_output_image_open(state, miRC_IMAGE_RGBA); int x, y;"
    "  for (y = 0; y < 8; y++) for (x = 0; x < 8; x++) {"
    "    mi_img_get_color(z, &c, x, y); mi_img_put_color(b, &c, x, y);"
    "    c.r += .25; c.g += .25; c.b += .25; mi_img_put_color(z, &c, x, y); }"
    "  mi_output_image_close(state, miRC_IMAGE_USER + 0);"
    "  mi_output_image_close(state, miRC_IMAGE_RGBA); return miTRUE; }";

const std::string kAdding = "output \"add\" ( ) ";
const std::string kExposure =
    "output \"mia_exposure_simple\" ( \"gain\" 2, \"compression\" 0, \"gamma\" 2 ) ";
const std::string kFiles = "output \"rgba_fp\" \"exr\" \"a.exr\" output \"fb0\" \"exr\" \"b.exr\" ";

/// Green of the picture and of buffer 0 after a list of output shaders.
std::pair<float, float> after(const std::string& list) {
  const ShaderFolder folder;
  folder.compile("a", kAdd);
  UserScene scene(folder,
                  "link \"a.so\" declare shader \"add\" ( ) apply output end declare "
                  "declare shader color \"even\" ( ) apply material end declare "
                  "material \"m\" \"even\" ( ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"", "frame buffer 0 \"+rgba_fp\" ", list + kFiles);
  const UserPicture picture(scene, 1);
  EXPECT_EQ(picture.write_files(folder).size(), 2u) << scene.messages();
  return {read_exr_image(folder.file("a.exr")).at(4, 4)[1],
          read_exr_image(folder.file("b.exr")).at(4, 4)[1]};
}

TEST(OutputOrder, ShadersInCBeforeTheExposureGetLinearLight) {
  const auto [shown, given] = after(kAdding + kExposure);
  EXPECT_NEAR(given, .0625f, 1e-6f);
  EXPECT_NEAR(shown, std::sqrt(2 * (.0625f + .25f)), 1e-5f);
}

TEST(OutputOrder, ShadersInCAfterTheExposureGetItsResult) {
  const auto [shown, given] = after(kExposure + kAdding);
  EXPECT_NEAR(given, std::sqrt(2 * .0625f), 1e-5f);
  EXPECT_NEAR(shown, std::sqrt(2 * .0625f) + .25f, 1e-5f);
}

TEST(OutputOrder, HoldsForLongerLists) {
  const auto [shown, given] = after(kExposure + kAdding + kExposure + kAdding);
  const float once = std::sqrt(2 * .0625f) + .25f;
  EXPECT_NEAR(given, std::sqrt(2 * once), 1e-5f);
  EXPECT_NEAR(shown, std::sqrt(2 * once) + .25f, 1e-5f);
}

}  // namespace output_order_test
}  // namespace oriel
