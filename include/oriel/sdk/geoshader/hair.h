// SPDX-License-Identifier: Apache-2.0
// Hair made by geometry shaders.
#ifndef ORIEL_SDK_HAIR_H
#define ORIEL_SDK_HAIR_H

// Conventions
//   Order: mi_api_object_begin, hair_begin, members of the miHair_list, hair_info for each extra,
//   scalars_begin and _end, hairs_begin and _end, hair_end, mi_api_object_end. No group.
//   Entry k of the hairs is the index of the first scalar of hair k; the last entry is the number
//   of scalars. A hair is its extras of mi_api_hair_info(0, ..) in the order of the calls, then for
//   each vertex x y z and the extras of mi_api_hair_info(1, ..).

#include "approx.h"

/// Type of miHair_list::approx: a number of pieces. In C++ an miApprox can be assigned, too.
#ifdef __cplusplus
struct miHair_approx {
  int pieces;
  miHair_approx& operator=(int number) {
    pieces = number;
    return *this;
  }
  miHair_approx& operator=(const miApprox& approx) {
    pieces = static_cast<int>(approx.cnst[miCNST_UPARAM]);
    return *this;
  }
  operator int() const { return pieces; }
};
#else
typedef int miHair_approx;
#endif

typedef struct miHair_list {
  miTag material;       ///< 0 = that of the instance
  miScalar radius;      ///< default radius
  int degree;           ///< 1 lines, 2 and 3 Bezier curves
  miHair_approx approx; /* hairs are smooth whatever it says */
  int space_max_size;   ///< ignored
  int space_max_depth;  ///< ignored
} miHair_list;

#ifdef __cplusplus
extern "C" {
#endif

/// Begins hair of the open object; the returned struct may be written until mi_api_hair_end.
miHair_list* mi_api_hair_begin(void);
/// Declares n scalars of each hair (where 0) or vertex (where 1): what is 'n' normal, 'm' motion,
/// 't' texture, 'r' radius or 'u' user.
miBoolean mi_api_hair_info(int where, char what, int n);
/// Allocates n scalars.
miScalar* mi_api_hair_scalars_begin(int n);
/// Ends the scalars, of which n were written.
miBoolean mi_api_hair_scalars_end(int n);
/// Allocates n entries, one more than the number of hairs.
miGeoIndex* mi_api_hair_hairs_begin(int n);
/// Appends an entry, instead of writing to the allocated memory.
miBoolean mi_api_hair_hairs_add(int offset);
/// Ends the entries.
miBoolean mi_api_hair_hairs_end(void);
/// Ends the hair.
void mi_api_hair_end(void);

#ifdef __cplusplus
}
#endif

#endif
