// SPDX-License-Identifier: Apache-2.0
// Instances, groups, lights, materials, textures and user data that geometry shaders make, seen in
// the picture; names and tags; state items of Maya's interface.
#include "user_scene.h"

namespace oriel::testing {
namespace elements_test {

constexpr const char* kHead =
    "#include <shader.h>\n#include <geoshader.h>\n#include <mayaapi.h>\n"
    "static char *t(const char *s) { return mi_mem_strdup(s); }"
    "static miTag plate(const char *name, miScalar z) {"
    "  miVector v[4] = {{-8,-8,0},{8,-8,0},{8,8,0},{-8,8,0}}; int i;"
    "  mi_api_object_begin(name ? t(name) : NULL)->visible = miTRUE;"
    "  mi_api_object_group_begin(0.0);"
    "  for (i = 0; i < 4; i++) { v[i].z = z; mi_api_vector_xyz_add(&v[i]); }"
    "  for (i = 0; i < 4; i++) mi_api_vertex_add(i);"
    "  mi_api_poly_begin_tag(1, 0); for (i = 0; i < 4; i++) mi_api_poly_index_add(i);"
    "  mi_api_poly_end(); mi_api_object_group_end(); return mi_api_object_end(); }"
    "DLLEXPORT miBoolean height(miColor *r, miState *state, void *p) {"
    "  r->r = r->g = r->b = state->point.z; r->a = 1; return miTRUE; }";

constexpr const char* kScene =
    "link \"g.so\" declare shader geometry \"make\" ( ) apply geometry end declare "
    "declare shader geometry \"inner\" ( ) apply geometry end declare "
    "declare shader color \"height\" ( ) apply material end declare "
    "declare shader color \"told\" ( ) apply material end declare "
    "material \"m\" \"height\" ( ) end material "
    "instance \"made\" geometry \"make\" ( ) material \"m\" end instance ";

std::string make(const std::string& body) {
  return std::string(kHead) +
         "DLLEXPORT miBoolean make(miTag *result, miState *state, void *paras) {" + body + "}";
}

Rgb shown(const std::string& source, const std::string& more = "",
          const std::string& members = "\"made\"", const std::string& suffix = "c") {
  ShaderFolder folder;
  folder.compile("g", source, suffix);
  UserScene scene(folder, kScene + more, members);
  return scene.pixel(4, 4);
}

TEST(Elements, InstancesArePlacedByName) {
  expect_near(shown(make("miInstance *in; plate(\"p\", 1);"
                         "in = mi_api_instance_begin(t(\"p_i\"));"
                         "in->tf.global_to_local[14] = -.5f; in->tf.local_to_global[14] = .5f;"
                         "return mi_geoshader_add_result(result,"
                         "  mi_api_instance_end(t(\"p\"), 0, 0));")),
              Rgb(1.5f), 1e-4f);
}

TEST(Elements, AnObjectWithoutANameIsReachedByItsTag) {
  expect_near(shown(make("miTag first = plate(NULL, 1), second = plate(NULL, 2);"
                         "if (first == second) return miFALSE;"
                         "return mi_geoshader_add_result(result, second);")),
              Rgb(2), 1e-4f);
}

TEST(Elements, AnInstanceOfAGeometryShaderCallIsMade) {
  expect_near(shown(make("miTag call; mi_api_function_call(t(\"inner\"));"
                         "call = mi_api_function_call_end(0);"
                         "mi_api_instance_begin(t(\"in_i\"));"
                         "return mi_geoshader_add_result(result,"
                         "  mi_api_instance_end(NULL, call, 0));") +
                    "DLLEXPORT miBoolean inner(miTag *result, miState *state, void *p) {"
                    "  return mi_geoshader_add_result(result, plate(\"deep\", 2.25f)); }"),
              Rgb(2.25f), 1e-4f);
}

TEST(Elements, AGroupIsReadAsItWasMade) {
  expect_near(shown(make("miGroup *g; miInstance *in; miTag group; plate(\"p\", 1);"
                         "mi_api_instance_begin(t(\"a\")); mi_api_instance_end(t(\"p\"), 0, 0);"
                         "mi_api_instance_begin(t(\"b\")); mi_api_instance_end(t(\"p\"), 0, 0);"
                         "mi_api_instgroup_begin(t(\"both\")); mi_api_instgroup_additem(t(\"b\"));"
                         "mi_api_instgroup_clear(); mi_api_instgroup_additem(t(\"a\"));"
                         "mi_api_instgroup_additem(t(\"b\")); group = mi_api_instgroup_end();"
                         "if (mi_db_type(group) != miSCENE_GROUP) return miFALSE;"
                         "g = (miGroup*)mi_db_access(group); if (g->no_kids != 2) return miFALSE;"
                         "in = (miInstance*)mi_db_access(g->kids[1]);"
                         "if (strcmp(mi_api_tag_lookup(in->item), \"p\")) return miFALSE;"
                         "mi_db_unpin(g->kids[1]); mi_db_unpin(group);"
                         "return mi_geoshader_add_result(result, group);")),
              Rgb(1), 1e-4f);
}

TEST(Elements, TheRootGroupIsWalkedWhileRendering) {
  expect_near(
      shown(make("return mi_geoshader_add_result(result, plate(\"p\", 1));") +
                "DLLEXPORT miBoolean told(miColor *r, miState *state, void *p) {"
                "  miTag root = 0; miGroup *g; int i, objects = 0;"
                "  mi_query(miQ_SCENE_ROOT_GROUP, state, 0, &root);"
                "  g = (miGroup*)mi_db_access(root);"
                "  for (i = 0; i < g->no_kids; i++) {"
                "    miInstance *in = (miInstance*)mi_db_access(g->kids[i]);"
                "    if (mi_db_type(in->item) == miSCENE_OBJECT) objects++; }"
                "  r->r = g->no_kids; r->g = objects; r->b = 0; r->a = 1; return miTRUE; }",
            "material \"t\" \"told\" ( ) end material " + UserScene::square("t"), "\"square_i\""),
      Rgb(2, 1, 0), 1e-4f);
}

TEST(Elements, NamesAndTagsAreFoundWhileRendering) {
  expect_near(
      shown(make("return mi_geoshader_add_result(result, plate(\"p\", 1));") +
                "static int is(miTag tag, const char *name) {"
                "  const char *found = mi_api_tag_lookup(tag);"
                "  return found && !strcmp(found, name) && mi_api_name_lookup(t(name)) == tag; }"
                "DLLEXPORT miBoolean told(miColor *r, miState *state, void *p) {"
                "  miTag *lights, item = 0;"
                "  r->r = r->g = r->b = 0; r->a = 1;"
                "  mi_query(miQ_INST_ITEM, state, state->instance, &item);"
                "  if (mi_global_lights_info(&lights) == 1 && is(lights[0], \"lamp_i\")) r->r = 1;"
                "  if (is(state->instance, \"square_i\") && is(item, \"square\") &&"
                "      is(state->material, \"t\") && is(state->camera_inst, \"cam_i\")) r->g = 1;"
                "  if (mi_api_name_lookup(t(\"told\")) && !mi_api_name_lookup(t(\"none\")) &&"
                "      !mi_api_tag_lookup(0) && !mi_api_tag_lookup(12345)) r->b = 1;"
                "  return miTRUE; }",
            "light \"lamp\" \"mib_light_point\" ( ) origin 0 0 3 end light "
            "instance \"lamp_i\" \"lamp\" end instance "
            "material \"t\" \"told\" ( ) end material " +
                UserScene::square("t"),
            "\"square_i\" \"lamp_i\""),
      Rgb(1), 1e-4f);
}

/// A light of intensity 1 above a Lambert square, created by a shader with `set`.
std::string lit(const std::string& set) {
  return make(
      "miColor c = {1, 1, 1, 1}; miLight *l; miTag s;"
      "mi_api_function_call(t(\"mib_light_point\"));"
      "mi_api_parameter_name(t(\"color\"));"
      "mi_api_parameter_value(miTYPE_COLOR, &c, 0, 0);"
      "s = mi_api_function_call_end(0); l = mi_api_light_begin(t(\"lamp\"));"
      "l->shader = s; l->origin.z = 3;" +
      set +
      "if (!mi_api_light_end()) return miFALSE;"
      "mi_api_instance_begin(t(\"lamp_i\")); return mi_geoshader_add_result(result,"
      "  mi_api_instance_end(mi_mem_strdup(\"lamp\"), 0, 0));");
}
const std::string kLambert =
    "material \"l\" \"mib_illum_lambert\" ( \"diffuse\" 1 1 1, \"mode\" 0 ) end material " +
    UserScene::square("l");

TEST(Elements, ALightIsFoundByItsName) {
  const Rgb made = shown(lit(""), kLambert, "\"square_i\" \"made\"");
  const Rgb written = shown(lit(""),
                            kLambert +
                                "light \"w\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 3 "
                                "end light instance \"w_i\" \"w\" end instance ",
                            "\"square_i\" \"w_i\"");
  EXPECT_GT(written.x, .5f);
  expect_near(made, written, 1e-3f);
}

TEST(Elements, ALightListLinksLightsToAnInstance) {
  const auto linked = [](const std::string& exclusive) {
    return shown(
        make("miInstance *in; miTag list; plate(\"p\", 0); mi_api_light_list_begin();"
             "mi_api_light_list_add(t(\"b_i\")); list = mi_api_light_list_end();"
             "in = mi_api_instance_begin(t(\"p_i\")); in->light_list = list;"
             "in->exclusive = " +
             exclusive +
             "; in->material = mi_api_name_lookup(t(\"l\"));"
             "return mi_geoshader_add_result(result,"
             "  mi_api_instance_end(t(\"p\"), 0, 0));"),
        "material \"l\" \"mib_illum_lambert\" ( \"diffuse\" 1 1 1, \"mode\" 0 ) end material "
        "light \"a\" \"mib_light_point\" ( \"color\" 1 0 0 ) origin 0 0 3 end light "
        "light \"b\" \"mib_light_point\" ( \"color\" 0 1 0 ) origin 0 0 3 end light "
        "instance \"a_i\" \"a\" end instance instance \"b_i\" \"b\" end instance ",
        "\"a_i\" \"b_i\" \"made\"");
  };
  const Rgb own = linked("miFALSE"), others = linked("miTRUE");
  EXPECT_EQ(own.x, 0);
  EXPECT_GT(own.y, .5f);
  EXPECT_GT(others.x, .5f);
  EXPECT_EQ(others.y, 0);
}

TEST(Elements, ATextureIsLookedUp) {
  ShaderFolder folder;
  std::ofstream(folder.file("one.ppm"), std::ios::binary) << "P6 1 1 255\n"
                                                          << std::string("\xff\x00\xff", 3);
  folder.compile("g",
                 make("miTag tex; miMaterial *m; miInstance *in;"
                      "mi_api_texture_begin(t(\"picture\"), 0, 0);"
                      "tex = mi_api_texture_file_def(t(\"" +
                      folder.file("one.ppm") +
                      "\")); if (tex != mi_api_texture_lookup(t(\"picture\"), 0)) return miFALSE;"
                      "m = mi_api_material_begin(t(\"mat\"));"
                      "mi_api_function_call(t(\"look\")); mi_api_parameter_name(t(\"tex\"));"
                      "mi_api_parameter_value(miTYPE_COLOR_TEX, &tex, 0, 0);"
                      "m->shader = mi_api_function_call_end(0); mi_api_material_end();"
                      "plate(\"p\", 0); in = mi_api_instance_begin(t(\"p_i\"));"
                      "in->material = mi_api_name_lookup(t(\"mat\"));"
                      "return mi_geoshader_add_result(result,"
                      "  mi_api_instance_end(t(\"p\"), 0, 0));") +
                     "struct look { miTag tex; };"
                     "DLLEXPORT miBoolean look(miColor *r, miState *state, struct look *p) {"
                     "  miVector c = {.5f, .5f, 0};"
                     "  return mi_lookup_color_texture(r, state, *mi_eval_tag(&p->tex), &c); }");
  UserScene scene(folder,
                  std::string(kScene) +
                      "declare shader color \"look\" ( color texture \"tex\" ) "
                      "apply material end declare ",
                  "\"made\"");
  expect_near(scene.pixel(4, 4), Rgb(1, 0, 1), 1e-3f);
}

TEST(Elements, ShadowMapsOfALightAreAcceptedAndIgnored) {
  const Rgb plain = shown(lit(""), kLambert, "\"square_i\" \"made\"");
  const Rgb mapped = shown(lit("l->use_shadow_maps = miTRUE; l->shadowmap_resolution = 512;"
                               "l->shadowmap_flags = miSHADOWMAP_DETAIL | miSHADOWMAP_MERGE;"
                               "l->shadowmap_flags &= ~(miSHADOWMAP_MERGE | miSHADOWMAP_CAMERA);"
                               "l->shmap.accuracy = .1f; l->shmap.samples = 4;"
                               "l->shmap.type = 'c';"),
                           kLambert, "\"square_i\" \"made\"");
  expect_near(mapped, plain, 1e-5f);
}

TEST(Elements, UserDataIsAttachedToInstances) {
  const std::string reader =
      "DLLEXPORT miBoolean told(miColor *r, miState *state, void *p) {"
      "  miTag data = 0, next = 0; miUserdata *d; r->r = r->g = r->b = 0; r->a = 1;"
      "  mi_query(miQ_INST_DATA, state, state->instance, &data);"
      "  if (!data) return miTRUE; d = (miUserdata*)mi_db_access(data);"
      "  r->r = d->parameters[2]; mi_query(miQ_DATA_NEXT, state, data, &next);"
      "  if (next) r->g = *(int*)((miUserdata*)mi_db_access(next))->parameters;"
      "  r->b = ((miInstance*)mi_db_access(state->instance))->label; return miTRUE; }";
  expect_near(
      shown(make("miUchar b[3] = {4, 5, 6}; miInteger n = 9; miTag call, first, second;"
                 "miInstance *in; mi_api_data_begin(t(\"d\"), 0, NULL);"
                 "mi_api_data_byte_copy(2, b); mi_api_data_byte_copy(1, b + 2);"
                 "first = mi_api_data_end(); mi_api_function_call(t(\"own\"));"
                 "mi_api_parameter_name(t(\"n\")); mi_api_parameter_value(miTYPE_INTEGER, &n);"
                 "call = mi_api_function_call_end(0); mi_api_data_begin(t(\"e\"), 2, &call);"
                 "second = mi_api_data_end(); mi_api_data_append(first, second);"
                 "plate(\"p\", 1); in = mi_api_instance_begin(t(\"p_i\"));"
                 "in->userdata = first; in->label = 3;"
                 "in->material = mi_api_name_lookup(t(\"t\"));"
                 "return mi_geoshader_add_result(result, mi_api_instance_end(t(\"p\"), 0, 0));") +
                reader,
            "declare data \"own\" ( integer \"n\" ) end declare "
            "material \"t\" \"told\" ( ) end material "),
      Rgb(6, 9, 3), 1e-4f);
}

/// A light shader that disables one of its components, and a material that samples it.
std::string maya(const std::string& language) {
  const std::string c = language == "cpp" ? "extern \"C\" " : "";
  return std::string("#include <shader.h>\n#include <mayaapi.h>\n") + c +
         "DLLEXPORT miBoolean half(miColor *r, miState *state, void *p) {"
         "  miBoolean *specular; int *diffuse;"
         "  r->r = r->g = r->b = r->a = 1;"
         "  if (mayabase_stateitem_get(state, MBSI_LIGHTDIFFUSE, &diffuse,"
         "                             MBSI_LIGHTSPECULAR, &specular, MBSI_NULL))"
         "    *specular = miFALSE;"
         "  return miTRUE; }" +
         c +
         "DLLEXPORT miBoolean asks(miColor *r, miState *state, void *p) {"
         "  miTag *lights; miColor c; miVector dir; miScalar dot; int n, i, samples;"
         "  r->r = r->g = r->b = 0; r->a = 1; n = mi_global_lights_info(&lights);"
         "  for (i = 0; i < n; i++) { samples = 0;"
         "    while (mi_sample_light(&c, &dir, &dot, state, lights[i], &samples)) {"
         "      miBoolean *diffuse = NULL, *specular = NULL;"
         "      mayabase_stateitem_get(state, MBSI_LIGHTSPECULAR, &specular,"
         "                             MBSI_LIGHTDIFFUSE, &diffuse, MBSI_NULL);"
         "      r->r += *diffuse; r->g += *specular; r->b += 1; } }"
         "  return miTRUE; }";
}

TEST(MayaItems, ALightShaderSwitchesItsHighlightsOff) {
  for (const char* language : {"c", "cpp"}) {
    ShaderFolder folder;
    folder.compile("g", maya(language), language);
    UserScene scene(
        folder,
        "link \"g.so\" declare shader color \"half\" ( ) apply light end declare "
        "declare shader color \"asks\" ( ) apply material end declare "
        "light \"a\" \"half\" ( ) origin 0 0 3 end light instance \"a_i\" \"a\" end instance "
        "light \"b\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 1 0 3 end light "
        "instance \"b_i\" \"b\" end instance "
        "material \"m\" \"asks\" ( ) end material " +
            UserScene::square("m"),
        "\"square_i\" \"a_i\" \"b_i\"");
    expect_near(scene.pixel(4, 4), Rgb(2, 1, 2), 1e-4f);
  }
}

TEST(MayaItems, BuiltInMaterialsTakeThemIntoAccount) {
  const auto lambert = [](const char* item) {
    ShaderFolder folder;
    folder.compile("g",
                   std::string("#include <shader.h>\n#include <mayaapi.h>\n"
                               "DLLEXPORT miBoolean half(miColor *r, miState *state, void *p) {"
                               "  miBoolean *it; r->r = r->g = r->b = r->a = 1;"
                               "  mayabase_stateitem_get(state, ") +
                       item + ", &it, MBSI_NULL); *it = miFALSE; return miTRUE; }");
    UserScene scene(folder,
                    "link \"g.so\" declare shader color \"half\" ( ) apply light end declare "
                    "light \"a\" \"half\" ( ) origin 0 0 3 end light "
                    "instance \"a_i\" \"a\" end instance " +
                        kLambert,
                    "\"square_i\" \"a_i\"");
    return scene.pixel(4, 4).x;
  };
  EXPECT_GT(lambert("MBSI_LIGHTSPECULAR"), .5f);
  EXPECT_EQ(lambert("MBSI_LIGHTDIFFUSE"), 0);
}

}  // namespace elements_test
}  // namespace oriel::testing
