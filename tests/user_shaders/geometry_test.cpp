// SPDX-License-Identifier: Apache-2.0
// Elements made by geometry shaders equal those of a scene file.
#include "prepare/generated_geometry.h"
#include "scene/approximation.h"
#include "scene/element_settings.h"
#include "user_scene.h"

namespace oriel {
namespace geometry_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

const std::string kHead =
    "#include <shader.h>\n#include <geoshader.h>\n"
    "#define GEO(name) DLLEXPORT miBoolean name(miTag *result, miState *state, void *p)\n"
    "static miObject *open_named(const char *n) {"
    "  return mi_api_object_begin(n ? mi_mem_strdup(n) : NULL); }\n"
    "static void plate(double half, double z) {"
    "  miVector v[4]; int i; mi_api_basis_list_clear(); mi_api_object_group_begin(0.0);"
    "  for (i = 0; i < 4; i++) { v[i].x = (i == 1 || i == 2) ? half : -half;"
    "    v[i].y = i > 1 ? half : -half; v[i].z = z; mi_api_vector_xyz_add(&v[i]); }"
    "  for (i = 0; i < 4; i++) mi_api_vertex_add(i);"
    "  mi_api_poly_begin_tag(1, miNULLTAG);"
    "  for (i = 0; i < 4; i++) mi_api_poly_index_add(i);"
    "  mi_api_poly_end(); mi_api_object_group_end(); }\n"
    "DLLEXPORT miBoolean seen(miColor *r, miState *state, void *p) {"
    "  r->r = state->point.z; r->g = state->normal.x; r->b = state->tex_list ? "
    "state->tex_list[0].x : 0; r->a = 1; return miTRUE; }\n";

/// A scene with what the shader "make" of C source makes.
std::string made(const std::string& more = "") {
  return "link \"g.so\" declare shader geometry \"make\" ( ) apply geometry end declare declare "
         "shader color \"seen\" ( ) apply material end declare material \"m\" \"seen\" ( ) end "
         "material instance \"i\" geometry \"make\" ( ) material \"m\" end instance " +
         more;
}

/// The same with an object of scene text.
std::string written(const std::string& object) {
  return "link \"g.so\" declare shader color \"seen\" ( ) apply material end declare material "
         "\"m\" \"seen\" ( ) end material " +
         object + " instance \"i\" \"o\" material \"m\" end instance ";
}

/// Every pixel of both is the same, and some of it is seen.
void expect_same_picture(UserScene& a, UserScene& b) {
  int covered = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const Rgb one = a.pixel(x, y, 16);
      expect_near(one, b.pixel(x, y, 16), 1e-6f);
      covered += one != Rgb(0);
    }
  EXPECT_GT(covered, 8);
}

/// An object of the scene, or one that its geometry shaders make; empty when there is none.
scene::Object object_of(UserScene& scene, const std::string& name) {
  scene::Scene with_made = scene.scene;
  Diagnostics diagnostics;
  make_geometry(with_made, {}, scene.host->registry(), diagnostics);
  const auto* object = with_made.get<scene::Object>(name);
  return object ? *object : scene::Object();
}

const char* const kHairInText =
    "object \"o\" visible shadow trace hair radius .1 degree 3 hair t 2 vertex radius n scalar "
    "[ 58 ] "
    ".25 .5 -2 -1 0 .4 1 0 1  -1 2 0 .3 1 0 1  1 -2 1 .3 1 0 1  2 1 0 .1 1 0 1 "
    ".75 .5 -2 -2 1 .5 0 0 1  -1 -2 0 .5 0 0 1  1 -2 1 .4 0 0 1  2 -2 0 .2 0 0 1 "
    "hair [ 3 ] 0 30 58 end hair end object";

/// Two hairs of degree 3 with a texture each, radius and normal at each vertex.
std::string hair_source(const std::string& offsets, const std::string& approx) {
  return kHead +
         "static const float numbers[60] = {"
         ".25,.5, -2,-1,0,.4,1,0,1, -1,2,0,.3,1,0,1, 1,-2,1,.3,1,0,1, 2,1,0,.1,1,0,1,"
         ".75,.5, -2,-2,1,.5,0,0,1, -1,-2,0,.5,0,0,1, 1,-2,1,.4,0,0,1, 2,-2,0,.2,0,0,1};"
         "GEO(make) { miHair_list *h; miScalar *s; miGeoIndex *o; int i;"
         "  miApprox a; miObject *object = open_named(\"fur\");"
         "  if (!object) return miFALSE;"
         "  h = mi_api_hair_begin(); h->radius = .1; h->degree = 3; miAPPROX_DEFAULT(a);"
         "  a.cnst[miCNST_UPARAM] = 1;" +
         approx +
         "  mi_api_hair_info(0, 't', 2); mi_api_hair_info(1, 'r', 1); mi_api_hair_info(1, 'n', 3);"
         "  if (mi_api_hair_info(1, 'x', 3) || mi_api_hair_info(2, 't', 3)) return miFALSE;"
         "  s = mi_api_hair_scalars_begin(70); for (i = 0; i < 60; i++) *s++ = numbers[i];"
         "  if (mi_api_hair_scalars_end(71)) return miFALSE;"
         "  mi_api_hair_scalars_end(60);" +
         offsets +
         "  mi_api_hair_hairs_end(); mi_api_hair_end();"
         "  return mi_geoshader_add_result(result, mi_api_object_end()); }";
}

std::string hair_text() {
  std::string text = kHairInText;
  text.replace(text.find("58"), 2, "60");
  text.replace(text.find("0 30 58"), 7, "0 30 60");
  return text;
}

TEST(GeometryShaders, HairIsThatOfASceneFile) {
  for (const bool cpp : {false, true}) {
    ShaderFolder folder;
    std::string source =
        cpp ? hair_source(
                  "mi_api_hair_hairs_begin(9); o = NULL; "
                  "mi_api_hair_hairs_add(0); mi_api_hair_hairs_add(30); "
                  "mi_api_hair_hairs_add(60);",
                  "h->approx = a; if (h->approx != 1) return miFALSE;")
            : hair_source("o = mi_api_hair_hairs_begin(3); o[0] = 0; o[1] = 30; o[2] = 60;",
                          "h->approx = 1;");
    if (cpp) source.replace(source.find("static"), 0, "extern \"C\" {\n"), source += "}";
    folder.compile("g", source, cpp ? "cpp" : "c");
    UserScene shader(folder, made(), "\"i\"");
    UserScene text(folder, written(hair_text()), "\"i\"");
    const scene::Object fur = object_of(shader, "fur");
    ASSERT_EQ(fur.hairs.size(), 1u);
    scene::Hair expected = object_of(text, "o").hairs.at(0);
    expected.approximate = 1;
    expected.where = fur.hairs[0].where;
    EXPECT_EQ(fur.hairs[0], expected);
    expect_same_picture(shader, text);
    EXPECT_EQ(shader.messages(), "");
  }
}

TEST(GeometryShaders, HairBeyondItsScalarsIsDroppedWithAWarning) {
  ShaderFolder folder;
  folder.compile("g", hair_source("o = mi_api_hair_hairs_begin(3); o[0] = 0; o[1] = 30; o[2] = 61;",
                                  "h->approx = 1;"));
  UserScene shader(folder, made(), "\"i\"");
  EXPECT_EQ(object_of(shader, "fur").hairs.at(0).size(), 1u);
  EXPECT_NE(shader.messages().find("did not write"), std::string::npos) << shader.messages();
}

TEST(GeometryShaders, CallbacksMakeTheContentOfPlaceholdersAndKeepTheirFlags) {
  ShaderFolder folder;
  // The arguments are complete only when the shader returns; each callback makes another height.
  // The name "i" is taken in the scene: the second placeholder has another one.
  folder.compile(
      "g", kHead +
               "typedef struct { double half, z; const char *name; } Room;"
               "static Room rooms[3];"
               "static miBoolean fill(miTag tag, Room *room) { miObject *o;"
               "  mi_api_incremental(miTRUE); o = open_named(room->name);"
               "  if (!o || o->shadow) return miFALSE;"
               "  plate(room->half, room->z);"
               "  return mi_api_object_end() == tag; }"
               "GEO(make) { int i; miTag tag; static const char *names[3] = {\"a\", \"i\", 0};"
               "  for (i = 0; i < 3; i++) { miObject *o = open_named(names[i]);"
               "    o->shadow = miFALSE; o->bbox_max.x = 8;"
               "    mi_api_object_callback((miApi_object_callback)fill, &rooms[i]);"
               "    tag = mi_api_object_end(); o = (miObject *)mi_scene_edit(tag);"
               "    if (!o || o->type != miOBJECT_PLACEHOLDER || mi_db_type(tag) != miSCENE_OBJECT)"
               "      return miFALSE;"
               "    o->geo.placeholder_list.type = miOBJECT_HAIR; mi_scene_edit_end(tag);"
               "    mi_geoshader_add_result(result, tag); }"
               "  rooms[0].half = 8; rooms[0].name = \"a\"; rooms[1].half = 2; rooms[1].z = 1;"
               "  rooms[1].name = \"make:i\"; rooms[2].half = .5; rooms[2].z = 2;"
               "  return miTRUE; }");
  UserScene scene(folder, made(), "\"i\"");
  EXPECT_NEAR(scene.pixel(0, 4, 16).x, 0, 1e-5f);
  EXPECT_NEAR(scene.pixel(2, 4, 16).x, 1, 1e-5f);
  EXPECT_NEAR(scene.pixel(3, 4, 16).x, 2, 1e-5f);
  const scene::Object a = object_of(scene, "a");
  EXPECT_FALSE(resolve(settings_of(a).flags, {}).casts_shadow);
  EXPECT_EQ(object_of(scene, "make:a"), scene::Object());
}

TEST(GeometryShaders, PlaceholdersOfFilesHoldTheObjectOfTheFile) {
  ShaderFolder folder;
  std::ofstream(folder.file("plate.mi"))
      << "object \"any\" visible shadow trace group -8 -8 1.5 8 -8 1.5 8 8 1.5 -8 8 1.5 v 0 v 1 v "
         "2 v 3 c 0 1 2 3 end group end object\n";
  folder.compile("g", kHead +
                          "GEO(make) { miObject *o = open_named(\"plate\");"
                          "  o->bbox_max.x = 8;"
                          "  if (!mi_api_object_file(mi_mem_strdup(\"" +
                          folder.file("plate.mi") +
                          "\"))) return miFALSE;"
                          "  return mi_geoshader_add_result(result, mi_api_object_end()); }");
  UserScene scene(folder, made(), "\"i\"");
  EXPECT_NEAR(scene.pixel(4, 4, 4).x, 1.5f, 1e-5f);
  EXPECT_EQ(scene.messages(), "");
}

TEST(GeometryShaders, FilesOfPlaceholdersThatAreMissingAreNamed) {
  ShaderFolder folder;
  folder.compile("g", kHead +
                          "GEO(make) { open_named(\"none\");"
                          "  mi_api_object_file(mi_mem_strdup(\"/no/such/plate.mi\"));"
                          "  return mi_geoshader_add_result(result, mi_api_object_end()); }");
  UserScene scene(folder, made(), "\"i\"");
  EXPECT_NE(scene.messages().find("/no/such/plate.mi"), std::string::npos) << scene.messages();
}

TEST(GeometryShaders, FlagsEditedBehindTheEndCount) {
  ShaderFolder folder;
  folder.compile("g",
                 kHead +
                     "GEO(make) { miTag tag; miObject *o = open_named(NULL);"
                     "  plate(8, 1); tag = mi_api_object_end();"
                     "  o = (miObject *)mi_scene_edit(tag); o->visible = miFALSE;"
                     "  mi_scene_edit_end(tag); return mi_geoshader_add_result(result, tag); }");
  UserScene scene(folder, made(), "\"i\"");
  EXPECT_EQ(scene.pixel(4, 4, 4), Rgb(0));
}

TEST(GeometryShaders, IncrementalObjectsReplaceTheirGeometry) {
  ShaderFolder folder;
  folder.compile("g", kHead +
                          "GEO(make) { miTag first, again; open_named(\"p\"); plate(8, 1);"
                          "  first = mi_api_object_end();"
                          "  mi_api_incremental(miTRUE); open_named(\"p\"); plate(8, 3);"
                          "  again = mi_api_object_end(); mi_api_incremental(miFALSE);"
                          "  open_named(\"p\"); plate(8, 2);"
                          "  if (first != again || mi_api_object_end() == first) return miFALSE;"
                          "  return mi_geoshader_add_result(result, first); }");
  UserScene scene(folder, made(), "\"i\"");
  EXPECT_NEAR(scene.pixel(4, 4, 4).x, 3, 1e-5f);
}

/// A rational dome of degree 2, its texture surface, and its approximation.
std::string dome_source(const std::string& approximate) {
  return kHead +
         "GEO(make) { static const double knots[6] = {0,0,0,1,1,1};"
         "  miDlist *u = mi_api_dlist_create(miDLIST_GEOSCALAR); int i; miApprox a;"
         "  miDlist *t = mi_api_dlist_create(miDLIST_GEOSCALAR); double one = 1, zero = 0;"
         "  for (i = 0; i < 6; i++) mi_api_dlist_add(u, (void *)&knots[i]);"
         "  mi_api_dlist_add(t, &zero); mi_api_dlist_add(t, &zero);"
         "  mi_api_dlist_add(t, &one); mi_api_dlist_add(t, &one);"
         "  open_named(\"dome\"); mi_api_basis_list_clear();"
         "  mi_api_basis_add(mi_mem_strdup(\"b2\"), miTRUE, miBASIS_BSPLINE, 2, 0, NULL);"
         "  mi_api_basis_add(mi_mem_strdup(\"b1\"), miFALSE, miBASIS_BSPLINE, 1, 0, NULL);"
         "  mi_api_object_group_begin(0.0);"
         "  for (i = 0; i < 9; i++) { miGeoVector v; v.x = (i % 3 - 1) * 3.; v.y = (i / 3 - 1) * "
         "3.;"
         "    v.z = i == 4 ? 3 : 0; mi_api_geovector_xyz_add(&v); }"
         "  for (i = 0; i < 4; i++) { miVector v; v.x = i % 2; v.y = i / 2; v.z = 0;"
         "    mi_api_vector_xyz_add(&v); }"
         "  for (i = 0; i < 13; i++) mi_api_vertex_add(i);"
         "  mi_api_surface_begin(mi_mem_strdup(\"s\"), NULL);"
         "  mi_api_surface_params(miU, mi_mem_strdup(\"b2\"), 0., 1., u, miTRUE);"
         "  mi_api_surface_params(miV, mi_mem_strdup(\"b2\"), 0., .75, u, miTRUE);"
         "  for (i = 0; i < 9; i++) mi_api_vertex_ref_add(i, i == 4 ? 2. : 1.);"
         "  if (mi_api_vertex_ref_add(13, 1.) || mi_api_vertex_ref_add(-1, 1.)) return miFALSE;"
         "  mi_api_surface_texture_begin(miFALSE, miFALSE, mi_mem_strdup(\"b1\"), t, miFALSE,"
         "    mi_mem_strdup(\"b1\"), t, miFALSE);"
         "  for (i = 9; i < 13; i++) mi_api_vertex_ref_add(i, 1.);"
         "  mi_api_surface_end(); miAPPROX_DEFAULT(a);" +
         approximate +
         "  mi_api_object_group_end(); mi_api_dlist_delete(u); mi_api_dlist_delete(t);"
         "  return mi_geoshader_add_result(result, mi_api_object_end()); }";
}

std::string dome_text(const std::string& approximate) {
  std::string text =
      "object \"o\" visible shadow trace basis \"b2\" rational bspline 2 basis \"b1\" bspline 1 "
      "group ";
  for (int i = 0; i < 9; ++i)
    text += std::to_string((i % 3 - 1) * 3) + " " + std::to_string((i / 3 - 1) * 3) +
            (i == 4 ? " 3 " : " 0 ");
  text += "0 0 0 1 0 0 0 1 0 1 1 0 ";
  for (int i = 0; i < 13; ++i) text += "v " + std::to_string(i) + " ";
  return text +
         "surface \"s\" \"m\" rational \"b2\" 0. 1. 0. 0. 0. 1. 1. 1. rational \"b2\" 0. .75 0. 0. "
         "0. 1. 1. 1. 0 1 2 3 4 w 2 5 6 7 8 texture \"b1\" 0. 0. 1. 1. \"b1\" 0. 0. 1. 1. 9 10 11 "
         "12 " +
         approximate + " end group end object ";
}

TEST(GeometryShaders, FreeFormSurfacesAreThoseOfASceneFile) {
  ShaderFolder folder;
  folder.compile("g", dome_source("a.cnst[miCNST_UPARAM] = a.cnst[miCNST_VPARAM] = 6;"
                                  "mi_api_surface_approx(mi_mem_strdup(\"s\"), &a);"));
  UserScene shader(folder, made(), "\"i\"");
  UserScene text(folder, written(dome_text("approximate surface parametric 6 6 \"s\"")), "\"i\"");
  EXPECT_EQ(object_of(shader, "dome").bases, object_of(text, "o").bases);
  expect_same_picture(shader, text);
  EXPECT_EQ(shader.messages(), "");
  // It is no other dome: the coarsest one lies lower between its corners.
  UserScene coarse(folder, written(dome_text("approximate surface regular parametric 1 1 \"s\"")),
                   "\"i\"");
  EXPECT_GT(std::abs(coarse.pixel(4, 4).x - shader.pixel(4, 4).x), .1f);
}

/// C calls of a shader, and the equivalent statement.
scene::Approximation approximation(const std::string& c, const std::string& name = "s") {
  ShaderFolder folder;
  folder.compile("g",
                 dome_source(c + "mi_api_surface_approx(mi_mem_strdup(\"" + name + "\"), &a);"));
  UserScene shader(folder, made(), "\"i\"");
  const auto settings = object_of(shader, "dome").groups.at(0).settings;
  if (settings.empty()) return {};
  return scene::approximation_of(settings.at(0)).value();
}

scene::Approximation statement(const std::string& text) {
  ShaderFolder folder;
  folder.compile("g", kHead);
  UserScene scene(folder, written(dome_text(text)), "\"i\"");
  const auto settings = object_of(scene, "o").groups.at(0).settings;
  return scene::approximation_of(settings.at(0)).value();
}

TEST(GeometryShaders, ApproximationsAreStatementsOfASceneFile) {
  EXPECT_EQ(approximation("a.method = miAPPROX_LDA; a.cnst[miCNST_LENGTH] = .5;"
                          "a.cnst[miCNST_DISTANCE] = .25; a.cnst[miCNST_ANGLE] = 20;"
                          "a.subdiv[miMIN] = 1; a.subdiv[miMAX] = 4; a.any = 1;"),
            statement("approximate surface tree any length .5 distance .25 angle 20 1 4 \"s\""));
  EXPECT_EQ(approximation("a.method = miAPPROX_SPATIAL; a.cnst[miCNST_LENGTH] = .5; a.view_dep = 1;"
                          "a.style = miAPPROX_STYLE_GRID; a.subdiv[miMAX] = 3; a.max = 1000;"),
            statement("approximate surface grid spatial view .5 0 3 max 1000 \"s\""));
  EXPECT_EQ(approximation("a.method = miAPPROX_REGULAR_PERCENT; a.cnst[miCNST_UPARAM] = 50;"
                          "a.cnst[miCNST_VPARAM] = 100; a.subdiv[miMAX] = 0;"),
            statement("approximate surface tree regular parametric 50 % 100 % \"s\""));
  EXPECT_EQ(approximation("miAPPROX_FINE_DEFAULT(a);"),
            statement("approximate surface fine view length .25 0 7 \"s\""));
  EXPECT_EQ(approximation("a.method = miAPPROX_CURVATURE; a.cnst[miCNST_ANGLE] = 15;"
                          "a.flag = miAPPROX_FLAG_TRACE | miAPPROX_FLAG_SHADOW; a.sharp = .5;"
                          "a.style = miAPPROX_STYLE_FINE_NO_SMOOTHING;"),
            statement("trace shadow approximate surface fine nosmoothing sharp .5 angle 15 0 5 "
                      "\"s\""));
  // No statement and no call: the default applies.
  EXPECT_EQ(approximation("a.cnst[0] = 1; a.style = miAPPROX_STYLE_NONE;"), scene::Approximation());
  EXPECT_EQ(approximation("miAPPROX_DEFAULT(a);"), scene::Approximation());
}

TEST(GeometryShaders, AreNeededByNoOtherShaderOfTheirLibrary) {
  ShaderFolder folder;
  folder.compile("g", kHead +
                          "GEO(make) { open_named(\"p\"); plate(8, 1);"
                          "  return mi_geoshader_add_result(result, mi_api_object_end()); }");
  UserScene scene(folder,
                  "link \"g.so\" declare shader geometry \"make\" ( ) apply geometry end declare "
                  "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" .25 .5 "
                  ".75, \"diffuse\" 0 0 0 ) end material instance \"i\" geometry \"make\" ( ) "
                  "material \"m\" end instance ",
                  "\"i\"");
  expect_near(scene.pixel(4, 4, 4), Rgb(.25f, .5f, .75f), 1e-5f);
  EXPECT_EQ(scene.host->world(), nullptr) << "the world of geometry shaders is gone";
}

}  // namespace geometry_test
}  // namespace oriel
