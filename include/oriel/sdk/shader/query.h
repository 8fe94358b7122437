// SPDX-License-Identifier: Apache-2.0
// Queries: mi_query.
#ifndef ORIEL_SDK_QUERY_H
#define ORIEL_SDK_QUERY_H

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Queries of mi_query; each comment is the type of the variable that `result` points to.
typedef enum miQ_type {
  // Shader calls and declarations: of the running shader, or by tag.
  miQ_FUNC_USERPTR = 100,  ///< void **, address of the instance's user pointer
  miQ_FUNC_LOCK,           ///< miLock *
  miQ_FUNC_TAG,            ///< miTag
  miQ_FUNC_DECL,           ///< miTag
  miQ_FUNC_NEXT,           ///< miTag
  miQ_FUNC_INDIRECT,       ///< miTag
  miQ_FUNC_TYPE,           ///< int, 0 C, 1 phenomenon, 2 file
  miQ_FUNC_PARAM,          ///< void *
  miQ_FUNC_PARAM_SIZE,     ///< int, bytes
  miQ_FUNC_RESULT_SIZE,    ///< int, bytes
  miQ_FUNC_CALLTYPE,       ///< int, miSHADER_*
  miQ_FUNC_TLS_GET,        ///< void *, this thread's pointer
  miQ_FUNC_TLS_SET,        ///< void *
  miQ_FUNC_TLS_GETALL,     ///< void **, int *: all threads' pointers
  miQ_FUNC_IS_ROOT,        ///< miBoolean
  miQ_DECL_LOCK = 120,     ///< miLock *
  miQ_DECL_NAME,           ///< char *
  miQ_DECL_PARAM,          ///< char *
  miQ_DECL_TYPE,           ///< int, miParam_type of the result
  miQ_DECL_RESULT_SIZE,    ///< int, bytes
  miQ_DECL_VERSION,        ///< int
  // Instances and groups, by tag.
  miQ_INST_ITEM = 200,        ///< miTag
  miQ_INST_PARENT,            ///< miTag
  miQ_INST_MATERIAL,          ///< miTag
  miQ_INST_FUNCTION,          ///< miTag
  miQ_INST_DECL,              ///< miTag
  miQ_INST_DATA,              ///< miTag
  miQ_INST_PLACEHOLDER_ITEM,  ///< miTag
  miQ_INST_GLOBAL_TO_LOCAL,   ///< miMatrix *
  miQ_INST_LOCAL_TO_GLOBAL,   ///< miMatrix *
  miQ_INST_IDENTITY,          ///< miBoolean
  miQ_INST_HIDE,              ///< miBoolean
  miQ_INST_VISIBLE,           ///< miUint
  miQ_INST_SHADOW,            ///< miUint
  miQ_INST_TRACE,             ///< miUint
  miQ_INST_CAUSTIC,           ///< miUint
  miQ_INST_GLOBILLUM,         ///< miUint
  miQ_INST_FINALGATHER,       ///< miUint
  miQ_INST_LABEL,             ///< miUint
  miQ_INST_PARAM,             ///< void *
  miQ_INST_PARAM_SIZE,        ///< int, bytes
  miQ_INST_AREA,              ///< miScalar, of a light
  miQ_GROUP_NKIDS = 230,      ///< int
  miQ_GROUP_KID,              ///< miTag; the fifth argument counts from 0
  // Objects, by tag; GEO_* of the hit.
  miQ_OBJ_TYPE = 300,   ///< int
  miQ_OBJ_VISIBLE,      ///< miBoolean
  miQ_OBJ_TRACE,        ///< miBoolean
  miQ_OBJ_SHADOW,       ///< miBoolean
  miQ_OBJ_CAUSTIC,      ///< miUint
  miQ_OBJ_GLOBILLUM,    ///< miUint
  miQ_OBJ_LABEL,        ///< miUint
  miQ_OBJ_DATA,         ///< miTag
  miQ_GEO_DATA,         ///< miTag
  miQ_GEO_LABEL,        ///< miUint
  miQ_GEO_HAS_DERIVS,   ///< miBoolean
  miQ_GEO_HAS_DERIVS2,  ///< miBoolean
  // Lights, by the tag of the light (not of its instance); in the light's own space.
  miQ_LIGHT_TYPE = 400,      ///< int, miLight_type
  miQ_LIGHT_AREA,            ///< int, miLight_area
  miQ_LIGHT_AREA_SAMPLES_U,  ///< int
  miQ_LIGHT_AREA_SAMPLES_V,  ///< int
  miQ_LIGHT_ORIGIN,          ///< miVector
  miQ_LIGHT_DIRECTION,       ///< miVector
  miQ_LIGHT_SPREAD,          ///< miScalar, cosine
  miQ_LIGHT_EXPONENT,        ///< miScalar
  miQ_LIGHT_AREA_D_RADIUS,   ///< miScalar
  miQ_LIGHT_AREA_S_RADIUS,   ///< miScalar
  miQ_LIGHT_AREA_C_RADIUS,   ///< miScalar
  miQ_LIGHT_SHADER,          ///< miTag
  miQ_LIGHT_EMITTER,         ///< miTag
  miQ_LIGHT_DATA,            ///< miTag
  miQ_LIGHT_ENERGY,          ///< miColor
  miQ_LIGHT_AREA_R_EDGE_U,   ///< miVector
  miQ_LIGHT_AREA_R_EDGE_V,   ///< miVector
  miQ_LIGHT_AREA_D_NORMAL,   ///< miVector
  miQ_LIGHT_AREA_C_AXIS,     ///< miVector
  // Materials, by tag.
  miQ_MTL_SHADER = 450,  ///< miTag
  miQ_MTL_DISPLACE,      ///< miTag
  miQ_MTL_SHADOW,        ///< miTag
  miQ_MTL_VOLUME,        ///< miTag
  miQ_MTL_ENVIRONMENT,   ///< miTag
  miQ_MTL_CONTOUR,       ///< miTag
  miQ_MTL_PHOTON,        ///< miTag
  miQ_MTL_PHOTONVOL,     ///< miTag
  miQ_MTL_LIGHTMAP,      ///< miTag
  miQ_MTL_OPAQUE,        ///< miBoolean
  // Lights of the scene, and data of the hit.
  miQ_NUM_GLOBAL_LIGHTS = 500,  ///< int
  miQ_GLOBAL_LIGHTS,            ///< miTag *
  miQ_NUM_TEXTURES,             ///< int, texture spaces
  miQ_NUM_BUMPS,                ///< int, bump bases
  miQ_TEXTURE_DIM,              ///< miUint; the fifth argument is the space
  miQ_PRI_BBOX_MIN,             ///< miVector, object space
  miQ_PRI_BBOX_MAX,             ///< miVector, object space
  miQ_PRI_INDEX,                ///< miUint
  miQ_PRI_DATA,                 ///< miPri_data
  // Spaces.
  miQ_TRANS_INTERNAL_TO_WORLD = 550,  ///< miMatrix *
  miQ_TRANS_INTERNAL_TO_CAMERA,       ///< miMatrix *
  miQ_TRANS_INTERNAL_TO_OBJECT,       ///< miMatrix *
  miQ_TRANS_WORLD_TO_INTERNAL,        ///< miMatrix *
  miQ_TRANS_WORLD_TO_CAMERA,          ///< miMatrix *
  miQ_TRANS_WORLD_TO_OBJECT,          ///< miMatrix *
  miQ_TRANS_CAMERA_TO_INTERNAL,       ///< miMatrix *
  miQ_TRANS_CAMERA_TO_WORLD,          ///< miMatrix *
  miQ_TRANS_CAMERA_TO_OBJECT,         ///< miMatrix *
  miQ_TRANS_OBJECT_TO_INTERNAL,       ///< miMatrix *
  miQ_TRANS_OBJECT_TO_WORLD,          ///< miMatrix *
  miQ_TRANS_OBJECT_TO_CAMERA,         ///< miMatrix *
  // Images and user data, by tag.
  miQ_IMAGE_WIDTH = 600,  ///< int
  miQ_IMAGE_HEIGHT,       ///< int
  miQ_IMAGE_BITS,         ///< int
  miQ_IMAGE_COMP,         ///< int
  miQ_IMAGE_GAMMA,        ///< double
  miQ_DATA_DECL = 620,    ///< miTag
  miQ_DATA_NEXT,          ///< miTag
  miQ_DATA_PARAM,         ///< char *
  miQ_DATA_PARAM_SIZE,    ///< int, bytes
  miQ_DATA_LABEL,         ///< miUint
  // The rendering.
  miQ_FINALGATHER_STATE = 700,  ///< int, 0 none, 1 from a tile, 2 in precomputation
  miQ_SAMPLE_MOVING,            ///< int
  miQ_PIXEL_SAMPLE,             ///< miScalar[2]
  miQ_TILE_PIXELS,              ///< int[4]
  miQ_TILE_SAMPLES,             ///< int[4]
  miQ_SCENE_BBOX_ALL,           ///< miVector[2], world space
  miQ_SCENE_BBOX_SHADOW,        ///< miVector[2], world space
  miQ_SCENE_BBOX_GLOBILLUM_G,   ///< miVector[2], world space
  miQ_SCENE_BBOX_GLOBILLUM_R,   ///< miVector[2], world space
  miQ_SCENE_BBOX_CAUSTIC_G,     ///< miVector[2], world space
  miQ_SCENE_BBOX_CAUSTIC_R,     ///< miVector[2], world space
  miQ_SCENE_ROOT_GROUP,         ///< miTag
  miQ_STAGE,                    ///< miStage
  miQ_VERSION,                  ///< char *
  miQ_DATE                      ///< char *
} miQ_type;

/// Writes the result of a query; returns miFALSE and leaves result unchanged if there is none.
miBoolean mi_query(miQ_type query, const miState* state, miUint tag, void* result, ...);

#ifdef __cplusplus
}
#endif

#endif
