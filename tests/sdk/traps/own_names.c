/* SPDX-License-Identifier: Apache-2.0 */
/* Names that shader sources define themselves, so that the headers must not; valid in C and C++. */
#include <geoshader.h>
#include <mayaapi.h>
#include <mia_material_api.h>
#include <shader.h>

#if defined(miASSERT) || defined(miEPS) || defined(mi_noise) || defined(mi_unoise)
#error these names belong to the sources
#endif

#define miASSERT(condition) ((void)(condition))
#define miEPS 0.0001f

typedef struct miFnc {
  int count;
} miFnc;
typedef struct miFlags {
  miUint bits;
} miFlags;
typedef struct miVectorList {
  miVector* first;
} miVectorList;

enum { miLocalToWorld, miWorldToLocal };

static miScalar mi_noise(const miVector* p) { return p->x; }
static miScalar mi_unoise(const miVector* p) { return mi_noise(p); }
static miScalar mi_noise_grad(const miVector* p, miVector* g) {
  *g = *p;
  return mi_noise(p);
}
static miScalar mi_unoise_grad(const miVector* p, miVector* g) { return mi_noise_grad(p, g); }

static miScalar miaux_blend(miScalar a, miScalar b, miScalar t) { return a + t * (b - a); }

miScalar own_names(miVector* p) {
  miVector g;
  miFnc function = {1};
  miFlags flags = {2};
  miVectorList list = {0};
  miASSERT(list.first == 0);
  return miaux_blend(mi_unoise(p), mi_unoise_grad(p, &g), miEPS) +
         (miScalar)(function.count + (int)flags.bits + miLocalToWorld + miWorldToLocal);
}

/* What only has to compile. */
miBoolean own_uses(miState* state, miTag tag) {
  miApprox approx;
  miLight* light = mi_api_light_begin(mi_mem_strdup("light"));
  miInstance* instance = mi_api_instance_begin(mi_mem_strdup("instance"));
  miGroup* group = mi_api_instgroup_begin(mi_mem_strdup("group"));
  miFunction_decl* declaration;
  miParameter* list = mi_api_parameter_decl(miTYPE_COLOR, mi_mem_strdup("color"), NULL);
  miDecl_fileparm* file = (miDecl_fileparm*)mi_db_access(tag);
  miBoolean* diffuse;
  int* specular;
  const char* name = mi_api_tag_lookup(tag);
  switch (0) {
    case miIMG_FORMAT_TIFF:
    case miIMG_FORMAT_TIFF_U:
    case miIMG_FORMAT_TIFF_16:
      break;
  }
  miAPPROX_DEFAULT(approx);
  (void)approx;
  light->shmap.accuracy = 0.5f;
  light->shmap.samples = 2;
  light->shmap.type = 'a';
  light->shadowmap_flags = miSHADOWMAP_DETAIL;
  if (light->shadowmap_flags == miSHADOWMAP_CAMERA) light->shadowmap_flags = miSHADOWMAP_MERGE;
  instance->shadow_excl = miTRUE;
  instance->shadow_list = mi_api_light_list_end();
  list = mi_api_parameter_append(list, mi_api_parameter_decl(miTYPE_SCALAR, NULL, NULL));
  declaration = mi_api_funcdecl_begin(list, mi_mem_strdup("name"), list);
  declaration->version = 1;
  mi_api_funcdecl_end();
  mi_api_instgroup_additem(mi_mem_strdup("one"));
  mi_api_instgroup_additem(mi_mem_strdup("two"), tag);
  mayabase_stateitem_get(state, MBSI_LIGHTDIFFUSE, &diffuse, MBSI_LIGHTSPECULAR, &specular,
                         MBSI_NULL);
  return mi_has_connections(state) && !mi_is_nonshader_tag(mi_get_ghost(state, state)) &&
         name != NULL && group->no_kids > 0 && group->kids[0] == tag && file->filename[0] != 0;
}
