// SPDX-License-Identifier: Apache-2.0
// Old C++ idioms that strict headers could break.
#include <math.h>
#include <cmath>
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#include <geoshader.h>
#include <mayaapi.h>
#include <shader.h>

using namespace mi::shader;

struct trap_new {
  miColor diffuse;
  miInteger mode;
  int i_light;
  int n_light;
  miTag light[1];
};

extern "C" DLLEXPORT int trap_new_version(void) { return 2; }

extern "C" DLLEXPORT miBoolean trap_new_init(miState* state, trap_new* paras, miBoolean* req) {
  *req = miTRUE;
  if (paras == NULL) return miTRUE;
  char* name = "text";
  char* copy = mi_mem_strdup(name);
  mi_mem_release(copy);
  miBoolean linked = mayabase_stateitem_get(state, MBSI_NULL);
  return !linked;
}

extern "C" DLLEXPORT miBoolean trap_new(miColor* result, miState* state, trap_new* paras) {
  miTag* lights = mi_eval_tag(paras->light) + *mi_eval_integer(&paras->i_light);
  int n = *mi_eval_integer(&paras->n_light);
  const miColor& diffuse = *mi_eval_color(&paras->diffuse);
  if (*mi_eval_integer(&paras->mode) == 1) mi_inclusive_lightlist(&n, &lights, state);
  result->r = result->g = result->b = 0;
  for (LightIterator it(state, lights, n); !it.at_end(); ++it) {
    miColor sum = {0, 0, 0, 0}, part;
    while (it->sample()) {
      it->get_contribution(&part);
      const float weight =
          it->get_dot_nl() * mi_ward_glossy(&it->get_direction(), &state->dir, &state->normal, 20);
      sum.r += weight * part.r;
    }
    int samples = it->get_number_of_samples();
    if (samples) result->r += sum.r / samples * diffuse.r;
    (void)*it;
  }
  for (mi::shader_v3::LightIterator it(state, state->normal, 0.5f); !it.at_end(); it++)
    it->sample();
  void** user = 0;
  miBoolean known = mi_query(miQ_FUNC_USERPTR, state, NULL, (void*)&user);
  Interface* ui = Interface::get();
  if (ui && known) {
    mi::shader::Options* options = ui->getOptions(state->options->string_options);
    bool on = false;
    if (options->get("mr sun", &on) && on) options->set("seen", 1.0f);
    options->release();
    ui->release();
  }
  Access_fb buffers(state->camera->buffertag);
  size_t index = 0;
  if (buffers->get_index("diffuse", index)) mi_fb_put(state, (int)index, result);
  return max(result->r, 0.0f) > 0 ? miTRUE : miFALSE;
}

extern "C" DLLEXPORT miBoolean trap_geometry(miTag* result, miState*, void*) {
  miObject* object = mi_api_object_begin(mi_mem_strdup("thing"));
  object->visible = miTRUE;
  object->globillum = 3;
  mi_api_basis_list_clear();
  mi_api_object_group_begin(0.0);
  miVector corner = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    corner.x = min(i, 1);
    corner.y = max(i, 1);
    mi_api_vector_xyz_add(&corner);
  }
  for (int i = 0; i < 3; ++i) mi_api_vertex_add(i);
  mi_api_poly_begin_tag(1, 0);
  for (int i = 0; i < 3; ++i) mi_api_poly_index_add(i);
  mi_api_poly_end();
  mi_api_object_group_end();
  return mi_geoshader_add_result(result, mi_api_object_end());
}
