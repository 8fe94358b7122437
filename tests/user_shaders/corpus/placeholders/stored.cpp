// SPDX-License-Identifier: Apache-2.0
// An object that stays in its file until it is hit.
#include "geoshader.h"

struct cp_stored {
  miTag file;
  miVector low, high;
};

extern "C" {

DLLEXPORT int cp_stored_version(void) { return 1; }

DLLEXPORT miBoolean cp_stored(miTag* result, miState* state, struct cp_stored* paras) {
  const miTag file = *mi_eval_tag(&paras->file);
  if (file == miNULLTAG || mi_db_type(file) != miSCENE_STRING) return miFALSE;
  const char* path = static_cast<char*>(mi_db_access(file));
  miObject* object = mi_api_object_begin(mi_mem_strdup("cp_stored"));
  object->visible = miTRUE;
  object->bbox_min = *mi_eval_vector(&paras->low);
  object->bbox_max = *mi_eval_vector(&paras->high);
  const miBoolean known = mi_api_object_file(mi_mem_strdup(path));
  mi_db_unpin(file);
  const miTag made = mi_api_object_end();
  return known && mi_geoshader_add_result(result, made);
}

}
