// SPDX-License-Identifier: Apache-2.0
// Irradiance and ambient occlusion.
#ifndef ORIEL_SDK_IRRADIANCE_H
#define ORIEL_SDK_IRRADIANCE_H

// Conventions
//   Irradiance is the sum of final gathering, global illumination and caustics; a Lambert surface
//   of albedo a has the radiance a * irradiance / pi.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Settings of one call; see miIRRAD_DEFAULT.
typedef struct miIrrad_options {
  int size;  ///< size of this struct in bytes
  int finalgather_rays;
  float finalgather_maxradius, finalgather_minradius;
  miCBoolean finalgather_view;
  miUchar finalgather_filter;
  int globillum_accuracy;
  float globillum_radius;
  int caustic_accuracy;
  float caustic_radius;
  int finalgather_points;  ///< 0 = default
  float importance;        ///< -1 = default
} miIrrad_options;

/// Initialises the options at ptr from state->options.
#define miIRRAD_DEFAULT(ptr, s)                                         \
  do {                                                                  \
    (ptr)->size = (int)sizeof(miIrrad_options);                         \
    (ptr)->finalgather_rays = (s)->options->finalgather_rays;           \
    (ptr)->finalgather_maxradius = (s)->options->finalgather_maxradius; \
    (ptr)->finalgather_minradius = (s)->options->finalgather_minradius; \
    (ptr)->finalgather_view = (s)->options->finalgather_view;           \
    (ptr)->finalgather_filter = (s)->options->finalgather_filter;       \
    (ptr)->globillum_accuracy = (s)->options->globillum_accuracy;       \
    (ptr)->globillum_radius = (s)->options->globillum_radius;           \
    (ptr)->caustic_accuracy = (s)->options->caustic_accuracy;           \
    (ptr)->caustic_radius = (s)->options->caustic_radius;               \
    (ptr)->finalgather_points = 0;                                      \
    (ptr)->importance = -1;                                             \
  } while (0)

/// Settings of mi_ambient_occlusion; lengths in scene units, -1 = default.
typedef struct miAmboccl_options {
  int size;  ///< size of this struct in bytes
  int rays;
  miVector axis;  ///< unit vector, internal space
  float spread;   ///< cosine of the cone; -2 = hemisphere around the axis
  float spread_exp;
  float mindist, maxdist;
  int cache_points;
} miAmboccl_options;

/// Initialises the options at ptr for state->normal.
#define miAMBOCCL_DEFAULT(ptr, s)                 \
  do {                                            \
    (ptr)->size = (int)sizeof(miAmboccl_options); \
    (ptr)->rays = -1;                             \
    (ptr)->axis = (s)->normal;                    \
    (ptr)->spread = -2;                           \
    (ptr)->spread_exp = 1;                        \
    (ptr)->mindist = -1;                          \
    (ptr)->maxdist = -1;                          \
    (ptr)->cache_points = -1;                     \
  } while (0)

/// Irradiance of the front side.
miBoolean mi_compute_irradiance(miColor* result, miState* state);
/// Irradiance of the back side.
miBoolean mi_compute_irradiance_backside(miColor* result, miState* state);
/// Irradiance / pi of side 'f' or 'b'; options may be NULL.
miBoolean mi_compute_avg_radiance(miColor* result, miState* state, miUchar face,
                                  struct miIrrad_options* options);
/// Fluence of photons in a volume with isotropic scattering.
miBoolean mi_compute_volume_irradiance(miColor* result, miState* state);
/// Same with two lobes of directionality g1 and g2, the first with weight r.
miBoolean mi_compute_directional_irradiance(miColor* result, miState* state, miScalar r,
                                            miScalar g1, miScalar g2);
/// Computes a final gather point here; mode: miFinalgather_store_mode.
miBoolean mi_finalgather_store(miColor* result, miState* state, int mode);
/// Occlusion of the hemisphere, 0 open to 1 occluded; `bent`, if not NULL: mean open direction.
miScalar mi_ambient_occlusion(miState* state, struct miAmboccl_options* options, miVector* bent);

#ifdef __cplusplus
}
#endif

#endif
