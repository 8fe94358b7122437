// SPDX-License-Identifier: Apache-2.0
// What does a shader know about the point and the ray it is called for: miState.
#ifndef ORIEL_SDK_STATE_H
#define ORIEL_SDK_STATE_H

// Conventions
//   Internal space is the space of everything here but bump_x_list and bump_y_list (object space).
//   "scratch" and "may be written" members may be changed before a ray is cast and are put back
//   before returning; all others are read only. Child states are copies.

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
  struct miState* parent;    ///< of the ray that caused this one; NULL for the first eye ray
  miRay_type type;
  miUchar qmc_component;    ///< internal
  miUint1 scanline;         ///< the hit was not found by tracing
  miCBoolean inv_normal;    ///< the back side was hit and the normals were turned
  char face;                ///< 'f', 'b', 'a': sides that rays from here may hit; may be written
  void* cache;              ///< internal
  int reflection_level;     ///< reflections so far; may be written
  int refraction_level;     ///< refractions and transparencies so far; may be written
  miVector org;             ///< origin of the ray; light and shadow rays: the light
  miVector dir;             ///< unit; light and shadow rays: from the light to the lit point
  double dist;              ///< length of the ray; 0 = infinite
  float time;               ///< within the shutter
  miScalar ior, ior_in;     ///< scratch: index of refraction ahead and behind
  miTag material;           ///< of the hit; 0 = no hit
  miTag volume;             ///< applied to this ray; may be written
  miTag environment;        ///< for rays that miss; may be written
  miTag refraction_volume;  ///< becomes `volume` of the next refraction; may be written
  miUint label;             ///< of the hit object
  miTag instance;           ///< leaf instance of the hit object: defines object space
  miTag light_instance;     ///< light being sampled: defines light space
  /// Handle of the primitive that was hit: the same in all samples, another for each; not to be
  /// dereferenced. 0 = rays start in empty space, lights of both sides are taken; may be written.
  void* pri;
  float importance;       ///< weight of the ray
  float bary[4];          ///< barycentric coordinates
  miVector point;         ///< hit point; displacement: vertex being moved; may be written there
  miVector normal;        ///< unit shading normal on the ray's side
  miVector normal_geom;   ///< unit geometric normal on the ray's side
  miScalar dot_nd;        ///< normal . dir; light rays: with the lit point's normal
  double shadow_tol;      ///< tolerance against self-shadowing, length
  miVector* tex_list;     ///< coordinates, one a texture space (miQ_NUM_TEXTURES)
  miVector* bump_x_list;  ///< bump basis, one a pair (miQ_NUM_BUMPS), object space
  miVector* bump_y_list;
  miVector motion;           ///< way in one motion interval, or null
  miVector* derivs;          ///< dP/du, dP/dv, d2P/du2, d2P/dv2, d2P/dudv, where asked for
  miVector tex;              ///< coordinate handed to a texture shader
  const miFunction* shader;  ///< the running shader
  struct miState* child;     ///< of the last ray cast from here
  short thread;              ///< number of the thread, from 0
  miUshort count;            ///< sample of an area light
  void* user;                ///< scratch: handed to the shaders of rays cast from here
  int user_size;
  void* ts;     ///< internal
  int pri_idx;  ///< of sources older than `importance`; always 0
  int spare0;
} miState;

/// What output shaders without version once got; none is called so any more.
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
