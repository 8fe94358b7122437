/* SPDX-License-Identifier: Apache-2.0 */
/* What C shaders of the time do, and a strict header would stumble over. */
#include "..\..\common\geoshader.h"
#include "D:\tools\mray\include\shader.h"

#pragma warning(disable : 4244)

#ifndef RAY35
#error the interface says its level
#endif

/* The parameter struct has the name of the function. */
struct trap_old {
  miColor colour;
  miTag name;
  int i_lights;
  int n_lights;
  miTag lights[1];
  struct trap_inner {
    miScalar weight;
    miVector axis;
  } inner;
};

typedef struct {
  int calls;
  char name[32];
} trap_cache;

static miLock trap_lock;

DLLEXPORT int trap_old_version(void) { return (1); }

DLLEXPORT void trap_old_init(miState* state, struct trap_old* paras, miBoolean* inst_req) {
  if (!paras) {
    *inst_req = miTRUE;
    mi_init_lock(&trap_lock);
  } else {
    void** user;
    trap_cache* cache;
    mi_query(miQ_FUNC_USERPTR, state, 0, (void*)&user);
    cache = *user = mi_mem_allocate(sizeof(trap_cache));
    strcpy(cache->name, mi_db_access(*mi_eval_tag(&paras->name)));
    mi_db_unpin(*mi_eval_tag(&paras->name));
    mi_info("'%s' has %d lights", cache->name, *mi_eval_integer(&paras->n_lights));
  }
}

DLLEXPORT void trap_old_exit(miState* state, struct trap_old* paras) {
  void** user;
  if (!paras)
    mi_delete_lock(&trap_lock);
  else if (mi_query(miQ_FUNC_USERPTR, state, 0, &user))
    mi_mem_release(*user);
}

DLLEXPORT miBoolean trap_old(miColor* result, miState* state, struct trap_old* paras) {
  miTag* light = mi_eval_tag(paras->lights) + *mi_eval_integer(&paras->i_lights);
  int n = *mi_eval_integer(&paras->n_lights);
  miColor *colour = mi_eval_color(&paras->colour), sum;
  void* pri = state->pri;
  miVector saved = state->point, dir;
  miMatrix* to_world;
  miScalar scale[16], dot_nl;
  const miVector *a, *b, *c;
  int samples, mode = state->type <= miRAY_LIGHT;
  double sample[2];
  int instance = 0;
  miUint count = 4;

  if (state->type == miRAY_SHADOW || state->type == miRAY_DISPLACE) return (miFALSE);
  state->pri = NULL;
  state->type = (miRay_type)7743; /* a message for the shader called */
  mi_trace_environment(result, state, &state->dir);
  state->type = miRAY_EYE;
  state->pri = pri;
  state->point = saved;
  mi_query(miQ_TRANS_INTERNAL_TO_WORLD, state, miNULLTAG, &to_world);
  mi_point_transform(&saved, &state->point, *to_world);
  mi_matrix_ident(scale);
  if (mode)
    mi_vector_normalize(&saved);
  else
    mi_vector_div(&saved, 2.0);
  if (mi_tri_vectors(state, 't', 0, &a, &b, &c)) mi_vector_add(&saved, a, b);
  for (; n--; light++) {
    samples = 0;
    sum.r = sum.g = sum.b = 0;
    while (mi_sample_light(&sum, &dir, &dot_nl, state, *light, &samples))
      result->r += dot_nl * colour->r * sum.r;
    if (samples) result->r /= samples;
  }
  while (mi_sample(sample, &instance, state, 2, &count)) result->g += (miScalar)sample[0];
  if (state->shader->ghost_offs) result->b = sqrt(M_PI) * fabs(state->dot_nd) * state->pri_idx;
  mi_lock(state->global_lock);
  mi_unlock(state->global_lock);
  return (state->camera->clip.max > 0 ? miTRUE : 2);
}
