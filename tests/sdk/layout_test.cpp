// SPDX-License-Identifier: Apache-2.0
// Member order of the public structs, and values of enums.
#include <gtest/gtest.h>
#include <mia_material_api.h>

#include <cstddef>
#include <vector>

#include "geoshader.h"
#include "shader.h"

namespace oriel {
namespace {

#define AT(type, member) offsetof(type, member)

void expect_order(const std::vector<std::size_t>& offsets) {
  for (std::size_t i = 1; i < offsets.size(); ++i)
    EXPECT_LT(offsets[i - 1], offsets[i]) << "member " << i;
}

TEST(SdkTypes, SizesAreThoseOfParameters) {
  EXPECT_EQ(sizeof(miBoolean), 4u);
  EXPECT_EQ(sizeof(miCBoolean), 1u);
  EXPECT_EQ(sizeof(miInteger), 4u);
  EXPECT_EQ(sizeof(miScalar), 4u);
  EXPECT_EQ(sizeof(miGeoScalar), 8u);
  EXPECT_EQ(sizeof(miTag), 4u);
  EXPECT_EQ(sizeof(miUint), 4u);
  EXPECT_EQ(sizeof(miIndex), 2u);
  EXPECT_EQ(sizeof(miColor), 16u);
  EXPECT_EQ(sizeof(miVector), 12u);
  EXPECT_EQ(sizeof(miVector2d), 8u);
  EXPECT_EQ(sizeof(miGeoVector), 24u);
  EXPECT_EQ(sizeof(miQuaternion), 16u);
  EXPECT_EQ(sizeof(miMatrix), 64u);
  EXPECT_EQ(sizeof(miSpectrum_para), 296u);
  EXPECT_EQ(sizeof(miPointer), 8u);
  EXPECT_EQ(sizeof(miLock), 8u);
  EXPECT_EQ(sizeof(miIntptr), sizeof(void*));
  EXPECT_EQ(sizeof(miRay_type), 4u);
}

TEST(SdkTypes, ConstantsHaveTheirValues) {
  EXPECT_EQ(miNULLTAG, 0u);
  EXPECT_EQ(miNOLIGHTS, 0xffffffffu);
  EXPECT_EQ(miGHOSTTAG, 0xffffffffu);
  EXPECT_EQ(miHUGE_INT, 2147483647);
  EXPECT_FLOAT_EQ(miSCALAR_EPSILON, 1e-5f);
  EXPECT_DOUBLE_EQ(miGEO_SCALAR_EPSILON, 1e-9);
  EXPECT_FLOAT_EQ(miHUGE_SCALAR, 1e36f);
  EXPECT_EQ(MAX_TEX, 64);
  EXPECT_EQ(NO_DERIVS, 5);
  EXPECT_EQ(miNAMESIZE, 80);
  EXPECT_EQ(miPATHSIZE, 1024);
}

/// One member of each type of a declaration, in this order.
struct EveryType {
  miBoolean a_boolean;
  miColor a_color;
  miInteger an_integer;
  miVector a_vector;
  miTag a_string;
  miMatrix a_transform;
  miScalar a_scalar;
  miTag a_texture;
  miSpectrum_para a_spectrum;
  struct {
    miScalar first;
    miColor second;
  } a_struct;
  int i_colors, n_colors;
  miColor colors[1];
  miBoolean last;
};

TEST(SdkParameters, StructsHaveNoPadding) {
  EXPECT_EQ(AT(EveryType, a_color), 4u);
  EXPECT_EQ(AT(EveryType, an_integer), 20u);
  EXPECT_EQ(AT(EveryType, a_vector), 24u);
  EXPECT_EQ(AT(EveryType, a_string), 36u);
  EXPECT_EQ(AT(EveryType, a_transform), 40u);
  EXPECT_EQ(AT(EveryType, a_scalar), 104u);
  EXPECT_EQ(AT(EveryType, a_texture), 108u);
  EXPECT_EQ(AT(EveryType, a_spectrum), 112u);
  EXPECT_EQ(AT(EveryType, a_struct), 408u);
  EXPECT_EQ(AT(EveryType, i_colors), 428u);
  EXPECT_EQ(AT(EveryType, n_colors), 432u);
  EXPECT_EQ(AT(EveryType, colors), 436u);
  EXPECT_EQ(AT(EveryType, last), 452u);
  EXPECT_EQ(sizeof(EveryType), 456u);
  EXPECT_EQ(alignof(EveryType), 4u);
}

TEST(SdkParameters, AFunctionsParametersAreAligned) {
  EXPECT_EQ(AT(miFunction, parameters) % 4, 0u);
  EXPECT_EQ(AT(miUserdata, parameters) % 4, 0u);
}

#define S(member) AT(miState, member)
TEST(SdkState, MembersAreInOrder) {
  EXPECT_EQ(S(version), 0u);
  expect_order({S(version),
                S(camera_inst),
                S(camera),
                S(options),
                S(global_lock),
                S(qmc_instance),
                S(raster_x),
                S(raster_y),
                S(parent),
                S(type),
                S(qmc_component),
                S(scanline),
                S(inv_normal),
                S(face),
                S(cache),
                S(reflection_level),
                S(refraction_level),
                S(org),
                S(dir),
                S(dist),
                S(time),
                S(ior),
                S(ior_in),
                S(material),
                S(volume),
                S(environment),
                S(refraction_volume),
                S(label),
                S(instance),
                S(light_instance),
                S(pri),
                S(importance),
                S(bary),
                S(point),
                S(normal),
                S(normal_geom),
                S(dot_nd),
                S(shadow_tol),
                S(tex_list),
                S(bump_x_list),
                S(bump_y_list),
                S(motion),
                S(derivs),
                S(tex),
                S(shader),
                S(child),
                S(thread),
                S(count),
                S(user),
                S(user_size)});
}
#undef S

#define O(member) AT(miOptions, member)
TEST(SdkOptions, MembersAreInOrder) {
  expect_order({O(trace),
                O(scanline),
                O(motion),
                O(reflection_depth),
                O(refraction_depth),
                O(trace_depth),
                O(min_samples),
                O(max_samples),
                O(contrast),
                O(time_contrast),
                O(caustic),
                O(globillum),
                O(caustic_accuracy),
                O(globillum_accuracy),
                O(photonvol_accuracy),
                O(caustic_radius),
                O(globillum_radius),
                O(photonvol_radius),
                O(caustic_filter_const),
                O(filter_size_x),
                O(filter_size_y),
                O(jitter),
                O(shutter),
                O(shutter_delay),
                O(no_images),
                O(images_info),
                O(finalgather),
                O(finalgather_rays),
                O(finalgather_maxradius),
                O(finalgather_minradius),
                O(finalgather_view),
                O(finalgather_filter),
                O(fg_reflection_depth),
                O(fg_refraction_depth),
                O(fg_trace_depth),
                O(fg_diffuse_depth),
                O(fg_falloff_start),
                O(fg_falloff_stop),
                O(caustic_scale),
                O(globillum_scale),
                O(finalgather_scale),
                O(finalgather_sec_scale),
                O(photonvol_scale),
                O(shadow),
                O(face),
                O(filter),
                O(acceleration),
                O(field),
                O(smethod),
                O(render_space),
                O(use_shadow_maps),
                O(visible_lights),
                O(photon_reflection_depth),
                O(photon_refraction_depth),
                O(photon_trace_depth),
                O(no_lens),
                O(no_volume),
                O(no_geometry),
                O(no_displace),
                O(no_output),
                O(no_merge),
                O(no_hair),
                O(no_pass),
                O(autovolume),
                O(photon_autovolume),
                O(photonmap_only),
                O(desaturate),
                O(dither),
                O(nopremult),
                O(colorclip),
                O(gamma),
                O(luminance_weight),
                O(maxdisplace),
                O(userdata),
                O(string_options),
                O(irradiance_particles)});
}
#undef O

#define C(member) AT(miCamera, member)
TEST(SdkCamera, MembersAreInOrder) {
  expect_order({C(orthographic), C(focal),        C(aperture), C(aspect),   C(clip),
                C(x_resolution), C(y_resolution), C(window),   C(volume),   C(environment),
                C(lens),         C(output),       C(pass),     C(frame),    C(frame_time),
                C(frame_field),  C(x_offset),     C(y_offset), C(userdata), C(buffertag),
                C(focus),        C(radius)});
}
#undef C

#define L(member) AT(miLight, member)
TEST(SdkLight, MembersAreInOrder) {
  expect_order({L(type),
                L(area),
                L(exponent),
                L(caustic_store_photons),
                L(global_store_photons),
                L(energy),
                L(shader),
                L(emitter),
                L(origin),
                L(direction),
                L(spread),
                L(primitive),
                L(samples_u),
                L(samples_v),
                L(low_samples_u),
                L(low_samples_v),
                L(low_level),
                L(shadowmap_flags),
                L(dirlight_has_org),
                L(use_shadow_maps),
                L(shadowmap_file),
                L(shadowmap_resolution),
                L(shadowmap_softness),
                L(shadowmap_samples),
                L(visible),
                L(label),
                L(userdata),
                L(caustic_emit_photons),
                L(global_emit_photons),
                L(hardware),
                L(shmap_h_min),
                L(shmap_h_max),
                L(shmap_v_min),
                L(shmap_v_max),
                L(emitter_spectrum),
                L(shadowmap_bias),
                L(shmap),
                L(lightprofile),
                L(use_lprof),
                L(photons_only)});
}
#undef L

#define I(member) AT(miInstance, member)
TEST(SdkInstance, MembersAreInOrder) {
  expect_order({I(tf.function),
                I(tf.time),
                I(tf.global_to_local),
                I(tf.local_to_global),
                I(tf.identity),
                I(tf.id),
                I(motion_transform),
                I(item),
                I(material),
                I(parent),
                I(boxes),
                I(next),
                I(prev),
                I(mtl_array_size),
                I(light_obj_ring),
                I(userdata),
                I(label),
                I(geogroup),
                I(off),
                I(gen_motion),
                I(visible),
                I(shadow),
                I(reflection),
                I(refraction),
                I(transparency),
                I(caustic),
                I(globillum),
                I(finalgather),
                I(face),
                I(select),
                I(mtl_override),
                I(history_size),
                I(approx_list),
                I(approx_override),
                I(hardware),
                I(shadowmap),
                I(exclusive),
                I(light_list)});
}
#undef I

#define M(member) AT(miMaterial, member)
TEST(SdkMaterial, MembersAreInOrder) {
  expect_order({M(opaque), M(shader), M(displace), M(shadow), M(volume), M(environment), M(contour),
                M(photon), M(photonvol), M(lightmap), M(hardware)});
}
#undef M

TEST(SdkFunction, MembersAreInOrder) {
  expect_order({AT(miFunction, type), AT(miFunction, function_decl), AT(miFunction, next_function),
                AT(miFunction, parameter_indirect), AT(miFunction, interfacephen),
                AT(miFunction, parameter_size), AT(miFunction, result_size),
                AT(miFunction, ghost_offs), AT(miFunction, parameters)});
  expect_order({AT(miUserdata, data_decl), AT(miUserdata, next_data), AT(miUserdata, label),
                AT(miUserdata, parameter_size), AT(miUserdata, parameters)});
  expect_order({AT(miPri_data, info_size), AT(miPri_data, info), AT(miPri_data, data_size),
                AT(miPri_data, data)});
}

TEST(SdkOptionStructs, DefaultsAreFilledIn) {
  miOptions options = {};
  options.finalgather_rays = 77;
  options.caustic_radius = 3;
  miState state = {};
  state.options = &options;
  state.normal.z = 1;
  miIrrad_options irradiance;
  miIRRAD_DEFAULT(&irradiance, &state);
  EXPECT_EQ(irradiance.size, static_cast<int>(sizeof irradiance));
  EXPECT_EQ(irradiance.finalgather_rays, 77);
  EXPECT_EQ(irradiance.caustic_radius, 3);
  EXPECT_EQ(irradiance.finalgather_points, 0);
  EXPECT_EQ(irradiance.importance, -1);
  miAmboccl_options occlusion;
  miAMBOCCL_DEFAULT(&occlusion, &state);
  EXPECT_EQ(occlusion.axis.z, 1);
  EXPECT_EQ(occlusion.spread, -2);
  EXPECT_EQ(occlusion.spread_exp, 1);
  EXPECT_EQ(occlusion.rays, -1);
  EXPECT_EQ(occlusion.cache_points, -1);
}

// acceptance: I1
TEST(MiaMaterialApi, StructsAreThoseOfTheManual) {
  EXPECT_STREQ(miA_MATERIAL_API_STORAGE, "miXMST");
  EXPECT_STREQ(miA_MATERIAL_API_LIGHTDATA, "miXMLD");
  // 3 numbers, 12 colours, a ray type; 23 colours with opacity in front of the two spare ones.
  EXPECT_EQ(sizeof(mia_material_api_storage), 12u + 12 * 16 + 4);
  EXPECT_EQ(AT(mia_material_api_storage, indir_result), 12u);
  EXPECT_EQ(AT(mia_material_api_storage, ao_result), 12u + 7 * 16);
  EXPECT_EQ(AT(mia_material_api_storage, tran_level), 12u + 11 * 16);
  EXPECT_EQ(AT(mia_material_x_return, spec_raw), 5u * 16);
  EXPECT_EQ(AT(mia_material_x_return, ao_raw), 19u * 16);
  EXPECT_EQ(AT(mia_material_x_return, opacity), 23u * 16);
  EXPECT_EQ(sizeof(mia_material_x_return), 23u * 16 + 4 + 2 * 16);
  EXPECT_EQ(AT(mia_material_x_api_storage, output), 12u);
  EXPECT_EQ(AT(mia_material_api_lightdata, affect_diffuse), 12u);
  EXPECT_EQ(AT(mia_material_api_lightdata, force_specular), 24u);
  EXPECT_EQ(sizeof(mia_material_api_lightdata), 28u);
}

}  // namespace
}  // namespace oriel
