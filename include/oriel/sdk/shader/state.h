// SPDX-License-Identifier: Apache-2.0
// The shading state: miState.
#ifndef ORIEL_SDK_STATE_H
#define ORIEL_SDK_STATE_H

// Conventions
//   All members are in internal space except bump_x_list and bump_y_list (object space). "scratch"
//   and "may be written" members may be changed before a ray is cast and must be restored before
//   returning; all others are read only. Child states are copies.

#include "enums.h"
#include "options.h"
#include "scene.h"
#include "types.h"

struct miImg_image;
/// A hit; opaque.
struct miRc_intersection;

typedef struct miState {
  int version;  ///< of this interface: 2
  miTag camera_inst;
  const miCamera* camera;
  const miOptions* options;
  miLock global_lock;        ///< shared by all shaders; only for mi_lock and mi_unlock
  miUint qmc_instance;       ///< internal
  float raster_x, raster_y;  ///< pixel coordinates of the eye sample
  struct miState* parent;    ///< state of the ray that caused this one; NULL for the first eye ray
  miRay_type type;
  miUchar qmc_component;    ///< internal
  miUint1 scanline;         ///< the hit was not found by tracing
  miCBoolean inv_normal;    ///< the back side was hit, and the normals were reversed
  char face;                ///< 'f', 'b', 'a': sides that rays from here can hit; may be written
  void* cache;              ///< internal
  int reflection_level;     ///< reflections so far; may be written
  int refraction_level;     ///< refractions and transparencies so far; may be written
  miVector org;             ///< origin of the ray; light and shadow rays: the light
  miVector dir;             ///< unit; light and shadow rays: from the light to the lit point
  double dist;              ///< length of the ray; 0 = infinite
  float time;               ///< within the shutter
  miScalar ior, ior_in;     ///< scratch: index of refraction ahead and behind
  miTag material;           ///< of the hit; 0 = no hit
  miTag volume;             ///< volume of this ray; may be written
  miTag environment;        ///< used by rays that miss; may be written
  miTag refraction_volume;  ///< becomes `volume` of the next refraction; may be written
  miUint label;             ///< of the hit object
  miTag instance;           ///< leaf instance of the hit object: defines object space
  miTag light_instance;     ///< light being sampled: defines light space
  /// Handle of the hit primitive: unique per primitive, equal in all samples; not to be
  /// dereferenced. 0 = rays start in empty space, and lights on both sides contribute; may be
  /// written.
  void* pri;
  float importance;       ///< weight of the ray
  float bary[4];          ///< barycentric coordinates
  miVector point;         ///< hit point; displacement: vertex being moved; may be written there
  miVector normal;        ///< unit shading normal on the ray's side
  miVector normal_geom;   ///< unit geometric normal on the ray's side
  miScalar dot_nd;        ///< normal . dir; light rays: with the normal of the lit point
  double shadow_tol;      ///< offset against self-intersection, length
  miVector* tex_list;     ///< coordinates, one per texture space (miQ_NUM_TEXTURES)
  miVector* bump_x_list;  ///< bump basis, one per pair (miQ_NUM_BUMPS), object space
  miVector* bump_y_list;
  miVector motion;           ///< displacement in one motion interval, or null
  miVector* derivs;          ///< dP/du, dP/dv, d2P/du2, d2P/dv2, d2P/dudv, if requested
  miVector tex;              ///< coordinate passed to a texture shader
  const miFunction* shader;  ///< the running shader
  struct miState* child;     ///< of the last ray cast from here
  short thread;              ///< number of the thread, from 0
  miUshort count;            ///< sample of an area light
  void* user;                ///< scratch: passed to the shaders of rays cast from here
  int user_size;
  void* ts;     ///< internal
  int pri_idx;  ///< for sources older than `importance`; always 0
  int spare0;
} miState;

/// State of output shaders without version; no longer used.
typedef struct miOutstate {
  int version;
  miTag camera_inst;
  const miCamera* camera;
  const miOptions* options;
  int xres, yres;
  struct miImg_image* frame_rgba;
  struct miImg_image* frame_z;
  struct miImg_image* frame_n;
  struct miImg_image* frame_label;
  miMatrix camera_to_world;
  miMatrix world_to_camera;
  struct miImg_image* frame_m;
} miOutstate;

#endif
