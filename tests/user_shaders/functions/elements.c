/* SPDX-License-Identifier: Apache-2.0 */
/* A geometry shader that declares and calls shaders and makes elements of each kind; a square shows
   the values that its material got. */
#include <geoshader.h>
#include "coverage.h"

static char* text(const char* words) { return mi_mem_strdup(words); }

struct cover_declared {
  miColor tint;
  miScalar factor;
  int i_weights;
  int n_weights;
  miScalar weights[1];
  struct {
    miVector axis;
    miTag words;
  } inner;
};

DLLEXPORT miBoolean cover_declared(miColor* result, miState* state, struct cover_declared* p) {
  const miScalar* weights = mi_eval_scalar(p->weights) + *mi_eval_integer(&p->i_weights);
  *result = *mi_eval_color(&p->tint);
  if (!in_picture(state)) return miTRUE;
  COVER(mi_api_parameter_decl, SHOWS(*result, .25, .5, .75));
  COVER(mi_api_parameter_name, SHOWS(*result, .25, .5, .75));
  COVER(mi_api_parameter_default, NEAR(*mi_eval_scalar(&p->factor), 3, 0));
  COVER(mi_api_parameter_push, *mi_eval_integer(&p->n_weights) == 2);
  COVER(mi_api_new_array_element, weights[0] == 5 && weights[1] == 6);
  COVER(mi_api_parameter_pop, IS(*mi_eval_vector(&p->inner.axis), 1, 2, 3));
  COVER(mi_api_parameter_value, strcmp(mi_db_access(*mi_eval_tag(&p->inner.words)), "own") == 0);
  COVER(mi_api_parameter_child, IS(*mi_eval_vector(&p->inner.axis), 1, 2, 3));
  return miTRUE;
}

static void declare(void) {
  miScalar three = 3;
  miParameter *list, *weights, *inner, *members;
  miFunction_decl* made;

  list = mi_api_parameter_decl(miTYPE_COLOR, text("tint"), NULL);
  COVER(mi_api_parameter_decl, list != NULL);
  list = mi_api_parameter_append(list, mi_api_parameter_decl(miTYPE_SCALAR, text("factor"), NULL));
  COVER(mi_api_parameter_append, list != NULL);
  COVER(mi_api_parameter_default, mi_api_parameter_default(miTYPE_SCALAR, &three));
  weights = mi_api_parameter_decl(miTYPE_ARRAY, text("weights"), NULL);
  COVER(mi_api_parameter_child,
        mi_api_parameter_child(weights, mi_api_parameter_decl(miTYPE_SCALAR, NULL, NULL)));
  list = mi_api_parameter_append(list, weights);
  inner = mi_api_parameter_decl(miTYPE_STRUCT, text("inner"), NULL);
  members = mi_api_parameter_decl(miTYPE_VECTOR, text("axis"), NULL);
  mi_api_parameter_append(members, mi_api_parameter_decl(miTYPE_STRING, text("words"), NULL));
  mi_api_parameter_child(inner, members);
  list = mi_api_parameter_append(list, inner);
  made = mi_api_funcdecl_begin(mi_api_parameter_decl(miTYPE_COLOR, NULL, NULL),
                               text("cover_declared"), list);
  COVER(mi_api_funcdecl_begin, made != NULL);
  if (made) made->version = 2;
  mi_api_funcdecl_end();
  COVER(mi_api_funcdecl_end, mi_api_name_lookup(text("cover_declared")) != miNULLTAG);
}

static miTag call(void) {
  miScalar tint[4] = {.25f, .5f, .75f, 1}, weight[2] = {5, 6}, axis[3] = {1, 2, 3};
  miTag made;
  int i;
  mi_api_function_call(text("cover_declared"));
  mi_api_parameter_name(text("tint"));
  for (i = 0; i < 4; i++) mi_api_parameter_value(miTYPE_SCALAR, &tint[i], 0, 0);
  mi_api_parameter_name(text("weights"));
  COVER(mi_api_parameter_push, mi_api_parameter_push(miTRUE));
  for (i = 0; i < 2; i++) {
    COVER(mi_api_new_array_element, mi_api_new_array_element());
    mi_api_parameter_value(miTYPE_SCALAR, &weight[i], 0, 0);
  }
  COVER(mi_api_parameter_pop, mi_api_parameter_pop());
  COVER(mi_api_parameter_pop, !mi_api_parameter_pop());
  mi_api_parameter_name(text("inner"));
  mi_api_parameter_push(miFALSE);
  mi_api_parameter_name(text("axis"));
  for (i = 0; i < 3; i++) mi_api_parameter_value(miTYPE_SCALAR, &axis[i], 0, 0);
  mi_api_parameter_name(text("words"));
  mi_api_parameter_value(miTYPE_STRING, (void*)"own", 0, 0);
  mi_api_parameter_pop();
  made = mi_api_function_call_end(0);
  COVER(mi_api_shader_add, mi_api_shader_add(text("named"), made));
  COVER(mi_api_function_assign, mi_api_function_assign(text("named")) != miNULLTAG);
  COVER(mi_api_function_assign, mi_api_function_assign(text("no such")) == miNULLTAG);
  return made;
}

static miTag connected(void) {
  miTag first, second;
  mi_api_function_call(text("mib_color_mix"));
  mi_api_parameter_name(text("color_base"));
  COVER(mi_api_parameter_shader, mi_api_parameter_shader(text("named")));
  first = mi_api_function_call_end(0);
  mi_api_function_call(text("mib_color_mix"));
  mi_api_parameter_name(text("color_base"));
  COVER(mi_api_parameter_interface, mi_api_parameter_interface(text("outer")));
  second = mi_api_function_call_end(0);
  COVER(mi_api_function_append, mi_api_function_append(first, second) == first);
  COVER(mi_api_function_append, mi_api_function_append(0, second) == second);
  return first;
}

static miTag square(void) {
  static const miVector corner[4] = {{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}};
  int i;
  mi_api_object_begin(NULL)->visible = miTRUE;
  mi_api_object_group_begin(0.0);
  for (i = 0; i < 4; i++) mi_api_vector_xyz_add(&corner[i]);
  for (i = 0; i < 4; i++) mi_api_vertex_add(i);
  mi_api_poly_begin_tag(1, miNULLTAG);
  for (i = 0; i < 4; i++) mi_api_poly_index_add(i);
  mi_api_poly_end();
  mi_api_object_group_end();
  return mi_api_object_end();
}

static void textures(void) {
  miTag made;
  COVER(mi_api_texture_begin, mi_api_texture_begin(text("picture"), 0, 1) == miNULLTAG);
  made = mi_api_texture_file_def(text("no such.png"));
  COVER(mi_api_texture_file_def, made != miNULLTAG);
  COVER(mi_api_texture_lookup, mi_api_texture_lookup(text("picture"), 0) == made);
  COVER(mi_api_texture_begin, mi_api_texture_begin(text("picture"), 0, 1) == made);
}

static void data(void) {
  miUchar bytes[4] = {1, 2, 3, 4};
  miInteger number = 77;
  miTag first, second, parameters, next = 0;
  miUserdata* read;
  COVER(mi_api_data_begin, mi_api_data_begin(text("bytes"), 0, NULL));
  COVER(mi_api_data_byte_copy, mi_api_data_byte_copy(4, bytes));
  first = mi_api_data_end();
  COVER(mi_api_data_end, first != miNULLTAG);
  read = mi_db_access(first);
  COVER(mi_api_data_byte_copy, read && read->parameter_size == 4 && read->parameters[3] == 4);
  mi_api_function_call(text("cover_data"));
  mi_api_parameter_name(text("number"));
  mi_api_parameter_value(miTYPE_INTEGER, &number);
  parameters = mi_api_function_call_end(0);
  COVER(mi_api_data_begin, mi_api_data_begin(text("declared"), 2, &parameters));
  second = mi_api_data_end();
  read = mi_db_access(second);
  COVER(mi_api_data_begin, read && read->parameter_size == 4 && *(int*)read->parameters == 77);
  COVER(mi_api_data_append, mi_api_data_append(first, second) == first);
  COVER(mi_api_data_append, mi_query(miQ_DATA_NEXT, NULL, first, &next) && next == second);
}

static miTag place(const char* name, miTag item, miTag lights) {
  miInstance* instance = mi_api_instance_begin(text(name));
  COVER(mi_api_instance_begin, instance && instance->tf.global_to_local[15] == 1);
  if (!instance) return miNULLTAG;
  instance->material = mi_api_name_lookup(text("made material"));
  instance->light_list = lights;
  return mi_api_instance_end(text(mi_api_tag_lookup(item)), 0, 0);
}

DLLEXPORT miBoolean cover_elements(miTag* result, miState* state, void* paras) {
  miMaterial* material;
  miLight* light;
  miGroup* group;
  miTag shader, item, lights, made;

  declare();
  shader = call();
  connected();
  material = mi_api_material_begin(text("made material"));
  COVER(mi_api_material_begin, material != NULL);
  if (!material) return miFALSE;
  material->shader = shader;
  COVER(mi_api_material_end, mi_api_material_end() != miNULLTAG);
  textures();
  data();

  light = mi_api_light_begin(text("other lamp"));
  if (!light) return miFALSE;
  light->use_shadow_maps = miTRUE;
  light->shadowmap_flags = miSHADOWMAP_DETAIL;
  light->shmap.samples = 4;
  light->shmap.accuracy = .5f;
  light->shmap.type = 'c';
  COVER(mi_api_light_end, mi_api_light_end());
  COVER(mi_api_light_list_begin, mi_api_light_list_begin());
  COVER(mi_api_light_list_add, mi_api_light_list_add(text("other lamp")));
  lights = mi_api_light_list_end();
  COVER(mi_api_light_list_end, lights != miNULLTAG);

  item = square();
  COVER(mi_api_object_begin, item != miNULLTAG);
  place("seen", item, lights);
  place("removed", item, miNULLTAG);
  COVER(mi_api_touch, mi_api_touch(text("seen")) && !mi_api_touch(text("no such")));
  COVER(mi_api_delete, mi_api_delete(text("removed")) && !mi_api_delete(text("removed")));
  mi_api_instgroup_begin(text("gone"));
  place("removed", square(), miNULLTAG);
  mi_api_instgroup_additem(text("removed"));
  mi_api_instgroup_end();
  COVER(mi_api_delete_tree, mi_api_delete_tree(text("gone")));
  COVER(mi_api_delete_tree, mi_api_name_lookup(text("removed")) == miNULLTAG);

  group = mi_api_instgroup_begin(text("all made"));
  COVER(mi_api_instgroup_begin, group && group->no_kids == 0);
  mi_api_instgroup_additem(text("no such"));
  COVER(mi_api_instgroup_clear, mi_api_instgroup_clear());
  COVER(mi_api_instgroup_additem, mi_api_instgroup_additem(text("seen"), miNULLTAG));
  made = mi_api_instgroup_end();
  group = mi_db_access(made);
  COVER(mi_api_instgroup_end, mi_db_type(made) == miSCENE_GROUP && group && group->no_kids == 1);
  COVER(mi_api_instgroup_clear, group && strcmp(mi_api_tag_lookup(group->kids[0]), "seen") == 0);
  return mi_geoshader_add_result(result, made);
}

DLLEXPORT miBoolean cover_element(miColor* result, miState* state, void* paras) {
  *result = paint(0, 1, 0);
  return miTRUE;
}
