// SPDX-License-Identifier: Apache-2.0
// Tessellation of polygons and surfaces made by geometry shaders.
#ifndef ORIEL_SDK_APPROX_H
#define ORIEL_SDK_APPROX_H

#include "../shader/types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum miApprox_method {
  miAPPROX_PARAMETRIC = 0,  ///< cnst: pieces per patch and degree
  miAPPROX_REGULAR,         ///< cnst: pieces of the whole surface
  miAPPROX_SPATIAL,         ///< cnst: maximum edge length
  miAPPROX_CURVATURE,       ///< cnst: distance from the surface and angle between normals
  miAPPROX_LDA,             ///< cnst: length, distance and angle; 0 = criterion not used
  miAPPROX_ADJACENCY,
  miAPPROX_ALGEBRAIC,
  miAPPROX_DEFTRIM,
  miAPPROX_REGULAR_PERCENT,  ///< cnst: percentage of one piece per patch and degree
  miAPPROX_INDIRECT,
  miAPPROX_NMETHODS
} miApprox_method;

typedef enum miApprox_style {
  miAPPROX_STYLE_NONE = 0,
  miAPPROX_STYLE_GRID,
  miAPPROX_STYLE_TREE,
  miAPPROX_STYLE_DELAUNAY,
  miAPPROX_STYLE_FINE,
  miAPPROX_STYLE_FINE_NO_SMOOTHING,
  miAPPROX_NSTYLES
} miApprox_style;

/// Indices of miApprox::cnst.
#define miCNST_UPARAM 0
#define miCNST_VPARAM 1
#define miCNST_LENGTH 0
#define miCNST_DISTANCE 1
#define miCNST_ANGLE 2
/// Number of entries of miApprox::cnst.
#define miAPPROX_NCONST 3

/// Indices of miApprox::subdiv.
#define miMIN 0
#define miMAX 1

/// Bits of miApprox::flag: ray types that use the approximation.
#define miAPPROX_FLAG_VISIBLE 1
#define miAPPROX_FLAG_TRACE 2
#define miAPPROX_FLAG_SHADOW 4
#define miAPPROX_FLAG_CAUSTIC 8
#define miAPPROX_FLAG_GLOBILLUM 16
#define miAPPROX_FLAG_ANY 31

/// Approximation of a surface.
typedef struct miApprox {
  int flag;                ///< miAPPROX_FLAG_*
  miApprox_method method;  ///< meaning of the constants
  miApprox_style style;    ///< NONE = not approximated; the approximation of the object applies
  miScalar cnst[miAPPROX_NCONST];  ///< angle in degrees; all 0 = that of the object applies
  miUshort subdiv[2];              ///< minimum and maximum number of edge subdivisions
  miCBoolean any;                  ///< any criterion is sufficient
  miCBoolean view_dep;             ///< lengths are in pixels
  miUint max;                      ///< maximum number of triangles; 0 = no limit
  miScalar sharp;                  ///< 0...1, for fine styles
  miScalar grading;                ///< for delaunay
} miApprox;

/// Initialises an miApprox variable: that of the object, parametric as soon as its constants are
/// set.
#define miAPPROX_DEFAULT(a) oriel_approx_set(&(a), miAPPROX_STYLE_TREE)
/// Initialises an miApprox variable: none.
#define miAPPROX_NONE(a) oriel_approx_set(&(a), miAPPROX_STYLE_NONE)
/// Initialises an miApprox variable: fine, with edges of a quarter of a pixel.
#define miAPPROX_FINE_DEFAULT(a) oriel_approx_set(&(a), miAPPROX_STYLE_FINE)

/// Initialises an approximation; used by the macros above.
void oriel_approx_set(miApprox* approx, miApprox_style style);
/// Approximation of displaced polygons of the open group.
miBoolean mi_api_poly_approx(const miApprox* approx);
/// Approximation of a surface of the open group by its name.
miBoolean mi_api_surface_approx(const char* surface, const miApprox* approx);
/// Ignored with a warning: subdivision surfaces of geometry shaders are unsupported.
miBoolean mi_api_subdivsurf_approx(const void* first, ...);

#ifdef __cplusplus
}
#endif

#endif
