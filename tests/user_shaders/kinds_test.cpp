// SPDX-License-Identifier: Apache-2.0
// Images of user shaders of each kind.
#include "user_scene.h"

namespace oriel {
namespace kinds_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

const char* const kHead = "#include <shader.h>\n";

/// A light at (0, 0, 3) above the square: colour 1 without decay.
const std::string kLamp =
    "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 3 end light "
    "instance \"lamp_i\" \"lamp\" end instance ";

// acceptance: I4
TEST(UserShaders, AMaterialShowsItsColourAndReadsItsParameters) {
  ShaderFolder folder;
  folder.compile("m", std::string(kHead) +
                          "struct flat { miBoolean on; miColor c; miScalar s; miInteger n; };"
                          "DLLEXPORT int flat_version(void) { return 1; }"
                          "DLLEXPORT miBoolean flat(miColor *r, miState *state, struct flat *p) {"
                          "  miColor c = *mi_eval_color(&p->c);"
                          "  miScalar s = *mi_eval_scalar(&p->s);"
                          "  int n = *mi_eval_integer(&p->n);"
                          "  if (!*mi_eval_boolean(&p->on)) return miFALSE;"
                          "  r->r = c.r * s; r->g = c.g * s; r->b = (float)n; r->a = 1;"
                          "  return miTRUE; }");
  UserScene scene(folder,
                  "link \"m.so\" declare shader color \"flat\" ( boolean \"on\", color \"c\", "
                  "scalar \"s\" default 2, integer \"n\" ) version 1 apply material end declare "
                  "material \"m\" \"flat\" ( \"on\" on, \"c\" .1 .2 .3, \"n\" 5 ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  expect_near(scene.pixel(4, 4), Rgb(.2f, .4f, 5), 1e-6f);
  EXPECT_EQ(scene.messages(), "");
}

TEST(UserShaders, LambertLoopEqualsTheBuiltInMaterial) {
  ShaderFolder folder;
  folder.compile("m", std::string(kHead) +
                          "struct lamb { miColor c; int i_lights; int n_lights; miTag lights[1]; };"
                          "DLLEXPORT miBoolean lamb(miColor *r, miState *state, struct lamb *p) {"
                          "  miColor c = *mi_eval_color(&p->c), l; miVector d; float nl; int i;"
                          "  int i0 = *mi_eval_integer(&p->i_lights);"
                          "  int n = *mi_eval_integer(&p->n_lights);"
                          "  miTag *t = mi_eval_tag(p->lights) + i0;"
                          "  r->r = r->g = r->b = 0; r->a = 1;"
                          "  for (i = 0; i < n; i++) { int s = 0; miColor sum = {0,0,0,0};"
                          "    while (mi_sample_light(&l, &d, &nl, state, t[i], &s)) {"
                          "      sum.r += l.r * nl; sum.g += l.g * nl; sum.b += l.b * nl; }"
                          "    if (s) { r->r += c.r * sum.r / s; r->g += c.g * sum.g / s;"
                          "             r->b += c.b * sum.b / s; } }"
                          "  return miTRUE; }");
  const auto lit = [&](const std::string& material) {
    UserScene scene(folder,
                    "link \"m.so\" declare shader \"lamb\" ( color \"c\", array light \"lights\" ) "
                    "apply material end declare " +
                        kLamp + "material \"m\" " + material + " end material " +
                        UserScene::square("m"),
                    "\"lamp_i\" \"square_i\"");
    scene.indirect = false;
    return scene.pixel(5, 3, 256);
  };
  const Rgb own = lit("\"lamb\" ( \"c\" .8 .4 .2, \"lights\" [\"lamp_i\"] )");
  const Rgb built_in =
      lit("\"mib_illum_lambert\" ( \"ambience\" 0 0 0, \"diffuse\" .8 .4 .2, \"mode\" 1, "
          "\"lights\" [\"lamp_i\"] )");
  EXPECT_GT(own.x, .1f);
  expect_near(own, built_in, 2e-3f);
}

TEST(UserShaders, TexturesAndBuiltInShadersReadEachOther) {
  ShaderFolder folder;
  folder.compile("t", std::string(kHead) +
                          "struct twice { miColor c; };"
                          "DLLEXPORT miBoolean twice(miColor *r, miState *state, struct twice *p) {"
                          "  miColor *c = mi_eval_color(&p->c);"
                          "  r->r = 2 * c->r; r->g = 2 * c->g; r->b = 2 * c->b; r->a = 1;"
                          "  return miTRUE; }");
  // Built-in under user's under built-in.
  UserScene scene(folder,
                  "link \"t.so\" declare shader color \"twice\" ( color \"c\" ) apply texture end "
                  "declare shader \"inner\" \"mib_color_mix\" ( \"num\" 0, \"color_base\" .1 .2 .3 "
                  "1 ) shader \"outer\" \"twice\" ( \"c\" = \"inner\" ) "
                  "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" = "
                  "\"outer\", \"diffuse\" 0 0 0 ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  expect_near(scene.pixel(4, 4), Rgb(.2f, .4f, .6f), 1e-5f);
}

TEST(UserShaders, AreaLightsOfKindUserShineFromWhereTheirShadersPutThem) {
  // A square of side 2 at (0, 0, 3): samples that the shader places, against a rectangle's.
  ShaderFolder folder;
  folder.compile("panel",
                 std::string(kHead) +
                     "struct panel { miBoolean place; };"
                     "DLLEXPORT miBoolean panel(miColor *r, miState *state, struct panel *p) {"
                     "  miVector way; miScalar d;"
                     "  if (*mi_eval_boolean(&p->place)) { miTag light; int area; miVector o;"
                     "    mi_query(miQ_INST_ITEM, state, state->light_instance, &light);"
                     "    mi_query(miQ_LIGHT_AREA, state, light, &area);"
                     "    if (area != miLIGHT_USER) return miFALSE;"
                     "    mi_query(miQ_LIGHT_ORIGIN, state, light, &o);"
                     "    o.x += 2 * mi_random() - 1; o.y += 2 * mi_random() - 1;"
                     "    mi_point_from_light(state, &state->org, &o);"
                     "    mi_vector_sub(&state->dir, &state->point, &state->org);"
                     "    state->dist = mi_vector_norm(&state->dir);"
                     "    mi_vector_normalize(&state->dir); }"
                     "  mi_vector_sub(&way, &state->point, &state->org); d = mi_vector_norm(&way);"
                     "  r->r = r->g = r->b = 9 * -way.z / (d * d * d); r->a = 1;"
                     "  return mi_trace_shadow(r, state); }");
  const auto lit = [&](const std::string& place, const std::string& area) {
    UserScene scene(
        folder,
        "link \"panel.so\" declare shader \"panel\" ( boolean \"place\" ) apply light end declare "
        "light \"lamp\" \"panel\" ( \"place\" " +
            place + " ) origin 0 0 3 " + area +
            " end light instance \"lamp_i\" \"lamp\" end instance "
            "material \"m\" \"mib_illum_lambert\" ( \"diffuse\" .8 .8 .8, \"ambience\" 0 0 0, "
            "\"mode\" 4 ) end material material \"black\" \"mib_illum_lambert\" ( ) end material "
            "object \"blocker\" shadow trace group -1 -1 1 1 -1 1 1 1 1 -1 1 1 v 0 v 1 v 2 v 3 "
            "c 0 1 2 3 end group end object instance \"blocker_i\" \"blocker\" material \"black\" "
            "end instance " +
            UserScene::square("m"),
        "\"lamp_i\" \"blocker_i\" \"square_i\"");
    scene.indirect = false;
    std::array<float, 4> row;
    for (int i = 0; i < 4; ++i) row[static_cast<std::size_t>(i)] = scene.pixel(4 + i, 4, 4096).x;
    EXPECT_EQ(scene.messages(), "");
    return row;
  };
  const auto user = lit("on", "user 4 4"), rectangle = lit("off", "rectangle 2 0 0 0 -2 0");
  for (std::size_t i = 0; i < user.size(); ++i)
    EXPECT_NEAR(user[i], rectangle[i], .03f * rectangle[3]) << i;  // about 4 standard errors
  EXPECT_LT(user[0], .1f * user[3]);                               // the blocker's shadow
}

// acceptance: I3
TEST(UserShaders, LightsShineWithTheirOwnShadersAndCastShadows) {
  ShaderFolder folder;
  folder.compile("l", std::string(kHead) +
                          "struct lum { miColor c; };"
                          "DLLEXPORT miBoolean lum(miColor *r, miState *state, struct lum *p) {"
                          "  *r = *mi_eval_color(&p->c);"
                          "  if (state->type != miRAY_LIGHT) return miTRUE;"
                          "  return mi_trace_shadow(r, state); }");
  const auto lit = [&](const std::string& light) {
    UserScene scene(
        folder,
        "link \"l.so\" declare shader color \"lum\" ( color \"c\" ) apply light end declare "
        "light \"lamp\" " +
            light +
            " origin 0 0 3 end light instance \"lamp_i\" \"lamp\" end instance "
            "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 0 0 0, \"diffuse\" 1 1 1, "
            "\"mode\" 1, \"lights\" [\"lamp_i\"] ) end material "
            "object \"wall\" visible shadow trace group 0 -8 2 8 -8 2 8 8 2 0 8 2 v 0 v 1 v 2 v 3 "
            "c 0 1 2 3 end group end object instance \"wall_i\" \"wall\" visible off shadow on "
            "material \"m\" end instance " +
            UserScene::square("m"),
        "\"lamp_i\" \"square_i\" \"wall_i\"");
    scene.indirect = false;
    return std::pair(scene.pixel(1, 4, 64), scene.pixel(6, 4, 64));
  };
  const auto own = lit("\"lum\" ( \"c\" .5 1 2 )");
  const auto built_in = lit("\"mib_light_point\" ( \"color\" .5 1 2, \"shadow\" on )");
  EXPECT_GT(own.first.y, .05f);
  expect_near(own.first, built_in.first, 1e-3f);
  expect_near(own.second, Rgb(0), 1e-6f);
}

TEST(UserShaders, ShadowShadersTintTheLight) {
  ShaderFolder folder;
  folder.compile("s", std::string(kHead) +
                          "struct tint { miColor c; };"
                          "DLLEXPORT miBoolean tint(miColor *r, miState *state, struct tint *p) {"
                          "  miColor c = *mi_eval_color(&p->c);"
                          "  r->r *= c.r; r->g *= c.g; r->b *= c.b;"
                          "  return r->r + r->g + r->b > 0; }");
  UserScene scene(folder,
                  "link \"s.so\" declare shader color \"tint\" ( color \"c\" ) apply shadow end "
                  "declare " +
                      kLamp +
                      "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 0 0 0, \"diffuse\" 1 1 "
                      "1, \"mode\" 1, \"lights\" [\"lamp_i\"] ) end material "
                      "material \"glass\" \"mib_illum_lambert\" ( ) shadow \"tint\" ( \"c\" 1 .5 "
                      ".25 ) end material "
                      "object \"wall\" visible shadow trace group -8 -8 2 8 -8 2 8 8 2 -8 8 2 v 0 "
                      "v 1 v 2 v 3 c 0 1 2 3 end group end object instance \"wall_i\" \"wall\" "
                      "visible off shadow on material \"glass\" end instance " +
                      UserScene::square("m"),
                  "\"lamp_i\" \"square_i\" \"wall_i\"");
  scene.indirect = false;
  const Rgb seen = scene.pixel(4, 4, 64);
  EXPECT_GT(seen.x, .3f);
  EXPECT_NEAR(seen.y / seen.x, .5f, 1e-4f);
  EXPECT_NEAR(seen.z / seen.x, .25f, 1e-4f);
}

TEST(UserShaders, RaysOfMaterialsFindSurfacesAndTheEnvironment) {
  ShaderFolder folder;
  folder.compile("r",
                 std::string(kHead) +
                     "struct mirror { miScalar level; };"
                     "DLLEXPORT miBoolean mirror(miColor *r, miState *state, struct mirror *p)"
                     "{ miVector d; mi_reflection_dir(&d, state);"
                     "  if (!mi_trace_reflection(r, state, &d))"
                     "    mi_trace_environment(r, state, &d);"
                     "  if (state->child && state->child->type != miRAY_REFLECT) return miFALSE;"
                     "  r->r *= p->level; r->g *= p->level; r->b *= p->level;"
                     "  return miTRUE; }"
                     "DLLEXPORT miBoolean sky(miColor *r, miState *state, void *p) {"
                     "  r->r = state->type == miRAY_REFLECT; r->g = state->dir.z; r->b = 1;"
                     "  r->a = 1; return miTRUE; }");
  UserScene scene(folder,
                  "link \"r.so\" declare shader color \"mirror\" ( scalar \"level\" ) apply "
                  "material end declare declare shader color \"sky\" ( ) apply environment end "
                  "declare material \"m\" \"mirror\" ( \"level\" .5 ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"", "", "environment \"sky\" ( )");
  // Directly above the mirror the reflected ray is vertical.
  const Rgb seen = scene.pixel(4, 4, 256);
  EXPECT_NEAR(seen.x, .5f, 1e-5f);
  EXPECT_NEAR(seen.y, .5f, .02f);
  EXPECT_NEAR(seen.z, .5f, 1e-5f);
}

TEST(UserShaders, IrradianceIsThatOfTheSky) {
  ShaderFolder folder;
  folder.compile("i", std::string(kHead) +
                          "DLLEXPORT miBoolean gather(miColor *r, miState *state, void *p) {"
                          "  mi_compute_irradiance(r, state); r->a = 1; return miTRUE; }");
  UserScene scene(folder,
                  "link \"i.so\" declare shader color \"gather\" ( ) apply material end declare "
                  "material \"m\" \"gather\" ( ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"", "",
                  "environment \"mib_color_mix\" ( \"num\" 0, \"color_base\" .25 .5 1 1 )");
  expect_near(scene.pixel(4, 4, 64), Rgb(.25f, .5f, 1) * kPi, 1e-4f);
}

TEST(UserShaders, LensesMakeTheColourOfSeveralRays) {
  ShaderFolder folder;
  folder.compile("e", std::string(kHead) +
                          "DLLEXPORT miBoolean both(miColor *r, miState *state, void *p) {"
                          "  miColor a, b; miVector up = {0, 0, 1}, o = state->org, d = state->dir;"
                          "  mi_trace_eye(&a, state, &o, &d); mi_trace_eye(&b, state, &o, &up);"
                          "  r->r = a.r; r->g = b.g; r->b = a.b + b.b; r->a = 1; return miTRUE; }");
  UserScene scene(folder,
                  "link \"e.so\" declare shader color \"both\" ( ) apply lens end declare "
                  "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" .25 .5 "
                  ".75, \"diffuse\" 0 0 0 ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"", "",
                  "lens \"both\" ( ) environment \"mib_color_mix\" ( \"num\" 0, \"color_base\" "
                  ".1 .2 .3 1 )");
  expect_near(scene.pixel(4, 4), Rgb(.25f, .2f, 1.05f), 1e-5f);
}

TEST(UserShaders, VolumesDimAndAddAsTheyAreWritten) {
  ShaderFolder folder;
  folder.compile("v", std::string(kHead) +
                          "DLLEXPORT miBoolean fog(miColor *r, miState *state, void *p) {"
                          "  float kept = exp(-.1 * state->dist);"
                          "  if (state->dist <= 0) return miTRUE;"
                          "  r->r = r->r * kept + (1 - kept); r->g *= kept; r->b *= kept;"
                          "  return miTRUE; }");
  UserScene scene(folder,
                  "link \"v.so\" declare shader color \"fog\" ( ) apply volume end declare "
                  "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" .5 .5 "
                  ".5, \"diffuse\" 0 0 0 ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"", "", "volume \"fog\" ( )");
  const float kept = std::exp(-.4f);
  const Rgb seen = scene.pixel(4, 4, 256);
  EXPECT_NEAR(seen.y, .5f * kept, .005f);
  EXPECT_NEAR(seen.x, .5f * kept + 1 - kept, .005f);
}

TEST(UserShaders, VolumesDimTheLightOfFiniteLights) {
  ShaderFolder folder;
  folder.compile("v", std::string(kHead) +
                          "DLLEXPORT miBoolean fog(miColor *r, miState *state, void *p) {"
                          "  float kept = exp(-.2 * state->dist);"
                          "  if (state->type != miRAY_LIGHT || state->dist <= 0) return miTRUE;"
                          "  if (state->org.z < 1.9 || state->dir.z > -.8) return miTRUE;"
                          "  r->r *= kept; r->g *= kept * kept; r->b += 9; return miTRUE; }");
  const auto seen = [&](const std::string& camera) {
    UserScene scene(
        folder,
        "link \"v.so\" declare shader color \"fog\" ( ) apply volume end declare "
        "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 2 end light "
        "instance \"lamp_i\" \"lamp\" end instance "
        "material \"m\" \"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5, \"mode\" 4 ) end material " +
            UserScene::square("m"),
        "\"lamp_i\" \"square_i\"", "", camera);
    return scene.pixel(4, 4, 64);
  };
  const Rgb clear = seen(""), foggy = seen("volume \"fog\" ( )");
  ASSERT_GT(clear.x, .01f);
  // Over the square unit of ground in the pixel, with a corner below the light.
  double all = 0, once = 0, twice = 0;
  for (double x = .005; x < 1; x += .01)
    for (double y = .005; y < 1; y += .01) {
      const double d = std::sqrt(x * x + y * y + 4), kept = std::exp(-.2 * d);
      all += 2 / d, once += 2 / d * kept, twice += 2 / d * kept * kept;
    }
  EXPECT_NEAR(foggy.x / clear.x, once / all, .003);
  EXPECT_NEAR(foggy.y / clear.y, twice / all, .003);
  EXPECT_NEAR(foggy.z, clear.z, 1e-5f);  // light added by the volume is excluded
}

TEST(UserShaders, VolumesAreCalledForRaysThatMiss) {
  ShaderFolder folder;
  folder.compile("v", std::string(kHead) +
                          "DLLEXPORT miBoolean far(miColor *r, miState *state, void *p) {"
                          "  if (state->type != miRAY_EYE) return miTRUE;"
                          "  if (state->dist != 0 || state->pri || state->material) return miTRUE;"
                          "  r->r *= .5; r->g = .25; r->b = .5 * r->b + .125; return miTRUE; }");
  UserScene scene(
      folder, "link \"v.so\" declare shader color \"far\" ( ) apply volume end declare ", "", "",
      "environment \"mib_color_mix\" ( \"num\" 0, \"color_base\" .5 .5 .5 1 ) "
      "volume \"far\" ( )");
  expect_near(scene.pixel(4, 4), Rgb(.25f, .25f, .375f), 1e-4f);
}

TEST(UserShaders, DisplacementMovesTheSurface) {
  ShaderFolder folder;
  folder.compile("d", std::string(kHead) +
                          "DLLEXPORT miBoolean lift(miScalar *r, miState *state, void *p) {"
                          "  *r += 1.5; return miTRUE; }"
                          "DLLEXPORT miBoolean height(miColor *r, miState *state, void *p) {"
                          "  r->r = r->g = r->b = state->point.z; r->a = 1; return miTRUE; }");
  UserScene scene(folder,
                  "link \"d.so\" declare shader scalar \"lift\" ( ) apply displace end declare "
                  "declare shader color \"height\" ( ) apply material end declare "
                  "material \"m\" \"height\" ( ) displace \"lift\" ( ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"", "max displace 2");
  expect_near(scene.pixel(4, 4), Rgb(1.5f), 1e-4f);
}

TEST(UserShaders, GeometryShadersMakeObjects) {
  ShaderFolder folder;
  folder.compile("g",
                 "#include <shader.h>\n#include <geoshader.h>\n"
                 "struct plate { miScalar z; };"
                 "DLLEXPORT miBoolean plate(miTag *result, miState *state, struct plate *p) {"
                 "  miScalar z = *mi_eval_scalar(&p->z); int i;"
                 "  miVector v[4] = {{-8,-8,0},{8,-8,0},{8,8,0},{-8,8,0}};"
                 "  miObject *o = mi_api_object_begin(mi_mem_strdup(\"plate\"));"
                 "  o->visible = miTRUE; mi_api_basis_list_clear(); mi_api_object_group_begin(0.0);"
                 "  for (i = 0; i < 4; i++) { v[i].z = z; mi_api_vector_xyz_add(&v[i]); }"
                 "  for (i = 0; i < 4; i++) mi_api_vertex_add(i);"
                 "  mi_api_poly_begin_tag(1, miNULLTAG);"
                 "  for (i = 0; i < 4; i++) mi_api_poly_index_add(i);"
                 "  mi_api_poly_end(); mi_api_object_group_end();"
                 "  return mi_geoshader_add_result(result, mi_api_object_end()); }"
                 "DLLEXPORT miBoolean height(miColor *r, miState *state, void *p) {"
                 "  r->r = r->g = r->b = state->point.z; r->a = 1; return miTRUE; }");
  UserScene scene(folder,
                  "link \"g.so\" declare shader geometry \"plate\" ( scalar \"z\" ) apply geometry "
                  "end declare declare shader color \"height\" ( ) apply material end declare "
                  "material \"m\" \"height\" ( ) end material "
                  "instance \"made\" geometry \"plate\" ( \"z\" 2.5 ) material \"m\" end instance ",
                  "\"made\"");
  expect_near(scene.pixel(4, 4), Rgb(2.5f), 1e-4f);
}

}  // namespace kinds_test
}  // namespace oriel
