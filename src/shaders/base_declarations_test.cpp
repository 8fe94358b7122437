// SPDX-License-Identifier: Apache-2.0
// Declarations of the base and physics libraries, by name.
#include <gtest/gtest.h>

#include <map>

#include "shaders/testing/declared.h"

namespace oriel {
namespace base_declarations_test {

constexpr std::string_view kAmbOcclusionTable = R"(
samples | integer | 16
bright | color | 1 1 1
dark | color | 0 0 0
spread | scalar | 0.8
max_distance | scalar | 0
reflective | boolean | off
output_mode | integer | 0
occlusion_in_alpha | boolean | off
falloff | scalar | 1
id_inclexcl | integer | 0
id_nonself | integer | 0
)";
constexpr std::string_view kGlossyReflectionTable = R"(
base_material | shader | -
reflection_color | color | -
max_distance | scalar | 0
falloff | scalar | 2
environment_color | color | -
reflection_base_weight | scalar | 0.6
reflection_edge_weight | scalar | 1
edge_factor | scalar | 5
environment | shader | -
single_env_sample | boolean | on
samples | integer | 16
u_spread | scalar | 0.1
v_spread | scalar | 0.1
u_axis | vector | -
v_axis | vector | -
dispersion | scalar | 0
spectrum | array color | -
)";
constexpr std::string_view kGlossyRefractionTable = R"(
top_material | shader | -
deep_material | shader | -
back_material | shader | -
render_reverse_of_back_material | boolean | on
refraction_color | color | 1 1 1
max_distance | scalar | 0
falloff | scalar | 2
refraction_base_weight | scalar | 1
refraction_edge_weight | scalar | 0.6
edge_factor | scalar | 5
ior | scalar | 1
samples | integer | 16
u_spread | scalar | 0.1
v_spread | scalar | 0.1
u_axis | vector | -
v_axis | vector | -
dispersion | scalar | 0
spectrum | array color | -
)";
constexpr std::string_view kBentNormalEnvTable = R"(
bent_normals | color | 0 0 0
occlusion_in_alpha | boolean | on
occlusion | color | 1 1 1
strength | scalar | 0.2
environment | shader | -
coordinate_space | integer | 2
env_samples | integer | 1
samples_spread | scalar | 0
matrix | transform | -
)";

/// Names and types in order, of shaders whose declarations have no defaults.
struct PlainInterface {
  const char* shader;
  int version;
  std::string_view parameters;
};
// Source: the public declarations of the base and physics libraries.
constexpr PlainInterface kBase[] = {
    {"mib_illum_lambert", 2, "ambience c, ambient c, diffuse c, mode i, lights L"},
    {"mib_illum_phong", 2,
     "ambience c, ambient c, diffuse c, specular c, exponent s, mode i, lights L"},
    {"mib_blackbody", 1, "temperature s, intensity s"},
    {"mib_illum_blinn", 2,
     "ambience c, ambient c, diffuse c, specular c, roughness s, ior s, mode i, lights L"},
    {"mib_illum_cooktorr", 2,
     "ambience c, ambient c, diffuse c, specular c, roughness s, ior c, mode i, lights L"},
    {"mib_illum_ward", 1,
     "ambience c, ambient c, diffuse c, glossy c, shiny_u s, shiny_v s, u v, v v, mode i, "
     "lights L"},
    {"mib_illum_ward_deriv", 1,
     "ambience c, ambient c, diffuse c, glossy c, shiny_u s, shiny_v s, mode i, lights L"},
    {"mib_illum_hair", 1,
     "ambience c, ambient c, diffuse c, specular c, exponent s, mode i, lights L"},
    {"mib_lens_stencil", 1, "floor s, ceiling s, floor_color c, ceil_color c, stencil stex"},
    {"mib_lens_clamp", 1, "floor s, ceiling s, luminance b, floor_color c, ceil_color c"},
    {"mib_volume", 1, "color c, max s, lightrays b"},
    {"mib_lightmap_sample", 1, "indirect b, flip i, lights L"},
    {"mib_ray_marcher", 1, "shader sh, distance s, num i, subdiv i, contrast c"},
    {"oversampling_lens", 1, "samples i"},
    {"dgs_material", 3,
     "diffuse c, glossy c, specular c, shiny s, shiny_u s, shiny_v s, transp s, ior s, lights L, "
     "mode i"},
    {"dgs_material_photon", 3,
     "diffuse c, glossy c, specular c, shiny s, shiny_u s, shiny_v s, transp s, ior s, lights L, "
     "mode i"},
    {"path_material", 2,
     "diffuse c, glossy c, specular c, shiny s, shiny_u s, shiny_v s, transp s, ior s, lights L, "
     "mode i"},
    {"dielectric_material", 2,
     "col c, ior s, col_out c, ior_out s, ignore_normals b, phong_coef s, lights L, mode i"},
    {"dielectric_material_photon", 2,
     "col c, ior s, col_out c, ior_out s, ignore_normals b, phong_coef s, lights L, mode i"},
    {"parti_volume", 3,
     "mode i, scatter c, extinction s, r s, g1 s, g2 s, nonuniform s, height s, min_step_len s, "
     "max_step_len s, light_dist s, min_level i, no_globil_where_direct b, lights L"},
    {"transmat", 1, ""},
    {"transmat_photon", 1, ""},
    {"mib_photon_basic", 1, "diffuse c, specular c, transp c, ior_frac s"},
    {"mib_bump_basis", 2, "project i, ntex i"},
    {"mib_bump_map", 2,
     "u v, v v, coord v, step v, factor s, torus_u b, torus_v b, alpha b, tex tex, clamp b"},
    {"mib_passthrough_bump_map", 2,
     "u v, v v, coord v, step v, factor s, torus_u b, torus_v b, alpha b, tex tex, clamp b"},
    {"mib_bump_map2", 1, "factor s, scale s, tex tex, color c"},
    {"mib_reflect", 2, "input c, reflect c, notrace b"},
    {"mib_refract", 2, "input c, refract c, ior s"},
    {"mib_transparency", 2, "input c, transp c"},
    {"mib_opacity", 2, "input c, opacity c"},
    {"mib_continue", 1, "input c, transp c"},
    {"mib_twosided", 1, "front c, back c"},
    {"mib_refraction_index", 1, "mtl_ior s"},
    {"mib_dielectric", 1, "input c, absorb c, refract s, ior s"},
    {"mib_cie_d", 1, "temperature s, intensity s"},
    {"mib_color_alpha", 2, "input c, factor s"},
    {"mib_color_average", 2, "input c, factor s"},
    {"mib_color_intensity", 2, "input c, factor s"},
    {"mib_color_interpolate", 1,
     "input s, num i, weight_1 s, weight_2 s, weight_3 s, weight_4 s, weight_5 s, weight_6 s, "
     "color_0 c, color_1 c, color_2 c, color_3 c, color_4 c, color_5 c, color_6 c, color_7 c"},
    {"mib_color_mix", 2,
     "num i, mode_0 i, mode_1 i, mode_2 i, mode_3 i, mode_4 i, mode_5 i, mode_6 i, mode_7 i, "
     "weight_0 s, weight_1 s, weight_2 s, weight_3 s, weight_4 s, weight_5 s, weight_6 s, "
     "weight_7 s, color_0 c, color_1 c, color_2 c, color_3 c, color_4 c, color_5 c, color_6 c, "
     "color_7 c, color_base c"},
    {"mib_color_spread", 1,
     "input c, num i, mode_0 i, mode_1 i, mode_2 i, mode_3 i, mode_4 i, mode_5 i, mode_6 i, "
     "mode_7 i, weight_0 c, weight_1 c, weight_2 c, weight_3 c, weight_4 c, weight_5 c, "
     "weight_6 c, weight_7 c"},
    {"mib_lookup_cube1", 1, "point v, dir v, size v, tex tex"},
    {"mib_lookup_cube6", 1,
     "point v, dir v, size v, tex_mx tex, tex_px tex, tex_my tex, tex_py tex, tex_mz tex, "
     "tex_pz tex"},
    {"mib_lookup_cylindrical", 1, "xform t, begin s, end s, tex tex"},
    {"mib_texture_checkerboard", 1,
     "coord v, xsize s, ysize s, zsize s, color000 c, color001 c, color010 c, color011 c, "
     "color100 c, color101 c, color110 c, color111 c"},
    {"mib_texture_filter_lookup", 3,
     "tex tex, coord v, eccmax s, maxminor s, disc_r s, bilinear b, space i, remap sh"},
    {"mib_texture_lookup2", 1, "tex tex, factor s"},
    {"mib_texture_polkadot", 1, "coord v, radius s, fgcolor c, bgcolor c"},
    {"mib_texture_polkasphere", 1, "coord v, radius s, fgcolor c, bgcolor c"},
    {"mib_texture_rotate", 1, "input v, angle s, min s, max s"},
    {"mib_texture_turbulence", 1,
     "coord v, spacing s, strength s, power s, iteration i, polar_dim i"},
    {"mib_texture_wave", 1, "coord v, amplitude_x s, amplitude_y s, amplitude_z s, offset s"},
    {"mib_shadow_transparency", 1, "color c, transp c, mode i, lights L"},
    {"mib_texture_lookup", 1, "tex tex, coord v"},
    {"mib_texture_vector", 2, "select i, selspace i, vertex i, project i"},
    {"mib_texture_remap", 1,
     "input v, transform t, repeat v, alt_x b, alt_y b, alt_z b, torus_x b, torus_y b, torus_z b, "
     "min v, max v, offset v"},
    {"mib_lookup_spherical", 1, "dir v, rotate s, tex tex"},
    {"mib_lookup_background", 1, "zoom v, pan v, torus_u b, torus_v b, tex tex"},
    {"physical_light", 3, "color c, cone s, threshold s, cos_exp s"},
    {"mib_light_infinite", 1, "color c, shadow b, factor s"},
    {"mib_light_point", 1, "color c, shadow b, factor s, atten b, start s, stop s"},
    {"mib_light_spot", 1, "color c, shadow b, factor s, atten b, start s, stop s, cone s"},
};

TEST(Declarations, OcclusionAndGlossyNodesAreTheDeclaredTables) {
  EXPECT_EQ(table_of("mib_amb_occlusion"), kAmbOcclusionTable);
  EXPECT_EQ(table_of("mib_glossy_reflection"), kGlossyReflectionTable);
  EXPECT_EQ(table_of("mib_glossy_refraction"), kGlossyRefractionTable);
  EXPECT_EQ(table_of("mib_bent_normal_env"), kBentNormalEnvTable);
  EXPECT_EQ(table_of("mib_fg_occlusion"), "\nresult_when_fg_is_off | color | 1 1 1\n");
  EXPECT_EQ(table_of("mib_lightmap_write"),
            "\ntexture | color texture | -\ncoord | shader | -\ninput | shader | -\n"
            "fg_mode | integer | 3\n");
  EXPECT_EQ(spec_of("mib_lightmap_write").version, 2);
  EXPECT_EQ(spec_of("mib_amb_occlusion").version, 2);
  EXPECT_EQ(spec_of("mib_glossy_reflection").version, 3);
}

/// Abbreviates types as in the table above.
const char* letter_of(const ParamSpec& p) {
  static const std::map<ParamType, const char*> kLetters = {
      {ParamType::Color, "c"},          {ParamType::Vector, "v"},
      {ParamType::Scalar, "s"},         {ParamType::Integer, "i"},
      {ParamType::Boolean, "b"},        {ParamType::Transform, "t"},
      {ParamType::ColorTexture, "tex"}, {ParamType::ScalarTexture, "stex"},
      {ParamType::Shader, "sh"}};
  if (p.type == ParamType::Array) return p.element == ParamType::Light ? "L" : "?";
  const auto letter = kLetters.find(p.type);
  return letter == kLetters.end() ? "?" : letter->second;
}

TEST(Declarations, BaseShadersHaveTheirParametersInOrder) {
  for (const PlainInterface& row : kBase) {
    std::string text;
    for (const ParamSpec& p : spec_of(row.shader).params) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", p.name, letter_of(p));
      EXPECT_EQ(p.fallback, (std::array<float, 4>{})) << row.shader << '.' << p.name;
    }
    EXPECT_EQ(text, row.parameters) << row.shader;
    EXPECT_EQ(spec_of(row.shader).version, row.version) << row.shader;
  }
}

}  // namespace base_declarations_test
}  // namespace oriel
