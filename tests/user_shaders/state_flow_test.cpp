// SPDX-License-Identifier: Apache-2.0
// State inheritance: from the shader that casts a ray or samples a light to the called shader, and
// back by state->child.
#include "user_scene.h"

namespace oriel {
namespace state_flow_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

/// `is(state, name)`: the shader that runs, or ran, with the state is declared by that name.
const std::string kHead =
    "#include <shader.h>\n"
    "static int is(const miState *s, const char *name) { const char *found = 0;"
    "  return s && s->shader && mi_query(miQ_DECL_NAME, 0, s->shader->function_decl, &found)"
    "    && found && strcmp(found, name) == 0; }";

/// A square of half size 8 at z = 6 above the camera; add "ceiling_i" to the members.
std::string ceiling(const std::string& material) {
  return "object \"ceiling\" visible shadow trace group -8 -8 6 -8 8 6 8 8 6 8 -8 6 "
         "v 0 v 1 v 2 v 3 c 0 1 2 3 end group end object "
         "instance \"ceiling_i\" \"ceiling\" material \"" +
         material + "\" end instance ";
}

std::string declared(const std::string& shader, const std::string& kind = "material") {
  return "declare shader color \"" + shader + "\" ( ) apply " + kind + " end declare ";
}

std::string material(const std::string& shader) {
  return "material \"" + shader + "_m\" \"" + shader + "\" ( ) end material ";
}

TEST(UserStateFlow, ReflectionsInheritUserDataAndTagsAndShowWhatTheyBecame) {
  const ShaderFolder folder;
  folder.compile("f",
                 kHead +
                     "DLLEXPORT miBoolean caster(miColor *r, miState *state, void *p) {"
                     "  miScalar x = .25; miTag volume = state->volume, env = state->environment;"
                     "  miVector up = {0, 0, 1}; int back;"
                     "  state->user = &x; state->user_size = sizeof x;"
                     "  state->volume = 1234; state->environment = 1235; state->ior = 1.5;"
                     "  mi_trace_reflection(r, state, &up);"
                     "  back = state->user == (void *)&x && state->user_size == sizeof x;"
                     "  state->volume = volume; state->environment = env;"
                     "  r->r += back ? x : 0;"
                     "  r->b *= state->child && state->child->user_size == 9; return miTRUE; }"
                     "DLLEXPORT miBoolean reader(miColor *r, miState *state, void *p) {"
                     "  r->r = state->user ? *(miScalar *)state->user : 0;"
                     "  r->g = state->user_size == sizeof(miScalar) && state->volume == 1234 &&"
                     "         state->environment == 1235 && state->ior == 1.5 ? 1 : 0;"
                     "  r->b = is(state->parent, \"caster\"); r->a = 1;"
                     "  if (state->user) *(miScalar *)state->user = .5;"
                     "  state->user_size = 9; return miTRUE; }");
  UserScene scene(folder,
                  "link \"f.so\" " + declared("caster") + declared("reader") + material("caster") +
                      material("reader") + ceiling("reader_m") + UserScene::square("caster_m"),
                  "\"square_i\" \"ceiling_i\"");
  expect_near(scene.pixel(4, 4, 4), Rgb(.75f, 1, 1), 1e-6f);
}

TEST(UserStateFlow, TransparentRefractedAndGatherRaysInheritUserData) {
  const ShaderFolder folder;
  folder.compile("t",
                 kHead +
                     "DLLEXPORT miBoolean caster(miColor *r, miState *state, void *p) {"
                     "  miScalar x = .25; miVector down = {0, 0, -1}, up = {0, 0, 1};"
                     "  miColor a, b, c; state->user = &x; state->refraction_volume = 1234;"
                     "  mi_trace_transparent(&a, state); mi_trace_refraction(&b, state, &down);"
                     "  mi_compute_irradiance(&c, state);"
                     "  r->r = a.r; r->g = b.r; r->b = c.r; r->a = 1; return miTRUE; }"
                     "DLLEXPORT miBoolean reader(miColor *r, miState *state, void *p) {"
                     "  int medium = state->type == miRAY_FINALGATHER || state->volume == 1234;"
                     "  r->r = state->user && medium ? *(miScalar *)state->user : 0;"
                     "  r->g = r->b = 0; r->a = 1; return miTRUE; }"
                     "DLLEXPORT miBoolean sky(miColor *r, miState *state, void *p) {"
                     "  r->r = state->user ? 1 : 0; r->g = r->b = 0; r->a = 1; return miTRUE; }");
  UserScene scene(folder,
                  "link \"t.so\" " + declared("caster") + declared("reader") +
                      declared("sky", "environment") + material("caster") + material("reader") +
                      "object \"under\" visible shadow trace group -80 -80 -2 80 -80 -2 80 80 -2 "
                      "-80 80 -2 v 0 v 1 v 2 v 3 c 0 1 2 3 end group end object instance "
                      "\"under_i\" \"under\" material \"reader_m\" end instance " +
                      UserScene::square("caster_m"),
                  "\"square_i\" \"under_i\"", "", "environment \"sky\" ( )");
  expect_near(scene.pixel(4, 4, 4), Rgb(.25f, .25f, kPi), 1e-4f);
}

const std::string kAskedLight =
    "DLLEXPORT miBoolean asked(miColor *r, miState *state, void *p) {"
    "  const char *name = 0; miState *from = state->parent;"
    "  int known = from && from->shader && mi_query(miQ_DECL_NAME, 0,"
    "      from->shader->function_decl, &name) && name;"
    "  r->r = is(from, \"asker\") && from->user == state->user && state->user ?"
    "      *(miScalar *)state->user : 0;"
    "  r->g = known ? 1 : 0;"
    "  r->b = state->raster_x > 4 && state->raster_x < 5 && from->raster_x == state->raster_x;"
    "  r->a = 1; return miTRUE; }";
const std::string kLamp =
    "light \"lamp\" \"asked\" ( ) origin 0 0 3 end light "
    "instance \"lamp_i\" \"lamp\" end instance ";

TEST(UserStateFlow, LightShadersGetTheCallingShader) {
  const ShaderFolder folder;
  folder.compile("l", kHead + kAskedLight +
                          "DLLEXPORT miBoolean asker(miColor *r, miState *state, void *p) {"
                          "  miTag *lights; int n, s = 0; miVector d; miScalar nl, x = .25;"
                          "  state->user = &x; n = mi_global_lights_info(&lights);"
                          "  r->r = r->g = r->b = 0; r->a = 1;"
                          "  if (n) mi_sample_light(r, &d, &nl, state, lights[0], &s);"
                          "  return miTRUE; }");
  UserScene scene(folder,
                  "link \"l.so\" " + declared("asker") + declared("asked", "light") + kLamp +
                      material("asker") + UserScene::square("asker_m"),
                  "\"square_i\" \"lamp_i\"");
  scene.indirect = false;
  expect_near(scene.pixel(4, 4, 4), Rgb(.25f, 1, 1), 1e-6f);
}

TEST(UserStateFlow, ShadowShadersSeeTheLight) {
  const ShaderFolder folder;
  folder.compile("s", kHead +
                          "DLLEXPORT miBoolean lit(miColor *r, miState *state, void *p) {"
                          "  r->r = r->g = r->b = r->a = 1; state->user_size = 9;"
                          "  return mi_trace_shadow(r, state); }"
                          "DLLEXPORT miBoolean shade(miColor *r, miState *state, void *p) {"
                          "  r->r *= is(state->parent, \"lit\") && state->user_size == 9;"
                          "  r->g *= state->user && *(miScalar *)state->user == .25 &&"
                          "          is(state->parent->parent, \"asker\");"
                          "  r->b *= state->raster_x > 4 && state->raster_x < 5; return miTRUE; }"
                          "DLLEXPORT miBoolean asker(miColor *r, miState *state, void *p) {"
                          "  miTag *lights; int n, s = 0; miVector d; miScalar nl, x = .25;"
                          "  state->user = &x; n = mi_global_lights_info(&lights);"
                          "  r->r = r->g = r->b = 0; r->a = 1;"
                          "  if (n) mi_sample_light(r, &d, &nl, state, lights[0], &s);"
                          "  return miTRUE; }");
  UserScene scene(folder,
                  "link \"s.so\" " + declared("asker") + declared("lit", "light") +
                      declared("shade", "shadow") + material("asker") +
                      "light \"lamp\" \"lit\" ( ) origin 0 0 3 end light "
                      "instance \"lamp_i\" \"lamp\" end instance "
                      "material \"glass\" \"mib_illum_lambert\" ( ) shadow \"shade\" ( ) end "
                      "material object \"wall\" visible shadow trace group -8 -8 2 8 -8 2 8 8 2 "
                      "-8 8 2 v 0 v 1 v 2 v 3 c 0 1 2 3 end group end object instance \"wall_i\" "
                      "\"wall\" visible off shadow on material \"glass\" end instance " +
                      UserScene::square("asker_m"),
                  "\"square_i\" \"lamp_i\" \"wall_i\"");
  scene.indirect = false;
  expect_near(scene.pixel(4, 4, 4), Rgb(1), 1e-5f);
}

TEST(UserStateFlow, LightShadersThatBuiltInMaterialsAskSeeAParentWithAShader) {
  const ShaderFolder folder;
  folder.compile("l", kHead + kAskedLight);
  UserScene scene(folder,
                  "link \"l.so\" " + declared("asked", "light") + kLamp +
                      "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 0 0 0, \"diffuse\" 1 1 "
                      "1, \"mode\" 1, \"lights\" [\"lamp_i\"] ) end material " +
                      UserScene::square("m"),
                  "\"square_i\" \"lamp_i\"");
  scene.indirect = false;
  const Rgb seen = scene.pixel(4, 4, 4);
  EXPECT_EQ(seen.x, 0);
  EXPECT_GT(seen.y, .5f);
  EXPECT_FLOAT_EQ(seen.z, seen.y);
}

TEST(UserStateFlow, MaterialsBehindBuiltInMirrorsHaveAParentWithAShader) {
  const ShaderFolder folder;
  folder.compile("m", kHead +
                          "DLLEXPORT miBoolean reader(miColor *r, miState *state, void *p) {"
                          "  r->r = state->user == 0; r->g = r->b = 0; r->a = 1;"
                          "  if (state->type == miRAY_EYE) return miTRUE;"
                          "  r->g = state->parent && is(state->parent, \"reader\");"
                          "  r->b = state->parent && state->parent->cache &&"
                          "         state->parent->options == state->options; return miTRUE; }");
  UserScene scene(folder,
                  "link \"m.so\" " + declared("reader") + material("reader") +
                      "material \"mirror\" \"mib_reflect\" ( \"reflect\" 1 1 1 1, \"notrace\" off )"
                      " end material " +
                      ceiling("reader_m") + UserScene::square("mirror"),
                  "\"square_i\" \"ceiling_i\"");
  expect_near(scene.pixel(4, 4, 4), Rgb(1), 1e-5f);
}

TEST(UserStateFlow, EnvironmentShadersSeeThePlaceOfTheEyeSample) {
  const ShaderFolder folder;
  folder.compile("e",
                 kHead +
                     "DLLEXPORT miBoolean sky(miColor *r, miState *state, void *p) {"
                     "  r->r = state->raster_x / state->camera->x_resolution;"
                     "  r->g = state->raster_y / state->camera->y_resolution;"
                     "  r->b = state->type == miRAY_EYE || is(state->parent, \"caster\"); r->a = 1;"
                     "  return miTRUE; }"
                     "DLLEXPORT miBoolean caster(miColor *r, miState *state, void *p) {"
                     "  miVector up = {0, 0, 1}; miColor a; mi_trace_environment(&a, state, &up);"
                     "  mi_trace_reflection(r, state, &up);"
                     "  if (r->r != a.r || r->g != a.g || r->b != a.b) return miFALSE;"
                     "  return miTRUE; }");
  const std::string sky = "link \"e.so\" " + declared("sky", "environment");
  const Rgb wanted(2.5f / 8, 5.5f / 8, 1);
  UserScene empty(folder, sky, "", "", "environment \"sky\" ( )");
  expect_near(empty.pixel(2, 5, 256), wanted, 1e-3f);
  UserScene mirror(folder,
                   sky + declared("caster") + material("caster") + UserScene::square("caster_m"),
                   "\"square_i\"", "", "environment \"sky\" ( )");
  expect_near(mirror.pixel(2, 5, 256), wanted, 1e-3f);
}

TEST(UserStateFlow, EachStateHasItsOwnChild) {
  const ShaderFolder folder;
  folder.compile(
      "c", kHead +
               "DLLEXPORT miBoolean chain(miColor *r, miState *state, void *p) {"
               "  miVector up = {0, 0, 1}, down = {0, 0, -1}, side = {1, 0, 0}; miState *a, *b;"
               "  r->r = r->g = r->b = 0; r->a = 1;"
               "  if (!mi_trace_probe(state, &up, &state->point)) return miTRUE; a = state->child;"
               "  if (!mi_trace_probe(a, &down, &a->point)) return miTRUE; b = a->child;"
               "  r->r = a != b && a != state && b != state && state->child == a &&"
               "    a->parent == state && b->parent == a && a->child == b && b->child == 0;"
               "  r->g = fabs(a->dist - 6) < 1e-4 && fabs(b->dist - 6) < 1e-4 &&"
               "    fabs(a->point.z - 6) < 1e-4 && fabs(b->point.z) < 1e-4;"
               "  if (!mi_trace_probe(b, &side, &b->point))"
               "    r->b = b->child && b->child != b && b->child->dist == 0 && a->dist > 5;"
               "  return miTRUE; }");
  UserScene scene(folder,
                  "link \"c.so\" " + declared("chain") + material("chain") + ceiling("chain_m") +
                      UserScene::square("chain_m"),
                  "\"square_i\" \"ceiling_i\"");
  expect_near(scene.pixel(4, 4, 4), Rgb(1), 0);
}

TEST(UserStateFlow, AfterAMissTheChildHasNoDistance) {
  const ShaderFolder folder;
  folder.compile(
      "c", kHead +
               "DLLEXPORT miBoolean deep(miColor *r, miState *state, void *p) {"
               "  miVector up = {0, 0, 1}, side = {1, 0, 1}; int level = state->reflection_level;"
               "  miColor seen; miState *child; r->r = r->g = r->b = 0; r->a = 1;"
               "  if (state->type != miRAY_EYE) return miTRUE; mi_vector_normalize(&side);"
               "  mi_trace_reflection(&seen, state, &up); child = state->child;"
               "  r->r = child && fabs(child->dist - 6) < 1e-4;"
               "  mi_trace_reflection(&seen, state, &side);"
               "  r->g = state->child && state->child->dist == 0;"
               "  mi_trace_reflection(&seen, state, &up); state->reflection_level = 100;"
               "  mi_trace_reflection(&seen, state, &up); state->reflection_level = level;"
               "  r->b = state->child && state->child->dist == 0; return miTRUE; }");
  UserScene scene(folder,
                  "link \"c.so\" " + declared("deep") + material("deep") +
                      "object \"small\" visible shadow trace group -1 -1 6 -1 1 6 1 1 6 1 -1 6 v 0 "
                      "v 1 v 2 v 3 c 0 1 2 3 end group end object instance \"small_i\" \"small\" "
                      "material \"deep_m\" end instance " +
                      UserScene::square("deep_m"),
                  "\"square_i\" \"small_i\"");
  expect_near(scene.pixel(4, 4, 4), Rgb(1), 0);
}

TEST(UserStateFlow, LensesHandUserDataToTheMaterialsOfTheirRays) {
  const ShaderFolder folder;
  folder.compile("l", kHead +
                          "DLLEXPORT miBoolean outer(miColor *r, miState *state, void *p) {"
                          "  miScalar x = .5; miVector o = state->org, d = state->dir;"
                          "  state->user = &x; return mi_trace_eye(r, state, &o, &d); }"
                          "DLLEXPORT miBoolean inner(miColor *r, miState *state, void *p) {"
                          "  miVector o = state->org, d = state->dir;"
                          "  int last = is(state->parent, \"outer\");"
                          "  mi_trace_eye(r, state, &o, &d); r->b *= last; return miTRUE; }"
                          "DLLEXPORT miBoolean reader(miColor *r, miState *state, void *p) {"
                          "  r->r = state->user ? *(miScalar *)state->user : 0;"
                          "  r->g = is(state->parent, \"inner\"); r->b = r->a = 1;"
                          "  return miTRUE; }");
  UserScene scene(folder,
                  "link \"l.so\" " + declared("outer", "lens") + declared("inner", "lens") +
                      declared("reader") + material("reader") + UserScene::square("reader_m"),
                  "\"square_i\"", "", "lens \"outer\" ( ) lens \"inner\" ( )");
  expect_near(scene.pixel(4, 4, 4), Rgb(.5f, 1, 1), 1e-6f);
}

}  // namespace state_flow_test
}  // namespace oriel
