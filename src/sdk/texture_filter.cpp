// SPDX-License-Identifier: Apache-2.0
// The projection from the screen to a texture.
#include <cmath>

#include "oriel/sdk/shader/texture.h"
#include "oriel/sdk/shader/vector.h"

// Rows: (p.x, p.y, 1) * ST = (t.x, t.y, 1), so the third row is the coordinate at the origin.
// Shaders replace it to look up another position with the same ellipse.
miBoolean mi_texture_filter_transform(miMatrix ST, miVector p[3], miVector t[3]) {
  miMatrix places, coordinates;
  mi_matrix_ident(places);
  mi_matrix_ident(coordinates);
  for (int i = 0; i < 3; ++i) {
    miScalar* const place = places + 4 * i;
    miScalar* const coordinate = coordinates + 4 * i;
    place[0] = p[i].x, place[1] = p[i].y, place[2] = 1;
    coordinate[0] = t[i].x, coordinate[1] = t[i].y, coordinate[2] = 1;
  }
  return mi_matrix_solve(ST, places, coordinates, 4);
}
