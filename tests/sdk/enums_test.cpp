// SPDX-License-Identifier: Apache-2.0
// Enums and macros of the shader headers have the values that shaders rely on.
#include <gtest/gtest.h>

#include "shader.h"

namespace oriel {
namespace {

TEST(SdkEnums, RayTypesAreThoseShadersCompare) {
  EXPECT_EQ(miRAY_EYE, 0);
  EXPECT_EQ(miRAY_LIGHT, 4);
  EXPECT_EQ(miRAY_NONE, 7);
  EXPECT_EQ(miPHOTON_ABSORB, 8);
  EXPECT_EQ(miPHOTON_TRANSMIT_DIFFUSE, 15);
  EXPECT_EQ(miRAY_DISPLACE, 16);
  EXPECT_EQ(miPHOTON_SCATTER_VOLUME, 18);
  EXPECT_EQ(miRAY_FINALGATHER, 20);
  EXPECT_EQ(miPHOTON_EMIT_CAUSTIC, 24);
  EXPECT_EQ(miPHOTON_HULL, 27);
  EXPECT_EQ(miRAY_NO_TYPES, 28);
}

/// The types for which the class of rays holds, as bits.
template <class F>
unsigned bits(F&& holds) {
  unsigned found = 0;
  for (int t = 0; t < miRAY_NO_TYPES; ++t)
    if (holds(t)) found |= 1u << t;
  return found;
}

TEST(SdkEnums, RayClassesHoldForTheirTypes) {
  EXPECT_EQ(bits([](int t) { return miRAY_PRIMARY(t); }), 1u);
  const unsigned secondary = 0xfeu | 1u << miRAY_FINALGATHER | 1u << miRAY_HULL;
  EXPECT_EQ(bits([](int t) { return miRAY_SECONDARY(t); }), secondary);
  const unsigned photon = 0xff00u | 1u << miPHOTON_SCATTER_VOLUME | 1u << miPHOTON_TRANSPARENT |
                          1u << miPHOTON_EMIT_GLOBILLUM | 1u << miPHOTON_EMIT_CAUSTIC |
                          1u << miPHOTON_HULL;
  EXPECT_EQ(bits([](int t) { return miRAY_PHOTON(t); }), photon);
}

TEST(SdkEnums, SceneTypesCountAsKnown) {
  EXPECT_EQ(miSCENE_NONE, 0);
  EXPECT_EQ(miSCENE_LIGHT, 4);
  EXPECT_EQ(miSCENE_INSTANCE, 10);
  EXPECT_EQ(miSCENE_GEOVECTOR, 20);
  EXPECT_EQ(miSCENE_SPACECURVE, 30);
  EXPECT_EQ(miSCENE_NBOX, 40);
  EXPECT_EQ(miSCENE_COLORPROFILE, 50);
  EXPECT_EQ(miSCENE_ASSEMBLY, 54);
}

TEST(SdkEnums, OtherKindsCountAsKnown) {
  EXPECT_EQ(miSHADER_LENS, 0);
  EXPECT_EQ(miSHADER_OUTPUT, 11);
  EXPECT_EQ(miSHADER_NO_TYPES, 17);
  EXPECT_EQ(miAPPLY_STATE, 1 << 15);
  EXPECT_EQ(miLIGHT_SPOT, 2);
  EXPECT_EQ(miLIGHT_USER, 6);
  EXPECT_EQ(miFUNCTION_HARDWARE, 9);
  EXPECT_EQ(miTYPE_INVALID, -1);
  EXPECT_EQ(miTYPE_BOOLEAN, 0);
  EXPECT_EQ(miTYPE_ARRAY, 13);
  EXPECT_EQ(miNTYPES, 20);
  EXPECT_EQ(miSHADERSTATE_SAMPLE_EXIT, 3);
  EXPECT_EQ(miFG_STORE_SET, 2);
  EXPECT_EQ(miSTAGE_PHOTON_EMIT, 24);
  EXPECT_EQ(miSTAGE_LIGHTMAP, 64);
  EXPECT_EQ(miRENDER_FH_RAST, 'r');
  EXPECT_EQ(miSS_LIFETIME_EYERAY, 1);
  EXPECT_EQ(miSS_LIFETIME_RECT, 2);
}

TEST(SdkEnums, ImagesCountAsKnown) {
  EXPECT_EQ(miIMG_TYPE_RGBA_FP, 13);
  EXPECT_EQ(miIMG_TYPE_RGB_H, 22);
  EXPECT_EQ(miIMG_TYPE_ANY, 30);
  EXPECT_EQ(miIMG_FORMAT_CUSTOM_15, 57);
  EXPECT_EQ(miIMG_FORMAT_EXR, 60);
  EXPECT_EQ(miIMG_FORMAT_FROM_EXT, 255);
  EXPECT_EQ(miIMG_ERR_SIZE, 13);
  EXPECT_EQ(miRC_IMAGE_USER, 12);
}

TEST(SdkVectors, MacrosComputeTheNamedOperation) {
  miVector a = {1, 2, 3}, b = {4, -5, 6}, c = {0, 1, 2}, r;
  EXPECT_EQ(mi_vector_dot(&a, &b), 12);
  mi_vector_prod(&r, &a, &b);
  EXPECT_EQ(r.x, 27);
  EXPECT_EQ(r.y, 6);
  EXPECT_EQ(r.z, -13);
  EXPECT_EQ(mi_vector_det(&a, &b, &c), -20);
  EXPECT_FLOAT_EQ(mi_vector_dist(&a, &b), std::sqrt(67.0f));
  mi_vector_min(&r, &a, &b);
  EXPECT_EQ(r.y, -5);
  mi_vector_max(&r, &a, &b);
  EXPECT_EQ(r.y, 2);
  mi_vector_sub(&r, &a, &b);
  mi_vector_neg(&r);
  mi_vector_add(&r, &r, &a);
  EXPECT_EQ(r.z, 6);
  mi_vector_normalize(&r);
  EXPECT_FLOAT_EQ(mi_vector_norm(&r), 1);
  r = {0, 0, 0};
  mi_vector_normalize(&r);
  EXPECT_EQ(r.x, 0);
  mi_vector_div(&a, 0);
  EXPECT_EQ(a.x, 1);
  mi_vector_div_d(&a, 2);
  EXPECT_EQ(a.z, 1.5f);
  miGeoVector g = {3, 0, 4};
  EXPECT_EQ(mi_vector_norm_d(&g), 5);
  mi_vector_normalize_d(&g);
  EXPECT_DOUBLE_EQ(g.z, .8);
}

}  // namespace
}  // namespace oriel
