// SPDX-License-Identifier: Apache-2.0
// What stands behind the tags of parameters: images of textures, materials, lights; and exit
// functions, which run for all shaders that ran.
#include "user_scene.h"

namespace oriel::testing {
namespace tags_test {

const std::string kHead =
    "#include <shader.h>\n#include <geoshader.h>\n#include <string.h>\n"
    "static miBoolean is(miColor *r, miBoolean a, miBoolean b, miBoolean c) {"
    "  r->r = a ? 1 : 0; r->g = b ? 1 : 0; r->b = c ? 1 : 0; r->a = 1; return miTRUE; }";

TEST(UserTags, OfTexturesGiveTheirImage) {
  ShaderFolder folder;
  std::ofstream(folder.file("four.ppm"), std::ios::binary)
      << "P6 2 2 255\n"
      << std::string("\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff", 12);
  folder.compile("image",
                 kHead +
                     "struct image { miTag texture; };"
                     "DLLEXPORT miBoolean image(miColor *r, miState *state, struct image *p) {"
                     "  miTag tag = *mi_eval_tag(&p->texture); int type = 0; miColor a, b;"
                     "  miImg_image *i = (miImg_image*)mi_db_access_type(&type, tag);"
                     "  if (!i) return is(r, 0, 0, 0);"
                     "  mi_img_get_color(i, &a, 0, 0); mi_img_get_color(i, &b, 1, 1);"
                     "  mi_db_unpin(tag);"
                     "  return is(r, type == miSCENE_IMAGE && i->width == 2 &&"
                     "              mi_img_get_height(i) == 2 && i->comp == 4,"
                     "            a.r == 0 && a.g == 0 && a.b == 1 && a.a == 1,"
                     "            b.r == 0 && b.g == 1 && b.b == 0); }");
  UserScene scene(folder,
                  "link \"image.so\" declare shader color \"image\" ( color texture \"texture\" ) "
                  "apply material end declare color texture \"four\" \"" +
                      folder.file("four.ppm") +
                      "\" material \"m\" \"image\" ( \"texture\" \"four\" ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  expect_near(scene.pixel(4, 4, 1), Rgb(1), 0);
}

/// Two materials, of which the geometry shader "make" chooses by its parameter.
Rgb chosen(const std::string& make) {
  ShaderFolder folder;
  folder.compile("make", kHead + "struct make { miTag material; };" + make);
  UserScene scene(folder,
                  "link \"make.so\" declare shader geometry \"make\" ( material \"material\" ) "
                  "apply geometry end declare "
                  "material \"dark\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" 0 0 "
                  ".25, \"diffuse\" 0 0 0 ) end material "
                  "material \"red\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" .5 0 "
                  "0, \"diffuse\" 0 0 0 ) end material "
                  "instance \"made\" geometry \"make\" ( \"material\" \"red\" ) material \"dark\" "
                  "end instance ",
                  "\"made\"");
  return scene.pixel(4, 4, 16);
}

TEST(UserTags, OfMaterialsReachPolygonsOfGeometryShaders) {
  expect_near(chosen("DLLEXPORT miBoolean make(miTag *result, miState *state, struct make *p) {"
                     "  miVector v[4] = {{-8,-8,0},{8,-8,0},{8,8,0},{-8,8,0}}; int i;"
                     "  mi_api_object_begin(mi_mem_strdup(\"o\"))->visible = miTRUE;"
                     "  mi_api_object_group_begin(0.0);"
                     "  for (i = 0; i < 4; i++) mi_api_vector_xyz_add(&v[i]);"
                     "  for (i = 0; i < 4; i++) mi_api_vertex_add(i);"
                     "  mi_api_poly_begin_tag(1, *mi_eval_tag(&p->material));"
                     "  for (i = 0; i < 4; i++) mi_api_poly_index_add(i);"
                     "  mi_api_poly_end(); mi_api_object_group_end();"
                     "  return mi_geoshader_add_result(result, mi_api_object_end()); }"),
              Rgb(.5f, 0, 0), 1e-4f);
}

TEST(UserTags, OfMaterialsReachHairOfGeometryShaders) {
  expect_near(
      chosen("DLLEXPORT miBoolean make(miTag *result, miState *state, struct make *p) {"
             "  miScalar v[6] = {-8, 0, 0, 8, 0, 0}; miGeoIndex first[2] = {0, 6};"
             "  miHair_list *h; mi_api_object_begin(mi_mem_strdup(\"o\"))->visible = miTRUE;"
             "  h = mi_api_hair_begin(); h->material = *mi_eval_tag(&p->material); h->radius = 3;"
             "  memcpy(mi_api_hair_scalars_begin(6), v, sizeof v); mi_api_hair_scalars_end(6);"
             "  memcpy(mi_api_hair_hairs_begin(2), first, sizeof first); mi_api_hair_hairs_end();"
             "  mi_api_hair_end();"
             "  return mi_geoshader_add_result(result, mi_api_object_end()); }"),
      Rgb(.5f, 0, 0), 1e-4f);
}

TEST(UserTags, OfMaterialsAreThoseOfTheHit) {
  ShaderFolder folder;
  folder.compile("same",
                 kHead +
                     "struct same { miTag own; miTag other; };"
                     "DLLEXPORT miBoolean same(miColor *r, miState *state, struct same *p) {"
                     "  miTag own = *mi_eval_tag(&p->own), other = *mi_eval_tag(&p->other);"
                     "  return is(r, own && own == state->material, other && other != own,"
                     "            mi_db_type(own) == miSCENE_MATERIAL); }");
  UserScene scene(
      folder,
      "link \"same.so\" declare shader color \"same\" ( material \"own\", geometry "
      "\"other\" ) apply material end declare "
      "material \"m\" \"same\" ( \"own\" \"m\", \"other\" \"square_i\" ) end material " +
          UserScene::square("m"),
      "\"square_i\"");
  expect_near(scene.pixel(4, 4, 1), Rgb(1), 0);
}

TEST(UserTags, LightTagsGiveShadowMaps) {
  ShaderFolder folder;
  folder.compile(
      "maps", kHead +
                  "DLLEXPORT miBoolean maps(miColor *r, miState *s, void *p) {"
                  "  miTag *lights; miInstance *i; miLight *l;"
                  "  if (mi_global_lights_info(&lights) != 1) return miFALSE;"
                  "  i = (miInstance*)mi_db_access(lights[0]);"
                  "  l = (miLight*)mi_db_access(i->item);"
                  "  return is(r, l->use_shadow_maps && l->shadowmap_flags == miSHADOWMAP_DETAIL,"
                  "            l->shadowmap_resolution == 256 && l->shmap.samples == 7,"
                  "            l->shmap.type == 'a' && l->label == 5); }");
  UserScene scene(
      folder,
      "link \"maps.so\" declare shader color \"maps\" ( ) apply material end declare "
      "material \"m\" \"maps\" ( ) end material "
      "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 2 shadowmap on shadowmap "
      "detail shadowmap resolution 256 shadowmap detail samples 7 shadowmap alpha tag 5 end light "
      "instance \"lamp_i\" \"lamp\" end instance " +
          UserScene::square("m"),
      "\"lamp_i\" \"square_i\"");
  expect_near(scene.pixel(4, 4, 1), Rgb(1), 0);
}

const std::string kExit =
    "struct ends { miInteger n; };"
    "DLLEXPORT void ends_exit(miState *state, struct ends *p) {"
    "  void **user = NULL; if (p) mi_query(miQ_FUNC_USERPTR, state, 0, &user);"
    "  mi_warning(\"the end of %d, %s\", p ? p->n : 0,"
    "             user && *user ? (char*)*user : \"nothing\"); }";

TEST(UserExit, RunsWhereThereIsNoInit) {
  ShaderFolder folder;
  folder.compile("ends", kHead + kExit +
                             "DLLEXPORT miBoolean ends(miColor *r, miState *s, struct ends *p) {"
                             "  return is(r, 1, 1, 1); }");
  UserScene scene(folder,
                  "link \"ends.so\" declare shader color \"ends\" ( integer \"n\" ) apply "
                  "material end declare material \"m\" \"ends\" ( \"n\" 4 ) end material " +
                      UserScene::square("m"),
                  "\"square_i\"");
  scene.pixel(4, 4, 1);
  scene.host->end_frame();
  EXPECT_NE(scene.messages().find("the end of 0, nothing"), std::string::npos) << scene.messages();
  EXPECT_EQ(scene.messages().find("the end of 4"), std::string::npos) << scene.messages();
}

TEST(UserExit, RunsWhereThereAreOnlyGeometryShaders) {
  ShaderFolder folder;
  folder.compile("ends",
                 kHead + kExit +
                     "DLLEXPORT void ends_init(miState *state, struct ends *p, miBoolean *each) {"
                     "  void **user; *each = miTRUE; if (!p) return;"
                     "  mi_query(miQ_FUNC_USERPTR, state, 0, &user); *user = (void*)\"mine\"; }"
                     "DLLEXPORT miBoolean ends(miTag *result, miState *state, struct ends *p) {"
                     "  mi_api_object_begin(mi_mem_strdup(\"o\")); mi_api_object_group_begin(0.0);"
                     "  mi_api_object_group_end();"
                     "  return mi_geoshader_add_result(result, mi_api_object_end()); }");
  UserScene scene(folder,
                  "link \"ends.so\" declare shader geometry \"ends\" ( integer \"n\" ) apply "
                  "geometry end declare material \"m\" \"mib_illum_lambert\" ( ) end material "
                  "instance \"made\" geometry \"ends\" ( \"n\" 4 ) material \"m\" end instance " +
                      UserScene::square("m"),
                  "\"made\" \"square_i\"");
  scene.host->end_frame();
  const std::string said = scene.messages();
  const std::size_t of_call = said.find("the end of 4, mine");
  ASSERT_NE(of_call, std::string::npos) << said;
  EXPECT_NE(said.find("the end of 0, nothing", of_call), std::string::npos) << said;
}

}  // namespace tags_test
}  // namespace oriel::testing
