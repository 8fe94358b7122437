// SPDX-License-Identifier: Apache-2.0
// State of a hit primitive: handle, bump vectors, derivatives.
#include "user_scene.h"

namespace oriel {
namespace hit_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

const std::string kHead = "#include <shader.h>\n";

std::string shown(const std::string& library, const std::string& shader) {
  return "link \"" + library + "\" declare shader color \"" + shader +
         "\" ( ) apply material end declare material \"m\" \"" + shader + "\" ( ) end material ";
}

const std::string kBumps =
    kHead +
    "DLLEXPORT miBoolean bumps(miColor *r, miState *state, void *p) {"
    "  int textures = -1, bumps = -1, i; r->b = 0; r->a = 1;"
    "  mi_query(miQ_NUM_TEXTURES, state, 0, &textures);"
    "  mi_query(miQ_NUM_BUMPS, state, 0, &bumps);"
    "  for (i = 0; i < bumps; ++i) r->b += state->bump_x_list[i].x + state->bump_y_list[i].y;"
    "  r->r = textures; r->g = bumps;"
    "  if (!state->derivs) return miFALSE; return miTRUE; }";

TEST(UserHits, BumpsAreCountedWhereTheirVectorsAreWritten) {
  const ShaderFolder folder;
  folder.compile("b", kBumps);
  UserScene without(folder, shown("b.so", "bumps") + UserScene::square("m"), "\"square_i\"");
  expect_near(without.pixel(4, 4, 4), Rgb(1, 0, 0), 0);
  UserScene with(folder,
                 shown("b.so", "bumps") +
                     "object \"square\" visible shadow trace group -8 -8 0 8 -8 0 8 8 0 -8 8 0 "
                     "0 0 0 1 0 0 1 1 0 0 1 0 1 0 0 0 1 0 v 0 t 4 8 9 v 1 t 5 8 9 v 2 t 6 8 9 "
                     "v 3 t 7 8 9 c 0 1 2 3 end group end object "
                     "instance \"square_i\" \"square\" material \"m\" end instance ",
                 "\"square_i\"");
  expect_near(with.pixel(4, 4, 4), Rgb(1, 1, 2), 1e-6f);
}

/// The handle as sources keep it and as they make a seed of it.
const std::string kHandle =
    kHead +
    "extern \"C\" DLLEXPORT miBoolean handle(miColor *r, miState *state, void *) {"
    "  void *pri = state->pri; unsigned seed = (unsigned)(size_t)state->pri;"
    "  state->pri = 0; state->pri = pri;"
    "  r->r = (miScalar)(seed % 4093); r->g = pri ? 1 : 0;"
    "  r->b = (miScalar)((size_t)pri / 7 % 4093); r->a = 1; return miTRUE; }";

TEST(UserHits, TheHandleOfAPrimitiveIsStableAndItsOwn) {
  const ShaderFolder folder;
  folder.compile("h", kHandle, "cpp");
  UserScene scene(folder, shown("h.so", "handle") + UserScene::square("m"), "\"square_i\"");
  const Rgb one = scene.pixel(1, 6, 1), other = scene.pixel(6, 1, 1);
  EXPECT_EQ(one.y, 1);
  EXPECT_NE(one.x, other.x);
  expect_near(scene.pixel(2, 6, 16), one, 0);
  expect_near(scene.pixel(6, 2, 16), other, 0);
}

TEST(UserHits, ChildStatesHaveTheHandleOfTheirHit) {
  const ShaderFolder folder;
  folder.compile("c", kHead +
                          "DLLEXPORT miBoolean child(miColor *r, miState *state, void *p) {"
                          "  miVector up = {0, 0, 1}; void *met = 0; miColor seen;"
                          "  if (state->type != miRAY_EYE) { *(void **)state->user = state->pri;"
                          "    r->r = r->g = r->b = r->a = 1; return miTRUE; }"
                          "  r->r = r->g = r->b = 0; r->a = 1; state->user = &met;"
                          "  mi_trace_reflection(&seen, state, &up);"
                          "  r->r = state->child && met && state->child->pri == met;"
                          "  if (mi_trace_probe(state, &up, &state->point))"
                          "    r->g = state->child->pri == met;"
                          "  r->b = met != state->pri; return miTRUE; }");
  UserScene scene(folder,
                  shown("c.so", "child") +
                      "object \"top\" visible shadow trace group -8 -8 6 -8 8 6 8 8 6 8 -8 6 v 0 v "
                      "1 v 2 v 3 c 0 1 2 3 end group end object instance \"top_i\" \"top\" "
                      "material \"m\" end instance " +
                      UserScene::square("m"),
                  "\"square_i\" \"top_i\"");
  expect_near(scene.pixel(4, 4, 4), Rgb(1), 0);
}

TEST(UserHits, WithoutAHandleLightsOfBothSidesAreUsed) {
  const ShaderFolder folder;
  folder.compile("s", kHead +
                          "DLLEXPORT miBoolean sides(miColor *r, miState *state, void *p) {"
                          "  miTag *lights; int n = mi_global_lights_info(&lights), s = 0;"
                          "  miVector d; miScalar nl; miColor c; void *pri = state->pri;"
                          "  r->r = r->g = r->b = 0; r->a = 1; if (!n) return miTRUE;"
                          "  if (mi_sample_light(&c, &d, &nl, state, lights[0], &s)) r->r = c.r;"
                          "  s = 0; state->pri = NULL;"
                          "  if (mi_sample_light(&c, &d, &nl, state, lights[0], &s)) r->g = c.r;"
                          "  state->pri = pri; return miTRUE; }");
  UserScene scene(folder,
                  shown("s.so", "sides") +
                      "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 -3 end "
                      "light instance \"lamp_i\" \"lamp\" end instance " +
                      UserScene::square("m"),
                  "\"square_i\" \"lamp_i\"");
  scene.indirect = false;
  expect_near(scene.pixel(4, 4, 4), Rgb(0, 1, 0), 1e-5f);
}

}  // namespace hit_test
}  // namespace oriel
