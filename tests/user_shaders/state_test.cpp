// SPDX-License-Identifier: Apache-2.0
// State shaders, called before and after the samples of an image.
#include "user_picture.h"

namespace oriel {
namespace state_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserPicture;
using testing::UserScene;

const std::string kDeclarations =
    "link \"s.so\" declare shader color \"around\" ( integer \"buffer\", color \"tint\" ) version "
    "1 "
    "apply state end declare declare shader color \"count\" ( ) apply material end declare "
    "material \"m\" \"count\" ( ) end material ";

/// Leaves a number at the begin of a sample, has the material double it, and reads it at the end.
const char* const kAround =
    "#include <shader.h>\n"
    "struct around { miInteger buffer; miColor tint; };"
    "DLLEXPORT miBoolean around(miColor *r, miState *state, struct around *p,"
    "                           miShader_state_arg *a) {"
    "  miColor *t = mi_eval_color(&p->tint); int five = 5, *n; miScalar s;"
    "  if (state->type != miRAY_EYE || !state->options) return miFALSE;"
    "  switch (a->op) {"
    "  case miSHADERSTATE_STATE_INIT:"
    "    mi_shaderstate_set(state, \"init\", &five, sizeof five, miSS_LIFETIME_RECT); break;"
    "  case miSHADERSTATE_SAMPLE_INIT:"
    "    n = mi_shaderstate_get(state, \"init\", 0); if (!n) return miFALSE;"
    "    mi_shaderstate_set(state, \"n\", n, sizeof *n, miSS_LIFETIME_EYERAY); break;"
    "  case miSHADERSTATE_SAMPLE_EXIT:"
    "    n = mi_shaderstate_get(state, \"n\", 0); s = n ? *n : -1;"
    "    mi_fb_put(state, *mi_eval_integer(&p->buffer), &s);"
    "    r->r *= t->r; r->g *= t->g; r->b *= t->b; r->b += a->shader_return; break;"
    "  case miSHADERSTATE_STATE_EXIT:"
    "    mi_shaderstate_set(state, \"init\", 0, 0, miSS_LIFETIME_RECT); r->r = 100; break; }"
    "  return miTRUE; }"
    "DLLEXPORT miBoolean count(miColor *r, miState *state, void *p) {"
    "  int *n = mi_shaderstate_get(state, \"n\", 0); if (n) *n *= 2;"
    "  r->r = r->g = r->b = .5; r->a = 1; return miTRUE; }";

TEST(UserState, IsCalledAroundEachSampleAndMayChangeItsColour) {
  ShaderFolder folder;
  folder.compile("s", kAround);
  UserScene scene(folder, kDeclarations + UserScene::square("m"), "\"square_i\"",
                  "frame buffer 0 \"s_fp\" state \"around\" ( \"buffer\" 0, \"tint\" 1 .5 0 ) ");
  EXPECT_EQ(scene.messages(), "");
  const UserPicture picture(scene, 4);
  expect_near(rgb(picture.session->film().pixel(4, 4).beauty), Rgb(.5f, .25f, 1), 1e-6f);
  ASSERT_EQ(scene.world->user_buffers.size(), 1u);
  EXPECT_NEAR(picture.session->film().user_buffer(4, 4, 0).r, 10, 1e-5f);
}

TEST(UserState, SeveralAreCalledInOrderWithTheResultsOfMissedRays) {
  ShaderFolder folder;
  folder.compile("s", kAround);
  // No geometry: the material is not called, the sample is black before the tints.
  UserScene scene(folder, kDeclarations, "",
                  "state [ \"around\" ( \"tint\" 1 1 1 ) , \"around\" ( \"tint\" 1 1 1 ) ] ");
  EXPECT_EQ(scene.world->state_shaders.size(), 2u);
  const UserPicture picture(scene, 4);
  expect_near(picture.mean(), Rgb(0), 1e-6f);
}

TEST(UserState, ShaderOfAnotherKindIsReportedAndSkipped) {
  ShaderFolder folder;
  UserScene scene(folder, "", "", "state \"mib_illum_lambert\" ( ) ");
  EXPECT_TRUE(scene.world->state_shaders.empty());
  EXPECT_NE(scene.messages().find("OR-RN-012"), std::string::npos) << scene.messages();
}

}  // namespace state_test
}  // namespace oriel
