// SPDX-License-Identifier: Apache-2.0
// Structures returned by mi_db_access: lights, instances, groups, materials, shader calls, user
// data.
#ifndef ORIEL_SDK_SCENE_H
#define ORIEL_SDK_SCENE_H

// Conventions
//   The parameters of a shader form a struct in the order of the declaration. Each basic type
//   consists of 4-byte units, so there is no padding: boolean, integer, scalar and every kind of
//   tag (string, shader, texture, light, material, geometry, light profile, data) take 4 bytes,
//   vector 12, color 16, transform 64, spectrum 296. `array T "x"` is `int i_x; int n_x; T x[1];`
//   where element k is x[i_x + k]. Parameters are read only and shared by all threads.

#include "enums.h"
#include "types.h"

typedef struct miPhen_decl miPhen_decl;
typedef struct miInfo miInfo;

/// A shader declaration.
typedef struct miFunction_decl {
  int version;
} miFunction_decl;

/// A shader call. `parameters` are the bytes of the parameter struct.
typedef struct miFunction {
  miFunction_type type;
  miTag function_decl;
  miTag next_function;       ///< next of a shader list
  miTag parameter_indirect;  ///< the call whose parameters are used instead
  miTag interfacephen;
  int parameter_size, result_size;  ///< bytes
  /// Offset in bytes from a parameter to the tag of its connected shader; 0 = no connections.
  int ghost_offs;
  char parameters[8];
} miFunction;

/// The `parameters` of a call of type miFUNCTION_OUTFILE.
typedef struct miDecl_fileparm {
  char filename[8];  ///< zero-terminated; longer than declared
} miDecl_fileparm;

/// A data element. `parameters` are its bytes.
typedef struct miUserdata {
  miTag data_decl;
  miTag next_data;
  miUint label;
  int parameter_size;  ///< bytes
  char parameters[8];
} miUserdata;

// miLight::shadowmap_flags.
#define miSHADOWMAP_MERGE 1
#define miSHADOWMAP_DETAIL 2
#define miSHADOWMAP_TRACE 4
#define miSHADOWMAP_WINDOW 8
#define miSHADOWMAP_CAMERA 16

/// A light element, in its own space. Shadows are always ray traced: shadow map members contain the
/// settings of the scene and have no effect.
typedef struct miLight {
  miLight_type type;
  miLight_area area;
  miScalar exponent;  ///< exponent of the distance falloff of photon energy
  int caustic_store_photons, global_store_photons;
  miColor energy;  ///< of photons
  miTag shader;
  miTag emitter;
  miVector origin;
  miVector direction;
  miScalar spread;  ///< cosine of the cone
  union {
    struct {
      miVector edge_u, edge_v;
    } rectangle;
    struct {
      miVector normal;
      miScalar radius;
    } disc;
    struct {
      miScalar radius;
    } sphere;
    struct {
      miVector axis;
      miScalar radius;
    } cylinder;
    struct {
      miTag object;
    } object;
  } primitive;
  short samples_u, samples_v;
  short low_samples_u, low_samples_v, low_level;
  miUchar shadowmap_flags;  ///< miSHADOWMAP_*
  miCBoolean dirlight_has_org;
  miCBoolean use_shadow_maps;
  miTag shadowmap_file;
  int shadowmap_resolution;
  miScalar shadowmap_softness;
  int shadowmap_samples;
  miBoolean visible;
  miUint label;
  miTag userdata;
  int caustic_emit_photons, global_emit_photons;
  miTag hardware;
  miScalar shmap_h_min, shmap_h_max, shmap_v_min, shmap_v_max;
  miTag emitter_spectrum;
  miScalar shadowmap_bias;
  struct {
    miScalar accuracy;
    int samples;
    char type;    ///< 'c' colour, 'a' alpha
    char filter;  ///< first letter of the filter's name
  } shmap;        ///< detail shadow map
  miTag lightprofile;
  miCBoolean use_lprof;
  miCBoolean photons_only;
} miLight;

/// Transform of an instance; "global" is the space of the parent.
typedef struct miTransform {
  miTag function;
  float time;
  miMatrix global_to_local;
  miMatrix local_to_global;  ///< object to world if the parent is the root
  miBoolean identity;
  miUint id;
} miTransform;

typedef struct miInstance {
  miTransform tf;
  miMatrix motion_transform;
  miTag item;  ///< the element of the instance
  miTag material;
  miTag parent;
  miTag boxes;
  miTag next, prev;
  int mtl_array_size;
  miTag light_obj_ring;
  miTag userdata;
  miUint label;
  miTag geogroup;
  miCBoolean off, gen_motion;
  miUchar visible, shadow, reflection, refraction, transparency;
  miUchar caustic, globillum, finalgather;  ///< bit 0 casts, bit 1 receives
  char face;
  miCBoolean select, mtl_override;
  int history_size;
  miTag approx_list;
  miCBoolean approx_override;
  miTag hardware;
  miCBoolean shadowmap;
  miCBoolean exclusive;  ///< light_list excludes this instance
  miTag light_list;
  miBoolean shadow_excl;  ///< shadow_list excludes this instance
  miTag shadow_list;
} miInstance;

/// A group of instances.
typedef struct miGroup {
  miGeoScalar merge;  ///< distance within which surfaces are joined
  miBoolean placeholder, merge_group;
  int max_kids, no_kids;
  int max_connections, no_connections;
  miTag userdata;
  miUint label;
  miTag kids[1];  ///< instances; no_kids of them
} miGroup;

typedef struct miMaterial {
  miBoolean opaque;
  miTag shader;
  miTag displace;
  miTag shadow;
  miTag volume;
  miTag environment;
  miTag contour;
  miTag photon;
  miTag photonvol;
  miTag lightmap;
  miTag hardware;
} miMaterial;

/// Result of miQ_PRI_DATA.
typedef struct miPri_data {
  int info_size;
  void* info;
  int data_size;
  void* data;
} miPri_data;

#endif
