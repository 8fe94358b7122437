// SPDX-License-Identifier: Apache-2.0
// Declarations by name, for compatibility with scenes and exporters.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>
#include <string_view>

#include "runtime/shader_node.h"
#include "shaders/registry.h"
#include "shaders/testing/declared.h"

namespace oriel {
namespace declarations_test {

// One line per parameter: name | type | declared default, "-" if the declaration has none. In the
// order of the declaration; additions of later editions are last.
// Source:  manual and declarations of the library in later editions and scenes.
constexpr std::string_view kMiaMaterialXTable = R"(
diffuse_weight | scalar | 1
diffuse | color | 0.5 0.5 0.5
diffuse_roughness | scalar | 0
reflectivity | scalar | 0.6
refl_color | color | 1 1 1
refl_gloss | scalar | 1
refl_gloss_samples | integer | 8
refl_interpolate | boolean | off
refl_hl_only | boolean | off
refl_is_metal | boolean | off
transparency | scalar | 0
refr_color | color | 1 1 1
refr_gloss | scalar | 1
refr_ior | scalar | 1.4
refr_gloss_samples | integer | 8
refr_interpolate | boolean | off
refr_translucency | boolean | off
refr_trans_color | color | 0.7 0.6 0.5
refr_trans_weight | scalar | 0.5
anisotropy | scalar | 1
anisotropy_rotation | scalar | 0
anisotropy_channel | integer | -1
brdf_fresnel | boolean | off
brdf_0_degree_refl | scalar | 0.2
brdf_90_degree_refl | scalar | 1
brdf_curve | scalar | 5
brdf_conserve_energy | boolean | on
intr_grid_density | integer | 2
intr_refl_samples | integer | 2
intr_refl_ddist_on | boolean | off
intr_refl_ddist | scalar | 0
intr_refr_samples | integer | 2
single_env_sample | boolean | off
refl_falloff_on | boolean | off
refl_falloff_dist | scalar | 0
refl_falloff_color_on | boolean | off
refl_falloff_color | color | 0 0 0
refl_depth | integer | 5
refl_cutoff | scalar | 0.01
refr_falloff_on | boolean | off
refr_falloff_dist | scalar | 0
refr_falloff_color_on | boolean | off
refr_falloff_color | color | 0 0 0
refr_depth | integer | 5
refr_cutoff | scalar | 0.01
indirect_multiplier | scalar | 1
fg_quality | scalar | 1
fg_quality_w | scalar | 1
ao_on | boolean | off
ao_samples | integer | 16
ao_distance | scalar | 10
ao_dark | color | 0.2 0.2 0.2
ao_ambient | color | 0 0 0
ao_do_details | integer | 1
thin_walled | boolean | off
no_visible_area_hl | boolean | on
skip_inside_refl | boolean | on
do_refractive_caustics | boolean | off
backface_cull | boolean | off
propagate_alpha | boolean | off
hl_vs_refl_balance | scalar | 1
cutout_opacity | scalar | 1
additional_color | color | 0 0 0
bump | shader | -
no_diffuse_bump | boolean | off
mode | integer | 4
lights | array light | -
bump_mode | integer | 5
overall_bump | vector | 0 0 0
standard_bump | vector | 0 0 0
multiple_outputs | boolean | on
refl_base | scalar | 0
refl_base_color | color | 1 0.3 0
refl_base_gloss | scalar | 1
refl_base_gloss_samples | integer | 8
refl_base_bump | vector | 0 0 0
)";
constexpr std::string_view kPhysicalSunTable = R"(
on | boolean | on
multiplier | scalar | 1
rgb_unit_conversion | color | 0.0001 0.0001 0.0001
haze | scalar | 0
redblueshift | scalar | 0
saturation | scalar | 1
horizon_height | scalar | 0
shadow_softness | scalar | 1
samples | integer | 8
photon_bbox_min | vector | -
photon_bbox_max | vector | -
automatic_photon_energy | boolean | -
y_is_up | boolean | -
illuminance_mode | integer | 0
direct_normal_illuminance | scalar | 0
flags | integer | -
)";  // flags: extension of Oriel, at the end
constexpr std::string_view kPhysicalSkyTable = R"(
on | boolean | on
multiplier | scalar | 1
rgb_unit_conversion | color | 0.0001 0.0001 0.0001
haze | scalar | 0
redblueshift | scalar | 0
saturation | scalar | 1
horizon_height | scalar | 0
horizon_blur | scalar | 0.1
ground_color | color | 0.2 0.2 0.2
night_color | color | 0 0 0
sun_direction | vector | -
sun | light | -
sun_disk_intensity | scalar | 1
sun_disk_scale | scalar | 4
sun_glow_intensity | scalar | 1
use_background | boolean | -
background | shader | -
visibility_distance | scalar | -
y_is_up | boolean | -
flags | integer | -
sky_luminance_mode | integer | 0
zenith_luminance | scalar | 0
diffuse_horizontal_illuminance | scalar | 0
a | scalar | -
b | scalar | -
c | scalar | -
d | scalar | -
e | scalar | -
physically_scaled_sun | boolean | -
)";

constexpr std::string_view kCieSkyTable = R"(
on | boolean | on
rgb_unit_conversion | color | 0.0001 0.0001 0.0001
auto_luminance | boolean | on
zenith_luminance | scalar | 0
diffuse_horizontal_illuminance | scalar | 0
overcast | scalar | 0
sun_direction | vector | -
sun | light | -
y_is_up | boolean | -
)";
constexpr std::string_view kPortalTable = R"(
on | boolean | on
multiplier | scalar | 1
tint_color | color | 1 1 1
reverse | boolean | off
cutoff_threshold | scalar | 0.005
shadows | boolean | on
use_custom_environment | boolean | off
custom_environment | shader | -
visible | boolean | off
lookup_using_fg_rays | boolean | on
shadow_ray_extension | scalar | 0
emit_direct_photons | boolean | off
transparency | color | 1 1 1
)";
constexpr std::string_view kPhotographicTable = R"(
cm2_factor | scalar | 1
whitepoint | color | 1 1 1
film_iso | scalar | 100
camera_shutter | scalar | 100
f_number | scalar | 16
vignetting | scalar | 1
burn_highlights | scalar | 0
crush_blacks | scalar | 0.25
saturation | scalar | 1
gamma | scalar | 2.2
side_channel_mode | integer | 0
side_channel | string | -
preview | color texture | -
use_preview | boolean | -
)";
constexpr std::string_view kLensBokehTable = R"(
on | boolean | on
plane | scalar | 100
radius | scalar | 1
samples | integer | 4
bias | scalar | 1
blade_count | integer | 0
blade_angle | scalar | 0
use_bokeh | boolean | off
bokeh | color texture | -
)";

constexpr std::string_view kSimpleTable = R"(
pedestal | scalar | 0
gain | scalar | 1
knee | scalar | 0.5
compression | scalar | 2
gamma | scalar | 2.2
preview | color texture | -
use_preview | boolean | -
)";

TEST(Declarations, MaterialXIsTheDeclaredTable) {
  EXPECT_EQ(table_of("mia_material_x"), kMiaMaterialXTable);
  EXPECT_EQ(table_of("mia_material_x_passes"), kMiaMaterialXTable);
}

TEST(Declarations, MaterialIsTheFirstSixtySevenRows) {
  const std::string whole(kMiaMaterialXTable);
  EXPECT_EQ(table_of("mia_material"), whole.substr(0, whole.find("bump_mode")));
  EXPECT_EQ(spec_of("mia_material").params.size(), 67u);
}

TEST(Declarations, SunSkyPortalAndExposuresAreTheDeclaredTables) {
  EXPECT_EQ(table_of("mia_physicalsun"), kPhysicalSunTable);
  EXPECT_EQ(table_of("mia_physicalsky"), kPhysicalSkyTable);
  EXPECT_EQ(table_of("mia_ciesky"), kCieSkyTable);
  EXPECT_EQ(table_of("mia_portal_light"), kPortalTable);
  EXPECT_EQ(table_of("mia_exposure_photographic"), kPhotographicTable);
  EXPECT_EQ(table_of("mia_exposure_simple"), kSimpleTable);
  EXPECT_EQ(table_of("mia_lens_bokeh"), kLensBokehTable);
}

TEST(Declarations, VersionsAreThoseOfTheLibrary) {
  EXPECT_GE(spec_of("mia_material_x").version, 15);
  EXPECT_EQ(spec_of("mia_physicalsun").version, 6);
  EXPECT_EQ(spec_of("mia_physicalsky").version, 5);
  EXPECT_EQ(spec_of("mia_portal_light").version, 9);
  EXPECT_EQ(spec_of("mia_exposure_photographic").version, 4);
  EXPECT_EQ(spec_of("mia_exposure_simple").version, 1);
  EXPECT_EQ(spec_of("mia_lens_bokeh").version, 4);
}

// Requirements for all parameter tables.
TEST(Declarations, AllTablesAreValid) {
  std::set<std::string> shaders;
  for (const ShaderSpec* spec : builtin_shaders().all()) {
    EXPECT_TRUE(shaders.insert(spec->name).second) << spec->name;
    EXPECT_GT(std::strlen(spec->doc), 0u) << spec->name;
    EXPECT_NE(spec->apply, 0u) << spec->name;
    EXPECT_LE(spec->params_size, kMaxParamBytes) << spec->name;
    EXPECT_LE(spec->result_size, kMaxParamBytes) << spec->name;
    EXPECT_TRUE(spec->value || spec->material.fill || spec->light.evaluate || spec->light.portal ||
                spec->lens.map_color || spec->lens.bend_ray || spec->material.shadow ||
                spec->volume.evaluate || spec->fallback.is_fallback)
        << spec->name;
    std::set<std::string> names;
    for (const ParamSpec& p : spec->params) {
      const std::string what = fmt::format("{}.{}", spec->name, p.name);
      EXPECT_TRUE(names.insert(p.name).second) << what;
      if (p.alias) {
        EXPECT_TRUE(names.insert(p.alias).second) << what;
      }
      EXPECT_GT(std::strlen(p.doc), 0u) << what;
      EXPECT_LE(p.offset + size_of(p.type), spec->params_size) << what;
      if (p.type == ParamType::Scalar || p.type == ParamType::Integer) {
        EXPECT_GE(p.fallback[0], p.declared_default ? p.min : p.fallback[0]) << what;
        EXPECT_LE(p.fallback[0], p.max) << what;
      }
    }
    for (const ParamSpec& r : spec->results)
      EXPECT_LE(r.offset + size_of(r.type), spec->result_size) << spec->name << '.' << r.name;
    EXPECT_EQ(spec->results.empty(), spec->result != ParamType::Struct) << spec->name;
  }
}

}  // namespace declarations_test
}  // namespace oriel
