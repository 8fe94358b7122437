/* SPDX-License-Identifier: Apache-2.0 */
/* Parameters of each type, shaders that call each other, what they leave for each other, and what
   they ask of the scene. */
#include <mayaapi.h>
#include "coverage.h"

struct cover_evaluate {
  miBoolean flag;
  miInteger number;
  miScalar scalar;
  miVector vector;
  miMatrix transform;
  miColor color;
  miTag text;
  miSpectrum_para spectrum;
  miScalar counted;
  miTag counter;
};

static int counted = 0;

/* How often it was called, and what it was called with. */
DLLEXPORT miBoolean cover_counter(miColor* result, miState* state, void* paras, void* arg) {
  ++counted;
  *result = paint(counted, counted, counted);
  if (arg == &counted) result->r = -1;
  return miTRUE;
}

/* In slots of the material: tells as what it was called. */
DLLEXPORT miBoolean cover_slot(miColor* result, miState* state, void* paras) {
  int type = -1;
  mi_query(miQ_FUNC_CALLTYPE, state, miNULLTAG, &type);
  *result = paint(type, 0, 0);
  return miTRUE;
}

static void parameters(miState* state, struct cover_evaluate* p) {
  int before;

  COVER(mi_eval, mi_eval(state, &p->scalar) == (void*)&p->scalar);
  COVER(mi_phen_eval, mi_phen_eval(state, &p->scalar) == (void*)&p->scalar);
  COVER(mi_eval_boolean, *mi_eval_boolean(&p->flag) == miTRUE);
  COVER(mi_eval_integer, *mi_eval_integer(&p->number) == -7);
  COVER(mi_eval_scalar, NEAR(*mi_eval_scalar(&p->scalar), .5, 0));
  COVER(mi_eval_vector, IS(*mi_eval_vector(&p->vector), 1, 2, 3));
  COVER(mi_eval_transform, mi_eval_transform(&p->transform)[12] == 5);
  COVER(mi_eval_color, SHOWS(*mi_eval_color(&p->color), .25, .5, .75));
  COVER(mi_eval_tag, strcmp(mi_db_access(*mi_eval_tag(&p->text)), "a text") == 0);
  COVER(mi_eval_spectrum, mi_eval_spectrum(&p->spectrum) == (miSpectrum*)&p->spectrum);
  COVER(mi_call_boolean, *mi_call_boolean(&p->flag) == miTRUE);
  COVER(mi_call_integer, *mi_call_integer(&p->number) == -7);
  COVER(mi_call_scalar, NEAR(*mi_call_scalar(&p->scalar), .5, 0));
  COVER(mi_call_vector, IS(*mi_call_vector(&p->vector), 1, 2, 3));
  COVER(mi_call_transform, mi_call_transform(&p->transform)[15] == 1);
  COVER(mi_call_color, SHOWS(*mi_call_color(&p->color), .25, .5, .75));
  COVER(mi_call_tag, *mi_call_tag(&p->text) == *mi_eval_tag(&p->text));

  /* What is connected is asked once, again by mi_call, and anew when that is wanted. */
  before = counted;
  mi_eval_scalar(&p->counted);
  mi_eval_scalar(&p->counted);
  COVER(mi_phen_eval, counted == before + 1 && NEAR(*mi_eval_scalar(&p->counted), counted, 0));
  mi_call_scalar(&p->counted);
  mi_phen_call(state, &p->counted);
  COVER(mi_phen_call, counted == before + 3);
  mi_flush_cache(state);
  mi_eval_scalar(&p->counted);
  COVER(mi_flush_cache, counted == before + 4);
}

static void called(miState* state, struct cover_evaluate* p) {
  miTag tag = *mi_eval_tag(&p->counter), clone;
  int before = counted;
  miColor c;

  COVER(mi_call_shader, mi_call_shader(&c, miSHADER_TEXTURE, state, tag) && c.r == before + 1);
  COVER(mi_call_shader_x,
        mi_call_shader_x(&c, miSHADER_TEXTURE, state, tag, &counted) && c.r == -1);
  clone = mi_phen_clone(state, tag);
  COVER(mi_phen_clone, clone && mi_call_shader(&c, miSHADER_TEXTURE, state, clone));
  mi_phen_unclone(state, clone);
  COVER(mi_phen_unclone, counted == before + 3);
  COVER(mi_call_shadow_material,
        mi_call_shadow_material(&c, state) && c.r == (miScalar)miSHADER_SHADOW);
  COVER(mi_call_environment_material,
        mi_call_environment_material(&c, state) && c.r == (miScalar)miSHADER_ENVIRONMENT);
  /* Materials have no volumes of their own here. */
  COVER(mi_call_volume_material, !mi_call_volume_material(&c, state));
}

static void count_value(void* sum, char* key, void* value, int size, int lifetime) {
  if (strncmp(key, "cover", 5) == 0) *(int*)sum += *(int*)value + size + lifetime;
}

static void left(miState* state) {
  int value = 10, other = 20, size = 0, sum = 0;
  int* found;
  COVER(mi_shaderstate_set, mi_shaderstate_set(state, "cover a", &value, sizeof(value), 0));
  mi_shaderstate_set(state, "cover b", &other, sizeof(other), miSS_LIFETIME_EYERAY);
  value = 0;
  found = mi_shaderstate_get(state, "cover a", &size);
  COVER(mi_shaderstate_get, found && *found == 10 && size == (int)sizeof(int));
  COVER(mi_shaderstate_get, !mi_shaderstate_get(state, "no such", NULL));
  mi_shaderstate_enumerate(state, count_value, &sum);
  COVER(mi_shaderstate_enumerate, sum == 10 + 20 + 2 * (int)sizeof(int) + 1);
  mi_shaderstate_set(state, "cover a", NULL, 0, 0);
  mi_shaderstate_set(state, "cover b", NULL, 0, 0);
  COVER(mi_shaderstate_set, !mi_shaderstate_get(state, "cover a", NULL));
}

static void scene(miState* state) {
  void** user = NULL;
  char* name = NULL;
  miTag decl = 0, item = 0;
  int n = 0, type = 0, offset = 0;
  miParam_type found = miTYPE_INVALID;
  miBoolean is_array = miTRUE;
  miMatrix* m = NULL;
  miInstance* instance = mi_db_access(state->instance);

  COVER(mi_db_access, instance && instance->tf.global_to_local[0] == 2);
  COVER(mi_db_type, mi_db_type(state->instance) == miSCENE_INSTANCE);
  COVER(mi_db_size, mi_db_size(state->instance) == (int)sizeof(miInstance));
  COVER(mi_db_access_type, mi_db_access_type(&type, state->material) && type == miSCENE_MATERIAL);
  mi_db_unpin(state->instance);
  COVER(mi_db_unpin, instance->tf.global_to_local[0] == 2);

  COVER(mi_query, mi_query(miQ_FUNC_USERPTR, state, 0, &user) && user);
  COVER(mi_query, mi_query(miQ_FUNC_DECL, state, 0, &decl) &&
                      mi_query(miQ_DECL_NAME, NULL, decl, &name) &&
                      strcmp(name, "cover_evaluate") == 0);
  COVER(mi_query, mi_query(miQ_NUM_GLOBAL_LIGHTS, state, 0, &n) && n == 1);
  COVER(mi_query, mi_query(miQ_INST_ITEM, NULL, state->instance, &item) &&
                      mi_db_type(item) == miSCENE_OBJECT);
  COVER(mi_query, mi_query(miQ_TRANS_WORLD_TO_CAMERA, state, 0, &m) && (*m)[14] == -4);
  COVER(mi_query, !mi_query(miQ_DATA_LABEL, state, 0, &n));

  COVER(mi_api_parameter_lookup,
        mi_api_parameter_lookup(&found, &is_array, &offset, decl, miFALSE, "color") &&
            found == miTYPE_COLOR && !is_array &&
            offset == (int)offsetof(struct cover_evaluate, color));
  COVER(mi_api_parameter_lookup,
        !mi_api_parameter_lookup(&found, &is_array, &offset, decl, miFALSE, "no such"));
  COVER(mi_api_name_lookup, mi_api_name_lookup(mi_mem_strdup("square_i")) == state->instance);
  COVER(mi_api_tag_lookup, strcmp(mi_api_tag_lookup(state->material), "m") == 0);
}

DLLEXPORT miBoolean cover_evaluate(miColor* result, miState* state, struct cover_evaluate* paras) {
  static int depth = 0;
  miBoolean* specular = NULL;
  miTag ghost;
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  if (depth > 0) { /* called by itself, as the shader of its own material */
    *result = paint(0, 0, 1);
    return miTRUE;
  }
  parameters(state, paras);
  called(state, paras);
  left(state);
  scene(state);
  depth = 1;
  COVER(mi_call_material, mi_call_material(result, state) && SHOWS(*result, 0, 0, 1));
  depth = 0;
  COVER(mayabase_stateitem_get,
        mayabase_stateitem_get(state, MBSI_LIGHTSPECULAR, &specular, MBSI_NULL) && *specular);
  COVER(mayabase_stateitem_get, !mayabase_stateitem_get(state, 99, &specular, MBSI_NULL));
  COVER(mi_has_connections, mi_has_connections(state));
  ghost = mi_get_ghost(state, &paras->counted);
  COVER(mi_get_ghost, ghost == *mi_eval_tag(&paras->counter));
  COVER(mi_is_nonshader_tag, !mi_is_nonshader_tag(ghost) && mi_is_nonshader_tag(miNULLTAG));
  COVER(oriel_is_shader_tag, oriel_is_shader_tag(ghost) && !oriel_is_shader_tag(state->instance));
  COVER(mi_get_ghost, mi_get_ghost(state, &paras->scalar) == miNULLTAG);
  COVER(mayabase_lightlink_get, !mayabase_lightlink_get(state, 0));
  COVER(mayabase_lightlink_check, !mayabase_lightlink_check(state, 0));
  COVER(mayabase_texcoords_check, !mayabase_texcoords_check(state, 0));
  COVER(mayabase_parm_connection, !mayabase_parm_connection(state, 0));
  *result = paint(0, 1, 0);
  return miTRUE;
}
