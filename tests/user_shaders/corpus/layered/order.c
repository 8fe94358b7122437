/* SPDX-License-Identifier: Apache-2.0 */
/* A fourth argument: the caller hands a structure, the called shader fills it in. */
#include <shader.h>

struct order { int version; miScalar gain; int answered; };
struct cp_order { miTag shader; miScalar gain; };
struct cp_served { miColor color; };

DLLEXPORT int cp_order_version(void) { return 1; }
DLLEXPORT miBoolean cp_order(miColor *result, miState *state, struct cp_order *paras)
{
    struct order order;
    order.version = 7;
    order.gain = *mi_eval_scalar(&paras->gain);
    order.answered = 0;
    if (!mi_call_shader_x(result, miSHADER_MATERIAL, state, *mi_eval_tag(&paras->shader), &order))
        return miFALSE;
    result->b = order.answered;
    return miTRUE;
}

DLLEXPORT int cp_served_version(void) { return 1; }
DLLEXPORT miBoolean cp_served(miColor *result, miState *state, struct cp_served *paras, void *arg)
{
    struct order *order = (struct order *)arg;
    miColor      *c = mi_eval_color(&paras->color);
    miScalar      gain = order && order->version == 7 ? order->gain : 1;

    result->r = c->r * gain;  result->g = c->g * gain;  result->b = c->b * gain;  result->a = 1;
    if (order)
        order->answered = 1;
    return miTRUE;
}
