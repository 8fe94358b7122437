/* SPDX-License-Identifier: Apache-2.0 */
/* A picture of the whole surroundings: longitude and latitude of the direction. */
#include <shader.h>

struct cp_latlong { miTag texture; miScalar turn; };

DLLEXPORT int cp_latlong_version(void) { return 1; }

DLLEXPORT miBoolean cp_latlong(miColor *result, miState *state, struct cp_latlong *paras)
{
    miVector dir, coord;
    mi_vector_to_world(state, &dir, &state->dir);
    coord.x = (miScalar)(atan2(dir.x, -dir.z) / (2 * M_PI)) + *mi_eval_scalar(&paras->turn) + 0.5f;
    coord.y = (miScalar)(asin(dir.y) / M_PI) + 0.5f;
    coord.z = 0;
    coord.x -= (miScalar)floor(coord.x);
    return mi_lookup_color_texture(result, state, *mi_eval_tag(&paras->texture), &coord);
}
