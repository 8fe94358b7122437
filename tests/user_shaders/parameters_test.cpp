// SPDX-License-Identifier: Apache-2.0
// Parameters of user shaders in all declarable forms: arrays, structs, defaults.
#include "user_scene.h"

namespace oriel {
namespace parameters_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

/// Sum over the layers of weight times colour; in blue, the lengths of the names.
const char* const kLayers =
    "#include <shader.h>\n#include <string.h>\n"
    "struct layer { miColor colour; struct { miScalar weight; miTag name; } how; };"
    "struct layers { miScalar first; int i_layers; int n_layers; struct layer layers[1];"
    "                miScalar last; };"
    "DLLEXPORT miBoolean layers(miColor *r, miState *state, struct layers *p) {"
    "  int i, at = *mi_eval_integer(&p->i_layers), n = *mi_eval_integer(&p->n_layers);"
    "  r->r = *mi_eval_scalar(&p->first); r->g = *mi_eval_scalar(&p->last); r->b = 0; r->a = 1;"
    "  for (i = at; i < at + n; i++) {"
    "    miColor *c = mi_eval_color(&p->layers[i].colour);"
    "    miScalar w = *mi_eval_scalar(&p->layers[i].how.weight);"
    "    miTag t = *mi_eval_tag(&p->layers[i].how.name);"
    "    r->r += w * c->r; r->g += w * c->g;"
    "    if (t) { r->b += strlen((char*)mi_db_access(t)); mi_db_unpin(t); } }"
    "  return miTRUE; }";

const std::string kDeclaration =
    "link \"p.so\" declare shader color \"layers\" ( scalar \"first\" default 1, array struct "
    "\"layers\" { color \"colour\", struct \"how\" { scalar \"weight\" default 2, string \"name\" "
    "default \"abc\" } }, scalar \"last\" ) apply material end declare ";

Rgb shown(const std::string& arguments, const std::string& more = "") {
  ShaderFolder folder;
  folder.compile("p", kLayers);
  UserScene scene(folder,
                  kDeclaration + more + "material \"m\" \"layers\" ( " + arguments +
                      " ) end material " + UserScene::square("m"),
                  "\"square_i\"");
  EXPECT_EQ(scene.messages(), "");
  return scene.pixel(4, 4, 1);
}

TEST(UserParameters, ArraysOfStructsReachTheShaderWithDefaultsOfTheirMembers) {
  expect_near(shown("\"last\" 7"), Rgb(1, 7, 0), 1e-6f);
  expect_near(shown("\"first\" 0, \"last\" 0, \"layers\" [ { \"colour\" 1 2 3 }, { \"colour\" 10 "
                    "20 30, \"how\" { \"weight\" .5, \"name\" \"x\" } } ]"),
              Rgb(2 + 5, 4 + 10, 3 + 1), 1e-5f);
}

TEST(UserParameters, MembersOfElementsMayBeConnected) {
  const std::string shader =
      "shader \"tone\" \"mib_color_mix\" ( \"num\" 0, \"color_base\" .25 .5 0 1 ) ";
  expect_near(shown("\"first\" 0, \"layers\" [ { \"colour\" 1 1 1, \"how\" { \"name\" \"\" } }, { "
                    "\"colour\" = \"tone\", \"how\" { \"weight\" 4, \"name\" \"\" } } ]",
                    shader),
              Rgb(2 + 1, 2 + 2, 0), 1e-5f);
}

TEST(UserParameters, ElementsOfPlainArraysMayBeConnected) {
  ShaderFolder folder;
  folder.compile("p",
                 "#include <shader.h>\n"
                 "struct mean { int i_c; int n_c; miColor c[1]; };"
                 "DLLEXPORT miBoolean mean(miColor *r, miState *state, struct mean *p) {"
                 "  int i, at = *mi_eval_integer(&p->i_c), n = *mi_eval_integer(&p->n_c);"
                 "  r->r = r->g = r->b = 0; r->a = 1;"
                 "  for (i = 0; i < n; i++) { miColor *c = mi_eval_color(p->c + at + i);"
                 "    r->r += c->r / n; r->g += c->g / n; r->b += c->b / n; }"
                 "  return miTRUE; }");
  UserScene scene(folder,
                  "link \"p.so\" declare shader color \"mean\" ( array color \"c\" ) apply "
                  "material end declare shader \"tone\" \"mib_color_mix\" ( \"num\" 0, "
                  "\"color_base\" 0 0 8 1 ) material \"m\" \"mean\" ( \"c\" [ 4 0 0, = \"tone\", "
                  "0 4 0, 0 0 0 ] ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  EXPECT_EQ(scene.messages(), "");
  expect_near(scene.pixel(4, 4, 1), Rgb(1, 1, 2), 1e-6f);
}

TEST(UserParameters, MoreThanAKilobyteOfParametersArrive) {
  ShaderFolder folder;
  folder.compile("p",
                 "#include <shader.h>\n"
                 "struct big { miMatrix m[40]; miScalar last; };"
                 "DLLEXPORT miBoolean big(miColor *r, miState *state, struct big *p) {"
                 "  r->r = mi_eval_transform(&p->m[39])[12]; r->g = *mi_eval_scalar(&p->last);"
                 "  r->b = 0; r->a = 1; return miTRUE; }");
  std::string parameters;
  for (int i = 0; i < 40; ++i) parameters += "transform \"m" + std::to_string(i) + "\", ";
  UserScene scene(folder,
                  "link \"p.so\" declare shader color \"big\" ( " + parameters +
                      "scalar \"last\" ) apply material end declare material \"m\" \"big\" ( "
                      "\"m39\" 1 0 0 0 0 1 0 0 0 0 1 0 3 4 5 1, \"last\" 6 ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  EXPECT_EQ(scene.messages(), "");
  expect_near(scene.pixel(4, 4, 1), Rgb(3, 6, 0), 1e-6f);
}

TEST(UserParameters, AResultTooLargeForTheStackMakesTheShaderUnknown) {
  ShaderFolder folder;
  folder.compile("p",
                 "#include <shader.h>\n"
                 "DLLEXPORT miBoolean wide(void *r, miState *state, void *p) { return miTRUE; }");
  std::string results;
  for (int i = 0; i < 30; ++i)
    results += (i ? ", " : "") + ("transform \"m" + std::to_string(i) + "\"");
  UserScene scene(folder,
                  "link \"p.so\" declare shader struct { " + results +
                      " } \"wide\" ( ) apply material end declare material \"m\" \"wide\" ( ) end "
                      "material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  EXPECT_NE(scene.messages().find("OR-SDK-011"), std::string::npos) << scene.messages();
}

TEST(UserParameters, DeclarationIsAvailableAsText) {
  ShaderFolder folder;
  folder.compile("p",
                 "#include <shader.h>\n#include <string.h>\n"
                 "DLLEXPORT miBoolean told(miColor *r, miState *state, void *p) {"
                 "  char *text = 0; miTag t = state->shader->function_decl;"
                 "  r->r = r->g = r->b = 0; r->a = 1;"
                 "  if (mi_query(miQ_DECL_PARAM, state, t, (void*)&text) && text)"
                 "    r->r = !strcmp(text, \"color \\\"c\\\", array scalar \\\"s\\\", struct "
                 "\\\"pair\\\" { integer \\\"a\\\", boolean \\\"b\\\" }\");"
                 "  return miTRUE; }");
  UserScene scene(folder,
                  "link \"p.so\" declare shader color \"told\" ( color \"c\", array scalar \"s\", "
                  "struct \"pair\" { integer \"a\", boolean \"b\" } ) apply material end declare "
                  "material \"m\" \"told\" ( ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  expect_near(scene.pixel(4, 4, 1), Rgb(1, 0, 0), 0);
}

}  // namespace parameters_test
}  // namespace oriel
