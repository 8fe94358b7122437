// SPDX-License-Identifier: Apache-2.0
// Exchange of results and light data between shaders and mia_material.
#ifndef ORIEL_SDK_MIA_MATERIAL_API_H
#define ORIEL_SDK_MIA_MATERIAL_API_H

// Conventions
//   Results: set struct_size and in_use = miFALSE, store the struct in the shader state under
//   miA_MATERIAL_API_STORAGE with lifetime 0, call the material, get the struct back: in_use tells
//   whether it was filled. struct_size distinguishes the two structs. Light data: a material stores
//   it before each light sample; a light shader that finds it may change the last four members.
//   _raw: light without the surface colour, _level: the colour, _result: their product.

#include "shader.h"

#define miA_MATERIAL_API_STORAGE "miXMST"
#define miA_MATERIAL_API_LIGHTDATA "miXMLD"

typedef struct mia_material_api_storage {
  miUint struct_size;
  miBoolean in_use;
  miScalar opacity;
  miColor indir_result;
  miColor diff_result;
  miColor spec_result;
  miColor tran_result;
  miColor refl_result;
  miColor refr_result;
  miColor add_result;
  miColor ao_result;
  miColor diff_level;
  miColor refl_level;
  miColor refr_level;
  miColor tran_level;
  miRay_type type;
} mia_material_api_storage;

/// Outputs of mia_material_x.
typedef struct mia_material_x_return {
  miColor result;
  miColor diffuse_result, diffuse_raw, diffuse_level;
  miColor spec_result, spec_raw, spec_level;
  miColor refl_result, refl_raw, refl_level;
  miColor refr_result, refr_raw, refr_level;
  miColor tran_result, tran_raw, tran_level;
  miColor indirect_result, indirect_raw, indirect_cooked;
  miColor ao_raw;
  miColor add_result;
  miColor opacity_result, opacity_raw;
  miScalar opacity;
  miColor spare[2];
} mia_material_x_return;

typedef struct mia_material_x_api_storage {
  miUint struct_size;
  miBoolean in_use;
  miRay_type type;
  mia_material_x_return output;
} mia_material_x_api_storage;

typedef struct mia_material_api_lightdata {
  miUint struct_size;
  miScalar glossiness;       ///< of the surface; read only
  miScalar importance;       ///< of the light sample; read only
  miScalar affect_diffuse;   ///< share of the light for diffuse reflection, initially 1
  miScalar affect_specular;  ///< share of the light for highlights, initially 1
  miBoolean is_mr_sun;       ///< only set by mia_physicalsun
  miBoolean force_specular;  ///< highlights even if the light itself is visible
} mia_material_api_lightdata;

#endif
