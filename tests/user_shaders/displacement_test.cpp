// SPDX-License-Identifier: Apache-2.0
// Results of displacement shaders.
#include "user_scene.h"

namespace oriel {
namespace displacement_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

const std::string kHead = "#include <shader.h>\n";

TEST(UserDisplacement, MovesAlongTheNormalAndFromThePointThatTheShaderLeaves) {
  const ShaderFolder folder;
  folder.compile("d", kHead +
                          "DLLEXPORT miBoolean slant(miScalar *r, miState *state, void *p) {"
                          "  miVector n = {.6, 0, .8}; state->normal = n; *r += 2.5;"
                          "  return miTRUE; }"
                          "DLLEXPORT miBoolean shift(miScalar *r, miState *state, void *p) {"
                          "  state->point.y += 1; state->point.z += .5; *r += 1; return miTRUE; }"
                          "DLLEXPORT miBoolean place(miColor *r, miState *state, void *p) {"
                          "  r->r = 16 * state->tex_list[0].x - 8 - state->point.x;"
                          "  r->g = 16 * state->tex_list[0].y - 8 - state->point.y;"
                          "  r->b = state->point.z; r->a = 1; return miTRUE; }");
  const auto moved = [&](const std::string& shader, const std::string& limit) {
    UserScene scene(folder,
                    "link \"d.so\" declare shader scalar \"" + shader +
                        "\" ( ) apply displace end declare declare shader color \"place\" ( ) "
                        "apply material end declare material \"m\" \"place\" ( ) displace \"" +
                        shader + "\" ( ) end material " + UserScene::square("m"),
                    "\"square_i\"", "max displace " + limit);
    return scene.pixel(4, 4);
  };
  // The undisplaced position, from the texture, minus the displaced one.
  expect_near(moved("slant", "3"), Rgb(-1.5f, 0, 2), 1e-4f);
  expect_near(moved("shift", "3"), Rgb(0, -1, 1.5f), 1e-4f);
  // The bound holds for the whole way.
  expect_near(moved("slant", "1"), Rgb(-.6f, 0, .8f), 1e-4f);
}

}  // namespace displacement_test
}  // namespace oriel
