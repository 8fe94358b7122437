// SPDX-License-Identifier: Apache-2.0
// Shaders that geometry shaders declare, call and connect; queries of calls by other shaders.
#include "user_scene.h"

namespace oriel::testing {
namespace declarations_test {

/// Geometry shader "make": `body` makes a material "shown", in which a square is seen.
std::string maker(const std::string& functions, const std::string& body) {
  return "#include <shader.h>\n#include <geoshader.h>\n"
         "static char *t(const char *s) { return mi_mem_strdup(s); }" +
         functions +
         "DLLEXPORT miBoolean make(miTag *result, miState *state, void *paras) {"
         "  static const miVector v[4] = {{-8,-8,0},{8,-8,0},{8,8,0},{-8,8,0}}; int i;"
         "  miInstance *in; miMaterial *m; miTag shader = 0, o; {" +
         body +
         "} m = mi_api_material_begin(t(\"shown\")); m->shader = shader; mi_api_material_end();"
         "  mi_api_object_begin(t(\"plate\")); mi_api_object_group_begin(0.0);"
         "  for (i = 0; i < 4; i++) mi_api_vector_xyz_add(&v[i]);"
         "  for (i = 0; i < 4; i++) mi_api_vertex_add(i);"
         "  mi_api_poly_begin_tag(1, 0); for (i = 0; i < 4; i++) mi_api_poly_index_add(i);"
         "  mi_api_poly_end(); mi_api_object_group_end(); mi_api_object_end();"
         "  in = mi_api_instance_begin(t(\"plate_i\"));"
         "  in->material = mi_api_name_lookup(t(\"shown\"));"
         "  o = mi_api_instance_end(t(\"plate\"), 0, 0);"
         "  return mi_geoshader_add_result(result, o); }";
}

constexpr const char* kScene =
    "link \"g.so\" declare shader geometry \"make\" ( ) apply geometry end declare "
    "instance \"made\" geometry \"make\" ( ) end instance ";

constexpr const char* kPaint =
    "struct paint { miColor tint; miScalar factor; };"
    "DLLEXPORT int paint_version(void) { return 3; }"
    "DLLEXPORT miBoolean paint(miColor *r, miState *state, struct paint *p) {"
    "  miColor c = *mi_eval_color(&p->tint); miScalar f = *mi_eval_scalar(&p->factor);"
    "  r->r = f * c.r; r->g = f * c.g; r->b = f * c.b; r->a = 1; return miTRUE; }";

constexpr const char* kDeclarePaint =
    "miParameter *list; miFunction_decl *d; miScalar two = 2;"
    "list = mi_api_parameter_decl(miTYPE_COLOR, t(\"tint\"), NULL);"
    "list = mi_api_parameter_append(list, mi_api_parameter_decl(miTYPE_SCALAR, t(\"factor\"), "
    "NULL));"
    "mi_api_parameter_default(miTYPE_SCALAR, &two);"
    "d = mi_api_funcdecl_begin(mi_api_parameter_decl(miTYPE_COLOR, NULL, NULL), t(\"paint\"), "
    "list); d->version = 3; mi_api_funcdecl_end();";

TEST(Declarations, AShaderDeclaredByAShaderIsCalled) {
  ShaderFolder folder;
  folder.compile("g", maker(kPaint, std::string(kDeclarePaint) +
                                        "miScalar c[4] = {.1f, .2f, .3f, 1};"
                                        "mi_api_function_call(t(\"paint\"));"
                                        "mi_api_parameter_name(t(\"tint\"));"
                                        "for (i = 0; i < 4; i++)"
                                        "  mi_api_parameter_value(miTYPE_SCALAR, &c[i], 0, 0);"
                                        "shader = mi_api_function_call_end(0);"));
  UserScene scene(folder, kScene, "\"made\"");
  expect_near(scene.pixel(4, 4), Rgb(.2f, .4f, .6f), 1e-4f);
  EXPECT_EQ(scene.messages(), "");
}

TEST(Declarations, AVersionOtherThanTheLibrarysIsReported) {
  ShaderFolder folder;
  std::string other = kDeclarePaint;
  other.replace(other.find("version = 3"), 11, "version = 4");
  folder.compile("g", maker(kPaint, other + "mi_api_function_call(t(\"paint\"));"
                                            "shader = mi_api_function_call_end(0);"));
  UserScene scene(folder, kScene, "\"made\"");
  EXPECT_NE(scene.messages().find("OR-SDK-004"), std::string::npos) << scene.messages();
}

TEST(Declarations, TheScenesOwnDeclarationStays) {
  ShaderFolder folder;
  folder.compile(
      "g", maker(kPaint, std::string(kDeclarePaint) + "mi_api_function_call(t(\"paint\"));"
                                                      "shader = mi_api_function_call_end(0);"));
  UserScene scene(folder,
                  std::string(kScene) +
                      "declare shader color \"paint\" ( color \"tint\" default 1 "
                      "1 1, scalar \"factor\" default .5 ) end declare ",
                  "\"made\"");
  expect_near(scene.pixel(4, 4), Rgb(.5f), 1e-4f);
  EXPECT_EQ(scene.messages(), "");
}

TEST(Declarations, ANamedShaderIsConnected) {
  ShaderFolder folder;
  folder.compile("g", maker(kPaint, std::string(kDeclarePaint) +
                                        "miColor c = {.5f, .25f, 0, 1}; miScalar one = 1;"
                                        "mi_api_function_call(t(\"paint\"));"
                                        "mi_api_parameter_name(t(\"tint\"));"
                                        "mi_api_parameter_value(miTYPE_COLOR, &c, 0, 0);"
                                        "mi_api_shader_add(t(\"inner\"), "
                                        "mi_api_function_call_end(0));"
                                        "mi_api_function_call(t(\"paint\"));"
                                        "mi_api_parameter_name(t(\"factor\"));"
                                        "mi_api_parameter_value(miTYPE_SCALAR, &one, 0, 0);"
                                        "mi_api_parameter_name(t(\"tint\"));"
                                        "mi_api_parameter_shader(t(\"inner\"));"
                                        "shader = mi_api_function_call_end(0);"));
  UserScene scene(folder, kScene, "\"made\"");
  expect_near(scene.pixel(4, 4), Rgb(1, .5f, 0), 1e-4f);
}

// Both calls run: the second sees what the first left.
TEST(Declarations, ChainedCallsAllRun) {
  ShaderFolder folder;
  folder.compile("g",
                 maker("DLLEXPORT miBoolean first(miColor *r, miState *state, void *p) {"
                       "  state->tex.x = 7; r->r = r->g = r->b = .25f; r->a = 1; return miTRUE; }"
                       "DLLEXPORT miBoolean more(miColor *r, miState *state, void *p) {"
                       "  r->r = r->r + .5f; return miTRUE; }",
                       "mi_api_function_call(t(\"first\")); shader = mi_api_function_call_end(0);"
                       "mi_api_function_call(t(\"more\"));"
                       "shader = mi_api_function_append(shader, mi_api_function_call_end(0));"));
  UserScene scene(folder,
                  std::string(kScene) +
                      "declare shader color \"first\" ( ) apply material end "
                      "declare declare shader color \"more\" ( ) apply material "
                      "end declare ",
                  "\"made\"");
  const Rgb chained = scene.pixel(4, 4);
  // The same list written in the scene.
  UserScene written(folder,
                    "link \"g.so\" declare shader color \"first\" ( ) apply material end declare "
                    "declare shader color \"more\" ( ) apply material end declare "
                    "material \"m\" \"first\" ( ) \"more\" ( ) end material " +
                        UserScene::square("m"),
                    "\"square_i\"");
  expect_near(chained, written.pixel(4, 4), 1e-4f);
  EXPECT_GT(chained.x, .4f);
}

/// A shader that reads a parameter of the shader its own parameter names.
constexpr const char* kReader =
    "#include <shader.h>\n#include <geoshader.h>\n"
    "struct target { miScalar first; miVector axis; int i_list; int n_list; miColor list[1]; };"
    "DLLEXPORT miBoolean target(miColor *r, miState *state, struct target *p) { return miTRUE; }"
    "struct reader { miTag other; };"
    "DLLEXPORT miBoolean reader(miColor *r, miState *state, struct reader *p) {"
    "  miTag decl = 0, other = *mi_eval_tag(&p->other); char *block = NULL;"
    "  miParam_type type = miTYPE_INVALID; miBoolean is_array = miTRUE; int offs = -1, list;"
    "  r->r = r->g = r->b = 0; r->a = 1;"
    "  if (!mi_query(miQ_FUNC_DECL, NULL, other, &decl)) return miTRUE;"
    "  if (!mi_query(miQ_FUNC_PARAM, NULL, other, &block)) return miTRUE;"
    "  if (mi_api_parameter_lookup(&type, &is_array, &offs, decl, miFALSE, \"none\") || offs != -1)"
    "    return miTRUE;"
    "  if (mi_api_parameter_lookup(&type, &is_array, &offs, decl, miFALSE, \"axis\") &&"
    "      type == miTYPE_VECTOR && !is_array) r->r = ((miScalar*)(block + offs))[2];"
    "  if (mi_api_parameter_lookup(&type, &is_array, &offs, decl, miFALSE, \"list\") &&"
    "      type == miTYPE_COLOR && is_array) {"
    "    list = ((int*)(block + offs))[0];"
    "    r->g = ((miColor*)(block + offs + 8))[list + 1].b; }"
    "  if (mi_api_parameter_lookup(&type, &is_array, &offs, decl, miTRUE, \"depth\") &&"
    "      type == miTYPE_SCALAR && offs == 16) r->b = 1;"
    "  return miTRUE; }";

TEST(Declarations, ParametersOfACallAreFoundByName) {
  ShaderFolder folder;
  folder.compile("g", kReader);
  UserScene scene(
      folder,
      "link \"g.so\" declare shader struct { color \"main\", scalar \"depth\" } \"target\" "
      "( scalar \"first\", vector \"axis\", array color \"list\" ) end declare "
      "declare shader color \"reader\" ( shader \"other\" ) apply material end declare "
      "shader \"t\" \"target\" ( \"axis\" 0 0 .75, \"list\" [ 1 1 1, 0 0 .5 ] ) "
      "material \"m\" \"reader\" ( \"other\" \"t\" ) end material " +
          UserScene::square("m"),
      "\"square_i\"");
  expect_near(scene.pixel(4, 4), Rgb(.75f, .5f, 1), 1e-4f);
}

// acceptance of old sources: a parameter without a connection takes the surface's coordinate.
TEST(Connections, DistinguishConnectionsFromValues) {
  ShaderFolder folder;
  folder.compile("g",
                 "#include <shader.h>\n"
                 "struct told { miVector uv; miScalar other; };"
                 "DLLEXPORT miBoolean told(miColor *r, miState *state, struct told *p) {"
                 "  miBoolean any = mi_has_connections(state);"
                 "  miBoolean uv = any && !mi_is_nonshader_tag(mi_get_ghost(state, &p->uv));"
                 "  r->r = any; r->g = uv; r->b = uv ? mi_eval_vector(&p->uv)->x : .5f;"
                 "  r->a = 1; return miTRUE; }"
                 "DLLEXPORT miBoolean giver(miVector *r, miState *state, void *p) {"
                 "  r->x = .25f; r->y = r->z = 0; return miTRUE; }");
  const std::string head =
      "link \"g.so\" declare shader color \"told\" ( vector \"uv\", scalar \"other\" ) apply "
      "material end declare declare shader vector \"giver\" ( ) apply texture end declare "
      "shader \"g\" \"giver\" ( ) ";
  const auto shown = [&](const std::string& arguments) {
    UserScene scene(folder,
                    head + "material \"m\" \"told\" ( " + arguments + " ) end material " +
                        UserScene::square("m"),
                    "\"square_i\"");
    return scene.pixel(4, 4);
  };
  expect_near(shown("\"uv\" 1 2 3"), Rgb(0, 0, .5f), 1e-4f);
  expect_near(shown("\"uv\" = \"g\""), Rgb(1, 1, .25f), 1e-4f);
  expect_near(shown("\"uv\" 1 2 3, \"other\" = \"g\""), Rgb(1, 0, .5f), 1e-4f);
}

}  // namespace declarations_test
}  // namespace oriel::testing
