/* SPDX-License-Identifier: Apache-2.0 */
/* Octaves of noise with helpers whose names a library might have. */
#include <shader.h>

struct cp_noise { miVector scale; miInteger octaves; miScalar gain; };

static miScalar noise(miVector *p) { return mi_unoise_3d(p); }
static double clamp(double x, double lo, double hi) { return x < lo ? lo : x > hi ? hi : x; }

DLLEXPORT int cp_noise_version(void) { return 1; }

DLLEXPORT miBoolean cp_noise(miColor *result, miState *state, struct cp_noise *paras)
{
    miVector p = state->point, *s = mi_eval_vector(&paras->scale);
    miScalar gain = *mi_eval_scalar(&paras->gain), weight = 1, sum = 0, total = 0;
    int n = *mi_eval_integer(&paras->octaves);

    p.x *= s->x;  p.y *= s->y;  p.z *= s->z;
    while (n-- > 0) {
        sum += weight * noise(&p);
        total += weight;
        weight *= gain;
        mi_vector_mul(&p, 2);
    }
    result->r = result->g = result->b = clamp(sum / total, 0, 1);
    result->a = 1;
    return miTRUE;
}
