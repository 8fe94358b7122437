// SPDX-License-Identifier: Apache-2.0
// mia_material_api.h at work: what materials say of themselves, what they and lights tell each
// other.
#include <fmt/format.h>

#include "output/output_names.h"
#include "user_picture.h"

namespace oriel {
namespace material_api_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserPicture;
using testing::UserScene;

constexpr const char* kHead = "#include <shader.h>\n#include <mia_material_api.h>\n";

/// A light at (0, 0, 3) with a shader.
std::string lamp(const std::string& shader, const std::string& shape = "") {
  return "light \"lamp\" " + shader + " origin 0 0 3 " + shape +
         " end light instance \"lamp_i\" \"lamp\" end instance ";
}

/// Mean over the picture of an output of the materials.
Rgb mean_output(const UserPicture& picture, const std::string& name) {
  const Film& film = picture.session->film();
  const auto index = static_cast<std::size_t>(material_output_index(name));
  Rgb sum(0);
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      sum += resolve_outputs(film.outputs(x, y), rgb(film.pixel(x, y).beauty))[index];
  return sum / static_cast<float>(film.pixel_count());
}

// acceptance: I1
TEST(MaterialApi, StructsAreDistinguishedBySize) {
  const ShaderFolder folder;
  folder.compile(
      "ask",
      std::string(kHead) +
          "struct ask { miTag mtl; miInteger mode; };"
          "DLLEXPORT miBoolean ask(miColor *r, miState *state, struct ask *p) {"
          "  mia_material_api_storage o, *fo; mia_material_x_api_storage x, *fx; int n;"
          "  miTag mtl = *mi_eval_tag(&p->mtl); int mode = *mi_eval_integer(&p->mode);"
          "  miColor c;"
          "  o.struct_size = mode == 0 ? sizeof o : sizeof o - 4; o.in_use = miFALSE;"
          "  x.struct_size = mode == 1 ? sizeof x : sizeof x + 4; x.in_use = miFALSE;"
          "  if (mode % 2) mi_shaderstate_set(state, miA_MATERIAL_API_STORAGE, &x, sizeof x, 0);"
          "  else mi_shaderstate_set(state, miA_MATERIAL_API_STORAGE, &o, sizeof o, 0);"
          "  if (!mi_call_shader_x(&c, miSHADER_MATERIAL, state, mtl, NULL)) return miFALSE;"
          "  fo = mi_shaderstate_get(state, miA_MATERIAL_API_STORAGE, &n);"
          "  fx = (mia_material_x_api_storage *)fo; *r = c; r->a = 1;"
          "  if (!fo || n != (mode % 2 ? (int)sizeof x : (int)sizeof o)) return miFALSE;"
          "  if (mode == 0 && fo->in_use) *r = fo->diff_result;"
          "  if (mode == 1 && fx->in_use) *r = fx->output.diffuse_result;"
          "  if (mode >= 2) { r->r = fo->in_use ? 5 : .125; r->g = r->b = 0; }"
          "  if (mode < 2 && fo->in_use && (mode ? fx->type : fo->type) != miRAY_EYE)"
          "    return miFALSE;"
          "  return miTRUE; }");
  const auto scene_of = [&](const std::string& material) {
    return "link \"ask.so\" declare shader color \"ask\" ( shader \"mtl\", integer \"mode\" ) "
           "apply material end declare " +
           lamp("\"mib_light_point\" ( \"color\" 1 1 1 )") +
           "shader \"x\" \"mia_material_x\" ( \"diffuse\" .7 .5 .3 1, \"reflectivity\" .4, "
           "\"refl_color\" 1 1 1 1, \"multiple_outputs\" on ) material \"m\" " +
           material + " end material " + UserScene::square("m");
  };
  const auto asked = [&](int mode) {
    UserScene scene(folder,
                    scene_of("\"ask\" ( \"mtl\" \"x\", \"mode\" " + std::to_string(mode) + " )"),
                    "\"lamp_i\" \"square_i\"");
    const Rgb mean = UserPicture(scene, 8).mean();
    EXPECT_EQ(scene.messages(), "");
    return mean;
  };
  UserScene bare(folder, scene_of("= \"x\""), "\"lamp_i\" \"square_i\"");
  const Rgb wanted = mean_output(UserPicture(bare, 8, true), "diffuse_result");
  EXPECT_GT(wanted.x, .05f);
  expect_near(asked(0), wanted, 1e-4f);
  expect_near(asked(1), wanted, 1e-4f);
  // Sizes that are none of either: the material leaves the struct alone.
  expect_near(asked(2), Rgb(.125f, 0, 0), 1e-6f);
  expect_near(asked(3), Rgb(.125f, 0, 0), 1e-6f);
}

// acceptance: I1
TEST(MaterialApi, TheOlderStructHasEachPartUnderItsOwnName) {
  const ShaderFolder folder;
  // Members of the struct and the outputs that they are; the last is opacity, one number.
  const std::pair<const char*, const char*> members[] = {
      {"indir_result", "indirect_result"}, {"diff_result", "diffuse_result"},
      {"spec_result", "spec_result"},      {"tran_result", "tran_result"},
      {"refl_result", "refl_result"},      {"refr_result", "refr_result"},
      {"add_result", "add_result"},        {"ao_result", "ao_raw"},
      {"diff_level", "diffuse_level"},     {"refl_level", "refl_level"},
      {"refr_level", "refr_level"},        {"tran_level", "tran_level"}};
  std::string addresses;
  for (const auto& [member, output] : members) addresses += std::string("&o.") + member + ", ";
  folder.compile(
      "part", std::string(kHead) +
                  "struct part { miTag mtl; miInteger member; };"
                  "DLLEXPORT miBoolean part(miColor *r, miState *state, struct part *p) {"
                  "  mia_material_api_storage o, *found; int n; miColor c;"
                  "  miTag mtl = *mi_eval_tag(&p->mtl); int member = *mi_eval_integer(&p->member);"
                  "  o.struct_size = sizeof o; o.in_use = miFALSE;"
                  "  mi_shaderstate_set(state, miA_MATERIAL_API_STORAGE, &o, sizeof o, 0);"
                  "  if (!mi_call_shader_x(&c, miSHADER_MATERIAL, state, mtl, NULL))"
                  "    return miFALSE;"
                  "  found = mi_shaderstate_get(state, miA_MATERIAL_API_STORAGE, &n);"
                  "  if (!found || !found->in_use) return miFALSE;"
                  "  o = *found;"
                  "  { miColor *parts[] = {" +
                  addresses +
                  "0}; *r = *parts[member]; }"
                  "  r->a = 1; return miTRUE; }");
  const auto scene_of = [&](const std::string& material) {
    return "link \"part.so\" declare shader color \"part\" ( shader \"mtl\", integer \"member\" ) "
           "apply material end declare " +
           lamp("\"mib_light_point\" ( \"color\" 9 9 9 )") +
           "shader \"x\" \"mia_material_x\" ( \"diffuse\" .7 .5 .3 1, \"reflectivity\" .4, "
           "\"refl_color\" 1 .5 1 1, \"brdf_0_degree_refl\" .5, \"refl_gloss\" .2, "
           "\"transparency\" .5, \"refr_color\" .2 .9 .4 1, \"thin_walled\" on, "
           "\"refr_translucency\" on, \"refr_trans_color\" .1 .3 .8 1, \"refr_trans_weight\" .4, "
           "\"additional_color\" .1 .2 .3, \"multiple_outputs\" on ) material \"m\" " +
           material + " end material " + UserScene::square("m");
  };
  UserScene bare(folder, scene_of("= \"x\""), "\"lamp_i\" \"square_i\"");
  const UserPicture wanted(bare, 16, true);
  for (std::size_t i = 0; i < std::size(members); ++i) {
    UserScene scene(folder,
                    scene_of("\"part\" ( \"mtl\" \"x\", \"member\" " + std::to_string(i) + " )"),
                    "\"lamp_i\" \"square_i\"");
    const Rgb expected = mean_output(wanted, members[i].second);
    SCOPED_TRACE(members[i].first);
    expect_near(UserPicture(scene, 16).mean(), expected, .02f * max_component(expected) + 1e-6f);
    EXPECT_EQ(scene.messages(), "");
  }
}

/// Calls a material and shows member `member` of its 24 results, or its colour alone for 24.
constexpr const char* kWhole =
    "struct whole { miTag mtl; miInteger member; };"
    "DLLEXPORT miBoolean whole(miColor *r, miState *state, struct whole *p) {"
    "  mia_material_x_return all; miColor *c = &all.result; int i;"
    "  miTag mtl = *mi_eval_tag(&p->mtl); int member = *mi_eval_integer(&p->member);"
    "  for (i = 0; i < (int)sizeof all; ++i) ((char *)&all)[i] = 0;"
    "  all.spare[0].r = 7;"
    "  if (!mi_call_shader_x(c, miSHADER_MATERIAL, state, mtl, NULL)) return miFALSE;"
    "  if (all.spare[0].r != 7) return miFALSE;"
    "  if (member == 24) { *r = c[0]; return miTRUE; }"
    "  if (member < 23) *r = c[member]; else r->r = r->g = r->b = all.opacity;"
    "  r->a = 1; return miTRUE; }";
const std::string kDeclareWhole =
    "link \"whole.so\" declare shader color \"whole\" ( shader \"mtl\", integer \"member\" ) "
    "apply material end declare ";

// acceptance: I1
TEST(MaterialApi, CallersGetTheWholeStruct) {
  const ShaderFolder folder;
  folder.compile("whole", std::string(kHead) + kWhole);
  const auto scene_of = [&](const std::string& material, const std::string& outputs) {
    return kDeclareWhole + lamp("\"mib_light_point\" ( \"color\" 9 9 9 )") +
           "shader \"x\" \"mia_material_x\" ( \"diffuse\" .7 .5 .3 1, \"reflectivity\" .4, "
           "\"refl_color\" 1 .5 1 1, \"brdf_0_degree_refl\" 1, \"refl_gloss\" .2, "
           "\"additional_color\" .1 .2 .3, \"cutout_opacity\" 1, \"multiple_outputs\" " +
           outputs + " ) material \"m\" " + material + " end material " + UserScene::square("m");
  };
  UserScene bare(folder, scene_of("= \"x\"", "on"), "\"lamp_i\" \"square_i\"");
  const UserPicture wanted(bare, 16, true);
  const auto shown = [&](std::size_t member, const std::string& outputs) {
    UserScene scene(
        folder,
        scene_of("\"whole\" ( \"mtl\" \"x\", \"member\" " + std::to_string(member) + " )", outputs),
        "\"lamp_i\" \"square_i\"");
    const Rgb mean = UserPicture(scene, 16).mean();
    EXPECT_EQ(scene.messages(), "");
    return mean;
  };
  int bright = 0;
  for (std::size_t i = 0; i < kMaterialResults; ++i) {
    const std::string name = kMaterialOutputNames[i];
    const Rgb expected = name == "result" ? wanted.mean() : mean_output(wanted, name);
    bright += expected.x > .01f;
    // Quotients of means are not means of quotients where levels change over the picture.
    expect_near(shown(i, "on"), expected, .02f * max_component(expected) + 1e-6f);
    if (i > 0) expect_near(shown(i, "off"), Rgb(0), 0);
  }
  EXPECT_GE(bright, 10);
}

// acceptance: I2
TEST(MaterialApi, WrappedMaterialsKeepAlphaAndHoles) {
  const ShaderFolder folder;
  folder.compile("whole", std::string(kHead) + kWhole);
  const auto alpha = [&](const std::string& material, const std::string& parameters) {
    UserScene scene(folder,
                    kDeclareWhole + "shader \"x\" \"mia_material_x\" ( \"multiple_outputs\" on, " +
                        parameters + " ) material \"m\" " + material + " end material " +
                        UserScene::square("m"),
                    "\"square_i\"");
    const UserPicture picture(scene, 64);
    EXPECT_EQ(scene.messages(), "");
    const Film& film = picture.session->film();
    return film.pixel(film.width() / 2, film.height() / 2).beauty.a;
  };
  const std::pair<std::string, float> cases[] = {
      {"\"reflectivity\" 0, \"cutout_opacity\" .25", .25f},
      {"\"reflectivity\" 0, \"transparency\" .75, \"thin_walled\" on, \"propagate_alpha\" on",
       .25f},
      {"\"reflectivity\" 0, \"transparency\" .75, \"thin_walled\" on", 1},
      {"\"reflectivity\" 0, \"transparency\" .75, \"thin_walled\" on, \"refr_gloss\" .9, "
       "\"refr_interpolate\" on, \"propagate_alpha\" on",
       .25f}};
  for (const auto& [parameters, expected] : cases) {
    EXPECT_NEAR(alpha("= \"x\"", parameters), expected, .02f) << parameters;
    EXPECT_NEAR(alpha("\"whole\" ( \"mtl\" \"x\", \"member\" 24 )", parameters), expected, .02f)
        << "wrapped: " << parameters;
  }
}

// acceptance: I3
TEST(MaterialApi, SunIsIdentifiedAsSun) {
  const ShaderFolder folder;
  folder.compile(
      "suns",
      std::string(kHead) +
          "DLLEXPORT miBoolean suns(miColor *r, miState *state, void *p) {"
          "  mia_material_api_lightdata data, *said; miTag *lights; int n, i, size;"
          "  miColor c; miVector dir; float cosine;"
          "  r->r = r->g = r->b = 0; r->a = 1;"
          "  n = mi_global_lights_info(&lights);"
          "  for (i = 0; i < n; ++i) { int samples = 0;"
          "    data.struct_size = sizeof data; data.glossiness = data.importance = 1;"
          "    data.affect_diffuse = data.affect_specular = 1;"
          "    data.is_mr_sun = data.force_specular = miFALSE;"
          "    mi_shaderstate_set(state, miA_MATERIAL_API_LIGHTDATA, &data, sizeof data, 0);"
          "    while (mi_sample_light(&c, &dir, &cosine, state, lights[i], &samples)) {"
          "      said = mi_shaderstate_get(state, miA_MATERIAL_API_LIGHTDATA, &size);"
          "      if (said->is_mr_sun) r->r += 1; else r->g += 1; } }"
          "  return miTRUE; }");
  const std::string sun =
      "light \"sun\" \"mia_physicalsun\" ( \"on\" on, \"multiplier\" 1, \"samples\" 1, "
      "\"rgb_unit_conversion\" 1 1 1 ) direction 0 0 -1 end light "
      "instance \"sun_i\" \"sun\" end instance ";
  UserScene scene(folder,
                  "link \"suns.so\" declare shader color \"suns\" ( ) apply material end declare " +
                      lamp("\"mib_light_point\" ( \"color\" 1 1 1 )") + sun +
                      "material \"m\" \"suns\" ( ) end material " + UserScene::square("m"),
                  "\"lamp_i\" \"sun_i\" \"square_i\"");
  expect_near(UserPicture(scene).mean(), Rgb(1, 1, 0), 1e-6f);
}

/// Light shader "tell": emits white and executes STATEMENTS with `data`, the light data or null.
std::string telling(const std::string& statements) {
  return std::string(kHead) +
         "DLLEXPORT miBoolean tell(miColor *r, miState *state, void *p) { int n = 0;"
         "  mia_material_api_lightdata *data ="
         "    mi_shaderstate_get(state, miA_MATERIAL_API_LIGHTDATA, &n);"
         "  if (data && n != (int)sizeof *data) data = NULL;"
         "  r->r = r->g = r->b = r->a = 1; " +
         statements + "  return state->type == miRAY_LIGHT ? mi_trace_shadow(r, state) : miTRUE; }";
}
const std::string kTell =
    "link \"tell.so\" declare shader color \"tell\" ( ) apply light end declare ";
/// The material under the light.
std::string glossy(const std::string& further = "") {
  return "material \"m\" \"mia_material_x\" ( \"diffuse\" .5 .5 .5 1, \"reflectivity\" .5, "
         "\"refl_color\" 1 1 1 1, \"refl_gloss\" .4, \"brdf_0_degree_refl\" 1, "
         "\"brdf_90_degree_refl\" 1, \"multiple_outputs\" on " +
         further + " ) end material " + UserScene::square("m");
}

struct Parts {
  Rgb diffuse, specular;
};

Parts lit_parts(const ShaderFolder& folder, const std::string& body) {
  UserScene scene(folder, body, "\"lamp_i\" \"square_i\"");
  const UserPicture picture(scene, 64, true);
  EXPECT_EQ(scene.messages(), "");
  return {mean_output(picture, "diffuse_result"), mean_output(picture, "spec_result")};
}

// acceptance: I3
TEST(MaterialApi, AHighlightOnlyLightMakesNoDiffuseLight) {
  const ShaderFolder folder;
  folder.compile_file("light", ORIEL_SOURCE_DIR "/examples/shaders/light/ex_highlight_only.c");
  const std::string declared =
      "link \"light.so\" declare shader color \"ex_highlight_only\" ( color \"color\" default 1 1 "
      "1 ) version 1 apply light end declare " +
      lamp("\"ex_highlight_only\" ( \"color\" 1 1 1 )");
  const Parts parts = lit_parts(folder, declared + glossy());
  expect_near(parts.diffuse, Rgb(0), 0);
  EXPECT_GT(parts.specular.x, .005f);
  // Other materials leave nothing, and the light shines on them.
  UserScene plain(folder,
                  declared +
                      "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 0 0 0, "
                      "\"diffuse\" 1 1 1, \"mode\" 4 ) end material " +
                      UserScene::square("m"),
                  "\"lamp_i\" \"square_i\"");
  EXPECT_GT(UserPicture(plain).mean().x, .01f);
}

// acceptance: I3
TEST(MaterialApi, LightsShareThemselvesOutToDiffuseLightAndHighlights) {
  const ShaderFolder folder;
  folder.compile("tell", telling("if (data) { data->affect_diffuse *= .25;"
                                 "  data->affect_specular *= .5; data->is_mr_sun = miTRUE; }"));
  const Parts shared = lit_parts(folder, kTell + lamp("\"tell\" ( )") + glossy());
  const Parts whole =
      lit_parts(folder, lamp("\"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on )") + glossy());
  EXPECT_GT(whole.specular.x, .01f);
  expect_near(shared.diffuse, whole.diffuse * .25f, 1e-4f * whole.diffuse.x);
  expect_near(shared.specular, whole.specular * .5f, 1e-4f * whole.specular.x);
}

// acceptance: I3
TEST(MaterialApi, LightsThatAreSeenShowHighlightsWhenTheyForceThem) {
  const ShaderFolder folder;
  folder.compile("tell", telling("if (data) data->force_specular = miTRUE;"));
  const ShaderFolder quiet_folder;
  quiet_folder.compile("tell", telling(""));
  const std::string seen =
      kTell + lamp("\"tell\" ( )", "direction 0 0 -1 rectangle 1 0 0 0 1 0 visible on");
  const Parts quiet = lit_parts(quiet_folder, seen + glossy());
  const Parts forced = lit_parts(folder, seen + glossy());
  const Parts wanted = lit_parts(quiet_folder, seen + glossy(", \"no_visible_area_hl\" off"));
  expect_near(quiet.specular, Rgb(0), 0);
  EXPECT_GT(wanted.specular.x, .01f);
  expect_near(forced.specular, wanted.specular, 1e-4f * wanted.specular.x);
  expect_near(forced.diffuse, quiet.diffuse, 1e-4f * quiet.diffuse.x);
}

// acceptance: I3
TEST(MaterialApi, LightsReadGlossAndImportanceOfTheMaterial) {
  const ShaderFolder folder;
  folder.compile("tell", telling("r->r = data ? data->glossiness : 0;"
                                 "r->g = data ? data->importance : 0;"));
  const std::string dull =
      "material \"dull\" \"mia_material_x\" ( \"diffuse\" 1 1 1 1, \"diffuse_weight\" 1, "
      "\"reflectivity\" 0, \"refl_gloss\" .37 ) end material ";
  const std::string lit = kTell + lamp("\"tell\" ( )") + dull;
  UserScene direct(folder, lit + UserScene::square("dull"), "\"lamp_i\" \"square_i\"");
  const Rgb seen = UserPicture(direct).mean();
  EXPECT_GT(seen.z, .1f);
  EXPECT_NEAR(seen.x / seen.z, .37f, 1e-5f);
  EXPECT_NEAR(seen.y / seen.z, 1, 1e-5f);

  // The same surface overhead, seen in half a mirror.
  UserScene mirrored(
      folder,
      lit +
          "material \"mirror\" \"mia_material_x\" ( \"diffuse\" 0 0 0 1, \"diffuse_weight\" 0, "
          "\"reflectivity\" .5, \"refl_color\" 1 1 1 1, \"refl_gloss\" 1, \"brdf_0_degree_refl\" "
          "1, \"brdf_90_degree_refl\" 1 ) end material "
          "object \"roof\" visible shadow trace group -90 -90 6 90 -90 6 90 90 6 -90 90 6 v 0 v 1 "
          "v 2 v 3 c 3 2 1 0 end group end object instance \"roof_i\" \"roof\" material \"dull\" "
          "end instance " +
          UserScene::square("mirror"),
      "\"lamp_i\" \"square_i\" \"roof_i\"");
  const Rgb behind = UserPicture(mirrored).mean();
  EXPECT_GT(behind.z, .05f);
  EXPECT_NEAR(behind.x / behind.z, .37f, 1e-4f);
  EXPECT_NEAR(behind.y / behind.z, .5f, 1e-4f);
}

// acceptance: A3
TEST(MaterialApi, StateTexStretchesHighlights) {
  const ShaderFolder folder;
  folder.compile("vector",
                 std::string(kHead) +
                     "struct vec { miVector v; };"
                     "DLLEXPORT miBoolean vec(miColor *r, miState *state, struct vec *p) {"
                     "  state->tex = *mi_eval_vector(&p->v); return miTRUE; }");
  const auto pixels = [&](const std::string& shader, const std::string& parameter) {
    UserScene scene(
        folder,
        "link \"vector.so\" declare shader color \"vec\" ( vector \"v\" ) apply material, texture "
        "end declare " +
            lamp("\"mib_light_point\" ( \"color\" 9 9 9 )") +
            "shader \"surface\" \"mia_material_x\" ( \"diffuse_weight\" 0, \"reflectivity\" 1, "
            "\"brdf_fresnel\" off, \"brdf_0_degree_refl\" 1, \"refl_gloss\" .4, "
            "\"anisotropy\" 4, \"anisotropy_channel\" -4 ) material \"m\" " +
            fmt::format("\"{}\" ( {} ) = \"surface\" end material ", shader, parameter) +
            UserScene::square("m"),
        "\"lamp_i\" \"square_i\"");
    scene.indirect = false;
    const std::array<float, 2> beside = {scene.pixel(1, 4).x, scene.pixel(4, 1).x};
    EXPECT_EQ(scene.messages(), "");
    return beside;
  };
  const auto along_x = pixels("vec", "\"v\" 2 0 0"), along_y = pixels("vec", "\"v\" 0 2 0");
  EXPECT_EQ(along_x, pixels("oriel_tex_vector", "\"vector\" 2 0 0"));
  EXPECT_EQ(along_y, pixels("oriel_tex_vector", "\"vector\" 0 2 0"));
  // The highlight is longer one way than the other, and turns with the vector.
  const float ratio = along_x[0] / along_x[1];
  EXPECT_GT(std::max(ratio, 1 / ratio), 1.5f);
  EXPECT_NEAR(ratio, along_y[1] / along_y[0], .1f * ratio);
}

}  // namespace material_api_test
}  // namespace oriel
