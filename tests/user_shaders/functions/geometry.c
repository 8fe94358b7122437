/* SPDX-License-Identifier: Apache-2.0 */
/* A square with a hole, a square that is made when it is needed, and a light. */
#include <geoshader.h>
#include "coverage.h"

static void corners(double half, double z) {
  static const double side[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  int i;
  for (i = 0; i < 4; i++) {
    const miVector v = make(half * side[i][0], half * side[i][1], z);
    COVER(mi_api_vector_xyz_add, mi_api_vector_xyz_add(&v));
  }
}

static miTag holed(void) {
  const miVector normal = make(0, 0, 1), motion = make(.1, 0, 0), coordinate = make(.5, .5, 0);
  miObject* object = mi_api_object_begin(mi_mem_strdup("holed"));
  miTag tag;
  int i;
  COVER(mi_api_object_begin, object != NULL);
  if (!object) return miNULLTAG;
  object->visible = object->shadow = miTRUE;
  COVER(mi_api_basis_list_clear, mi_api_basis_list_clear());
  COVER(mi_api_object_group_begin, mi_api_object_group_begin(0.0));
  corners(8, 0);
  corners(1, 0);
  mi_api_vector_xyz_add(&normal);
  mi_api_vector_xyz_add(&motion);
  mi_api_vector_xyz_add(&coordinate);
  for (i = 0; i < 8; i++) {
    COVER(mi_api_vertex_add, mi_api_vertex_add(i));
    COVER(mi_api_vertex_normal_add, mi_api_vertex_normal_add(8));
    COVER(mi_api_vertex_motion_add, mi_api_vertex_motion_add(9));
    COVER(mi_api_vertex_tex_add, mi_api_vertex_tex_add(10, -1, -1));
  }
  COVER(mi_api_poly_begin_tag, mi_api_poly_begin_tag(0, miNULLTAG));
  for (i = 0; i < 4; i++) COVER(mi_api_poly_index_add, mi_api_poly_index_add(i));
  COVER(mi_api_poly_hole_add, mi_api_poly_hole_add());
  for (i = 7; i >= 4; i--) COVER(mi_api_poly_index_add, mi_api_poly_index_add(i));
  COVER(mi_api_poly_index_add, !mi_api_poly_index_add(99));
  COVER(mi_api_poly_end, mi_api_poly_end());
  COVER(mi_api_object_group_end, mi_api_object_group_end());
  tag = mi_api_object_end();
  COVER(mi_api_object_end, tag != miNULLTAG);
  return tag;
}

static miBoolean fill(miTag tag, void* args) {
  miObject* object = mi_api_object_begin(NULL);
  int i;
  COVER(mi_api_object_callback, object && args == (void*)&fill);
  if (!object) return miFALSE;
  mi_api_basis_list_clear();
  mi_api_object_group_begin(0.0);
  corners(2, -1);
  for (i = 0; i < 4; i++) mi_api_vertex_add(i);
  mi_api_poly_begin_tag(1, miNULLTAG);
  for (i = 0; i < 4; i++) mi_api_poly_index_add(i);
  mi_api_poly_end();
  mi_api_object_group_end();
  return mi_api_object_end() != miNULLTAG;
}

static miTag later(void) {
  miObject* object = mi_api_object_begin(mi_mem_strdup("later"));
  miTag tag;
  if (!object) return miNULLTAG;
  object->bbox_min = make(-2, -2, -1);
  object->bbox_max = make(2, 2, -1);
  COVER(mi_api_object_callback, mi_api_object_callback(fill, (void*)&fill));
  tag = mi_api_object_end();
  return tag;
}

static miTag placed(const char* name, miTag item, double up) {
  miInstance* instance = mi_api_instance_begin(mi_mem_strdup(name));
  miTag tag;
  COVER(mi_api_instance_begin, instance != NULL);
  if (!instance) return miNULLTAG;
  mi_matrix_ident(instance->tf.global_to_local);
  mi_matrix_ident(instance->tf.local_to_global);
  instance->tf.global_to_local[14] = (miScalar)-up;
  instance->tf.local_to_global[14] = (miScalar)up;
  tag = mi_api_instance_end(mi_mem_strdup(mi_api_tag_lookup(item)), 0, 0);
  COVER(mi_api_instance_end, tag != miNULLTAG);
  return tag;
}

static miTag light(void) {
  miColor color = paint(1, 1, 1);
  miTag shader;
  miLight* made;
  COVER(mi_api_function_call, mi_api_function_call(mi_mem_strdup("mib_light_point")));
  COVER(mi_api_parameter_name, mi_api_parameter_name(mi_mem_strdup("color")));
  COVER(mi_api_parameter_value, mi_api_parameter_value(miTYPE_COLOR, &color, 0));
  shader = mi_api_function_call_end(0);
  COVER(mi_api_function_call_end, shader != miNULLTAG);
  made = mi_api_light_begin(mi_mem_strdup("lamp"));
  COVER(mi_api_light_begin, made != NULL);
  if (!made) return miNULLTAG;
  made->type = miLIGHT_ORIGIN;
  made->origin = make(0, 0, 3);
  made->shader = shader;
  COVER(mi_api_light_end, mi_api_light_end());
  return mi_api_name_lookup(mi_mem_strdup("lamp"));
}

DLLEXPORT miBoolean cover_geometry(miTag* result, miState* state, void* paras) {
  miApprox approx;
  miTag group, object;

  miAPPROX_FINE_DEFAULT(approx);
  COVER(miAPPROX_FINE_DEFAULT, approx.style == miAPPROX_STYLE_FINE && approx.view_dep);
  miAPPROX_NONE(approx);
  COVER(miAPPROX_NONE, approx.style == miAPPROX_STYLE_NONE && approx.cnst[miCNST_LENGTH] == 0);
  miAPPROX_DEFAULT(approx);
  COVER(miAPPROX_DEFAULT, approx.method == miAPPROX_PARAMETRIC && approx.flag == miAPPROX_FLAG_ANY);
  COVER(oriel_approx_set, approx.cnst[miCNST_UPARAM] == 0 && approx.subdiv[miMAX] > 0);

  COVER(mi_api_incremental, mi_api_incremental(miFALSE));
  object = holed();
  COVER(mi_api_tag_lookup, strcmp(mi_api_tag_lookup(object), "holed") == 0);
  COVER(mi_api_tag_lookup, mi_api_tag_lookup(miNULLTAG) == NULL);
  COVER(mi_api_name_lookup, mi_api_name_lookup(mi_mem_strdup("holed")) == object);
  COVER(mi_api_name_lookup, mi_api_name_lookup(mi_mem_strdup("no such")) == miNULLTAG);

  {
    miEchoOptions echo;
    echo.ascii_output = miTRUE;
    echo.compressed_output = echo.dont_echo = miFALSE;
    COVER(mi_geoshader_echo_tag, !mi_geoshader_echo_tag(stderr, object, &echo));
  }

  placed("first", object, 0);
  COVER(mi_api_instgroup_begin, mi_api_instgroup_begin(mi_mem_strdup("all")) != NULL);
  COVER(mi_api_instgroup_additem, mi_api_instgroup_additem(mi_mem_strdup("first")));
  group = mi_api_instgroup_end();
  COVER(mi_api_instgroup_end, group != miNULLTAG);
  COVER(mi_geoshader_add_result, mi_geoshader_add_result(result, group));
  COVER(mi_geoshader_add_result, mi_geoshader_add_result(result, placed("second", later(), 0)));
  return mi_geoshader_add_result(result, placed("third", light(), 0));
}

/* Lit by the light that was made, and it tells what is seen. */
DLLEXPORT miBoolean cover_made(miColor* result, miState* state, void* paras) {
  /* Where the view from (0, 0, 4) meets the plane of the hole. */
  const miScalar at = 4 / (4 - state->point.z);
  const miBoolean in_hole = fabs(state->point.x * at) < 1 && fabs(state->point.y * at) < 1;
  miTag* lights;
  *result = paint(0, 1, 0);
  if (!in_picture(state)) return miTRUE;
  /* Through the hole the second square is seen. */
  COVER(mi_api_poly_hole_add, NEAR(state->point.z, in_hole ? -1 : 0, 1e-3));
  COVER(mi_api_light_end, mi_global_lights_info(&lights) == 1);
  COVER(mi_api_vertex_tex_add, in_hole || NEAR(state->tex_list[0].x, .5, 1e-4));
  return miTRUE;
}
