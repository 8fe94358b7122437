/* SPDX-License-Identifier: Apache-2.0 */
/* Types of the interface in structures, tables, casts and bit work. */
#include <shader.h>
#include <geoshader.h>

typedef struct flags_s {
    miCBoolean  seen, lit;
    miUchar     bits;
    miSchar     low;
    miUshort    wide;
    miUint      many;
    miUint1     u1;
    miUint2     u2;
    miUint4     u4;
    miSint1     s1;
    miSint2     s2;
    miSint4     s4;
    miIndex     index;
    miGeoIndex  geo_index;
    miUlong     l;
    miSlong     sl;
    miIntptr    ptr;
    miGeoScalar exact;
    miGeoVector at;
    miGeoVector2d uv;
    miVector2d  flat;
    miQuaternion turn;
    miRange     range;
    miGeoRange  geo_range;
    miPointer   pointer;
    miLock      lock;
    miMatrix    m;
    miFunction_ptr call;
} flags_t;

struct cp_words { miScalar value; };

static miBoolean yes(void) { return miTRUE; }

DLLEXPORT int cp_words_version(void) { return 1; }

DLLEXPORT miBoolean cp_words(miColor *result, miState *state, struct cp_words *paras)
{
    flags_t f;
    const struct miState *const same = state;
    struct miVector v;
    struct miColor c;

    memset(&f, 0, sizeof(flags_t));
    f.seen = (miCBoolean)(same->dot_nd < 0);
    f.bits = (miUchar)~0;
    f.low = -1;
    f.wide = (miUshort)0x12345;             /* 0x2345 */
    f.many = (miUint)-1 >> 28;              /* 15 */
    f.u1 = (miUint1)256;
    f.s2 = (miSint2)(miUint2)65535;         /* -1 */
    f.index = miNULL_INDEX;
    f.geo_index = miNULL_GEOINDEX;
    f.exact = 1.0 / 3.0;
    f.at.x = state->point.x + 1e-9;
    f.range.min = -miHUGE_SCALAR;
    f.range.max = miHUGE_SCALAR;
    f.pointer.p = &f;
    f.ptr = (miIntptr)f.pointer.p;
    f.call = yes;
    mi_matrix_ident(f.m);
    v.x = v.y = v.z = f.m[0];
    c.r = c.g = c.b = c.a = *mi_eval_scalar(&paras->value) * v.x;
    if (sizeof(miPointer) != 8 || f.wide != 0x2345 || f.u1 != 0 || f.s2 != -1 || !f.call() ||
        (void *)f.ptr != (void *)&f || f.range.min >= f.range.max || f.exact * 3 != 1 ||
        f.geo_index <= miMAX_GEOINDEX || f.index <= miMAX_INDEX || f.low >= 0 || f.bits != 255)
        return miFALSE;
    result->r = f.seen ? c.r : 0;
    result->g = f.many * .0625f;
    result->b = (miScalar)(f.at.x > 0 ? f.at.x * .125 : 0);
    result->a = 1;
    return miTRUE;
}
