// SPDX-License-Identifier: Apache-2.0
// Enumerations: rays, shaders, scene elements, parameters, lights.
#ifndef ORIEL_SDK_ENUMS_H
#define ORIEL_SDK_ENUMS_H

/// Ray types. The values are fixed, because shaders compare them (`type <= miRAY_LIGHT`).
typedef enum miRay_type {
  miRAY_EYE = 0,
  miRAY_TRANSPARENT,
  miRAY_REFLECT,
  miRAY_REFRACT,
  miRAY_LIGHT,
  miRAY_SHADOW,
  miRAY_ENVIRONMENT,
  miRAY_NONE,
  miPHOTON_ABSORB,
  miPHOTON_LIGHT,
  miPHOTON_REFLECT_SPECULAR,
  miPHOTON_REFLECT_GLOSSY,
  miPHOTON_REFLECT_DIFFUSE,
  miPHOTON_TRANSMIT_SPECULAR,
  miPHOTON_TRANSMIT_GLOSSY,
  miPHOTON_TRANSMIT_DIFFUSE,
  miRAY_DISPLACE,
  miRAY_OUTPUT,
  miPHOTON_SCATTER_VOLUME,
  miPHOTON_TRANSPARENT,
  miRAY_FINALGATHER,
  miRAY_LM_VERTEX,
  miRAY_LM_MESH,
  miPHOTON_EMIT_GLOBILLUM,
  miPHOTON_EMIT_CAUSTIC,
  miRAY_PROBE,
  miRAY_HULL,
  miPHOTON_HULL,
  miRAY_NO_TYPES
} miRay_type;

/// A camera ray.
#define miRAY_PRIMARY(t) ((t) == miRAY_EYE)
/// A ray cast by a shader.
#define miRAY_SECONDARY(t) \
  (((t) >= miRAY_TRANSPARENT && (t) <= miRAY_NONE) || (t) == miRAY_FINALGATHER || (t) == miRAY_HULL)
/// A photon.
#define miRAY_PHOTON(t)                                             \
  (((t) >= miPHOTON_ABSORB && (t) <= miPHOTON_TRANSMIT_DIFFUSE) ||  \
   (t) == miPHOTON_SCATTER_VOLUME || (t) == miPHOTON_TRANSPARENT || \
   (t) == miPHOTON_EMIT_GLOBILLUM || (t) == miPHOTON_EMIT_CAUSTIC || (t) == miPHOTON_HULL)

/// Roles in which a shader is called.
typedef enum miShader_type {
  miSHADER_LENS = 0,
  miSHADER_MATERIAL,
  miSHADER_LIGHT,
  miSHADER_SHADOW,
  miSHADER_ENVIRONMENT,
  miSHADER_VOLUME,
  miSHADER_TEXTURE,
  miSHADER_PHOTON,
  miSHADER_GEOMETRY,
  miSHADER_DISPLACE,
  miSHADER_PHOTON_EMITTER,
  miSHADER_OUTPUT,
  miSHADER_OTHER,
  miSHADER_LIGHTMAP,
  miSHADER_PHOTONVOL,
  miSHADER_STATE,
  miSHADER_CONTOUR,
  miSHADER_NO_TYPES
} miShader_type;

/// Roles for which a declaration permits a shader (`apply`), as bits.
#define miAPPLY_LENS (1 << miSHADER_LENS)
#define miAPPLY_MATERIAL (1 << miSHADER_MATERIAL)
#define miAPPLY_LIGHT (1 << miSHADER_LIGHT)
#define miAPPLY_SHADOW (1 << miSHADER_SHADOW)
#define miAPPLY_ENVIRONMENT (1 << miSHADER_ENVIRONMENT)
#define miAPPLY_VOLUME (1 << miSHADER_VOLUME)
#define miAPPLY_TEXTURE (1 << miSHADER_TEXTURE)
#define miAPPLY_PHOTON (1 << miSHADER_PHOTON)
#define miAPPLY_GEOMETRY (1 << miSHADER_GEOMETRY)
#define miAPPLY_DISPLACE (1 << miSHADER_DISPLACE)
#define miAPPLY_PHOTON_EMITTER (1 << miSHADER_PHOTON_EMITTER)
#define miAPPLY_OUTPUT (1 << miSHADER_OUTPUT)
#define miAPPLY_OTHER (1 << miSHADER_OTHER)
#define miAPPLY_LIGHTMAP (1 << miSHADER_LIGHTMAP)
#define miAPPLY_PHOTONVOL (1 << miSHADER_PHOTONVOL)
#define miAPPLY_STATE (1 << miSHADER_STATE)
#define miAPPLY_CONTOUR (1 << miSHADER_CONTOUR)

/// Element types returned by mi_db_type.
typedef enum miScene_types {
  miSCENE_NONE = 0,
  miSCENE_FUNCTION_DECL,
  miSCENE_FUNCTION,
  miSCENE_MATERIAL,
  miSCENE_LIGHT,
  miSCENE_CAMERA,
  miSCENE_BASIS_LIST,
  miSCENE_OBJECT,
  miSCENE_BOX,
  miSCENE_LINEBOX,
  miSCENE_INSTANCE,
  miSCENE_GROUP,
  miSCENE_OPTIONS,
  miSCENE_IMAGE,
  miSCENE_POLYGON,
  miSCENE_INDEX,
  miSCENE_GEOINDEX,
  miSCENE_VERTEX,
  miSCENE_GEOVERTEX,
  miSCENE_VECTOR,
  miSCENE_GEOVECTOR,
  miSCENE_FACE,
  miSCENE_SURFACE,
  miSCENE_CURVE,
  miSCENE_CURVPNT,
  miSCENE_SCALAR,
  miSCENE_GEOSCALAR,
  miSCENE_ALGEBRAIC,
  miSCENE_TAG,
  miSCENE_STRING,
  miSCENE_SPACECURVE,
  miSCENE_BOOK,
  miSCENE_PAGE,
  miSCENE_SUBDIVSURF,
  miSCENE_USERDATA,
  miSCENE_WORLD,
  miSCENE_SESSION,
  miSCENE_TRANSACTION,
  miSCENE_SPLIT,
  miSCENE_IMATTER,
  miSCENE_NBOX,
  miSCENE_LOCAL,
  miSCENE_SPLITOBJECT,
  miSCENE_INDEXRANGE,
  miSCENE_LIGHTPROFILE,
  miSCENE_HARDWARE,
  miSCENE_LIGHTPROFILE_STD,
  miSCENE_APPROX_LIST,
  miSCENE_VENDOR,
  miSCENE_FBINFO,
  miSCENE_COLORPROFILE,
  miSCENE_SPECTRUM,
  miSCENE_BSDF,
  miSCENE_FLIST,
  miSCENE_ASSEMBLY
} miScene_types;

typedef enum miLight_type { miLIGHT_ORIGIN = 0, miLIGHT_DIRECTION, miLIGHT_SPOT } miLight_type;

typedef enum miLight_area {
  miLIGHT_NONE = 0,
  miLIGHT_RECTANGLE,
  miLIGHT_DISC,
  miLIGHT_SPHERE,
  miLIGHT_CYLINDER,
  miLIGHT_OBJECT,
  miLIGHT_USER
} miLight_area;

typedef enum miFunction_type {
  miFUNCTION_C = 0,
  miFUNCTION_PHEN,
  miFUNCTION_C_REQ,
  miFUNCTION_OUTFILE,
  miFUNCTION_DATA,
  miFUNCTION_PASS_SAVE,
  miFUNCTION_PASS_PREP,
  miFUNCTION_PASS_MERGE,
  miFUNCTION_PASS_DELETE,
  miFUNCTION_HARDWARE
} miFunction_type;

typedef enum miParam_type {
  miTYPE_INVALID = -1,
  miTYPE_BOOLEAN = 0,
  miTYPE_INTEGER,
  miTYPE_SCALAR,
  miTYPE_STRING,
  miTYPE_COLOR,
  miTYPE_VECTOR,
  miTYPE_TRANSFORM,
  miTYPE_SHADER,
  miTYPE_SCALAR_TEX,
  miTYPE_COLOR_TEX,
  miTYPE_VECTOR_TEX,
  miTYPE_LIGHT,
  miTYPE_STRUCT,
  miTYPE_ARRAY,
  miTYPE_TEX,
  miTYPE_MATERIAL,
  miTYPE_GEOMETRY,
  miTYPE_LIGHTPROFILE,
  miTYPE_DATA,
  miTYPE_SPECTRUM,
  miNTYPES
} miParam_type;

/// When a shader of kind `state` is called.
typedef enum miShader_state_op {
  miSHADERSTATE_STATE_INIT = 0,
  miSHADERSTATE_STATE_EXIT,
  miSHADERSTATE_SAMPLE_INIT,
  miSHADERSTATE_SAMPLE_EXIT
} miShader_state_op;

typedef enum miFinalgather_store_mode {
  miFG_STORE_COMPUTE = 1,
  miFG_STORE_SET = 2
} miFinalgather_store_mode;

/// Rendering stages (query miQ_STAGE), as bits.
typedef enum miStage {
  miSTAGE_UNKNOWN = 0,
  miSTAGE_TILE = 1,
  miSTAGE_FINALGATHER_PRECOMP = 2,
  miSTAGE_AO_PRECOMP = 4,
  miSTAGE_CAUSTIC_EMIT = 8,
  miSTAGE_GLOBILLUM_EMIT = 16,
  miSTAGE_PHOTON_EMIT = 8 | 16,
  miSTAGE_IMPORTON_EMIT = 32,
  miSTAGE_LIGHTMAP = 64
} miStage;

/// Values of miOptions::scanline.
enum {
  miRENDER_FH_OFF = 0,
  miRENDER_FH_SCANLINE = 1,
  miRENDER_FH_OPENGL = 'o',
  miRENDER_FH_RAST = 'r'
};

#endif
