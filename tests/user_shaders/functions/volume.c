/* SPDX-License-Identifier: Apache-2.0 */
/* The volume shader of the camera, and a material, which is none. */
#include "coverage.h"

DLLEXPORT miBoolean cover_volume_fog(miColor* result, miState* state, void* paras) {
  const miTag *tags = NULL, *instances = NULL;
  miTag own = 0;
  miColor* shared;
  mi_query(miQ_FUNC_TAG, state, miNULLTAG, &own);
  COVER(mi_volume_num_shaders, mi_volume_num_shaders(state) == 1);
  COVER(mi_volume_cur_shader, mi_volume_cur_shader(state) == 0);
  COVER(mi_volume_tags, mi_volume_tags(state, &tags) == 1 && tags && tags[0] == own);
  COVER(mi_volume_instances,
        mi_volume_instances(state, &instances) == 1 && instances && instances[0] == miNULLTAG);
  shared = mi_volume_user_color(state);
  COVER(mi_volume_user_color, shared && SHOWS(*shared, 0, 0, 0) && shared->a == 0);
  if (!shared) return miTRUE;
  *shared = paint(1, 0, 0);
  COVER(mi_volume_user_color, SHOWS(*mi_volume_user_color(state), 1, 0, 0));
  return miTRUE;
}

DLLEXPORT miBoolean cover_volume(miColor* result, miState* state, void* paras) {
  const miTag* list = &state->material;
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  COVER(mi_volume_num_shaders, mi_volume_num_shaders(state) == 0);
  COVER(mi_volume_cur_shader, mi_volume_cur_shader(state) == -1);
  COVER(mi_volume_user_color, mi_volume_user_color(state) == NULL);
  COVER(mi_volume_tags, mi_volume_tags(state, &list) == 0 && list == NULL);
  list = &state->material;
  COVER(mi_volume_instances, mi_volume_instances(state, &list) == 0 && list == NULL);
  return miTRUE;
}
