/* SPDX-License-Identifier: Apache-2.0 */
/* Which parameters the scene gives, what instances and shaders are made of, and probes. */
#include "coverage.h"

struct cover_parameter_set {
  miScalar plain; /* written as its default */
  miScalar given;
  miScalar connected;
  miColor color;       /* its default */
  miColor given_color; /* another alpha */
  miVector unwritten;
  miBoolean on; /* off, where the default is on */
  miTag text, given_text;
  miTag shader;
  int i_none, n_none;
  miScalar none[1];
  int i_some, n_some;
  miScalar some[1];
};

DLLEXPORT miBoolean cover_half(miColor* result, miState* state, void* paras) {
  *result = paint(.5, .5, .5);
  return miTRUE;
}

/* Nothing is connected to it. */
DLLEXPORT miBoolean cover_alone(miColor* result, miState* state, miScalar* paras) {
  COVER(mi_has_ghosts, !mi_has_ghosts(state));
  COVER(mi_is_connected, !mi_is_connected(state, paras));
  *result = paint(0, 0, 0);
  return miTRUE;
}

static void parameters(miState* state, struct cover_parameter_set* p) {
  miScalar* value;
  COVER(mi_has_ghosts, mi_has_ghosts(state));
  COVER(mi_is_connected,
        mi_is_connected(state, &p->connected) && !mi_is_connected(state, &p->given));
  COVER(oriel_parameter_is_connected, oriel_parameter_is_connected(state, &p->connected));
  COVER(oriel_parameter_is_connected, !oriel_parameter_is_connected(state, NULL));
  COVER(mi_is_set, !mi_is_set(state, &p->plain) && mi_is_set(state, &p->given));
  COVER(mi_is_set, mi_is_set(state, &p->connected));
  COVER(mi_is_set, !mi_is_set(state, &p->color) && mi_is_set(state, &p->given_color));
  COVER(mi_is_set, !mi_is_set(state, &p->unwritten) && mi_is_set(state, &p->on));
  COVER(mi_is_set, !mi_is_set(state, &p->text) && mi_is_set(state, &p->given_text));
  COVER(mi_is_set, mi_is_set(state, &p->shader));
  COVER(mi_is_set, !mi_is_set(state, p->none) && !mi_is_set(state, &p->n_none));
  COVER(oriel_parameter_is_set,
        oriel_parameter_is_set(state, p->some) && oriel_parameter_is_set(state, &p->i_some));
  COVER(oriel_parameter_is_set, !oriel_parameter_is_set(state, NULL));
  COVER(mi_eval_set, mi_eval_set(state, &p->plain) == NULL);
  value = (miScalar*)mi_eval_set(state, &p->connected);
  COVER(mi_eval_set, value && NEAR(*value, .5, 1e-6));
}

static void infos(miState* state, struct cover_parameter_set* p) {
  miTag item = 0, material = 0, own = 0;
  miMatrix to_local, to_global;
  char* name = NULL;
  int version = 0;
  void* paras = NULL;

  mi_instance_info(state->instance, &item, &material, to_local, to_global);
  COVER(mi_instance_info, mi_db_type(item) == miSCENE_OBJECT && material == state->material);
  COVER(mi_instance_info, to_local[0] == 2 && to_local[12] == 1 && NEAR(to_global[0], .5, 1e-6));
  mi_instance_info(item, &item, NULL, to_local, NULL);
  COVER(mi_instance_info, item == 0 && mi_matrix_isident(to_local));
  mi_query(miQ_FUNC_TAG, state, miNULLTAG, &own);
  mi_shader_info(own, &name, &version, &paras);
  COVER(mi_shader_info, name && strcmp(name, "cover_parameter_set") == 0);
  COVER(mi_shader_info, version == 3 && paras == (void*)p);
  mi_shader_info(state->instance, &name, NULL, &paras);
  COVER(mi_shader_info, name == NULL && paras == NULL);
}

static void probes(miState* state) {
  const miVector above = make(0, 0, 2), down = make(0, 0, -1);
  void* pri = state->pri;
  COVER(mi_trace_probe_x,
        mi_trace_probe_x(state, &down, &above, 0) && NEAR(state->child->dist, 2, 1e-4));
  COVER(mi_trace_probe_x, mi_trace_probe_x(state, &down, &above, 2.5));
  COVER(mi_trace_probe_x, !mi_trace_probe_x(state, &down, &above, 1.5) && state->child->dist == 0 &&
                              !state->child->material);
  mi_state_set_pri(state, NULL);
  COVER(mi_state_set_pri, state->pri == NULL);
  mi_state_set_pri(state, pri);
  COVER(mi_state_set_pri, (void*)state->pri == pri);
}

DLLEXPORT int cover_parameter_set_version(void) { return 3; }

DLLEXPORT miBoolean cover_parameter_set(miColor* result, miState* state,
                                        struct cover_parameter_set* paras) {
  miColor c;
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  parameters(state, paras);
  infos(state, paras);
  probes(state);
  mi_call_shader(&c, miSHADER_TEXTURE, state, *mi_eval_tag(&paras->shader));
  return miTRUE;
}
