// SPDX-License-Identifier: Apache-2.0
// Caches the results of queries of instances in a map. All threads share the map under a lock.
#include <map>

#include "shader.h"

namespace {

class Guard {
 public:
  explicit Guard(miLock lock) : lock_(lock) { mi_lock(lock_); }
  ~Guard() { mi_unlock(lock_); }

 private:
  Guard(const Guard&);
  void operator=(const Guard&);
  miLock lock_;
};

miLock the_lock;
std::map<miTag, miUint>* labels = NULL;

}  // namespace

extern "C" {

DLLEXPORT int cp_labels_version() { return 1; }

DLLEXPORT void cp_labels_init(miState*, void*, miBoolean*) {
  mi_init_lock(&the_lock);
  labels = new std::map<miTag, miUint>();
}

DLLEXPORT void cp_labels_exit(miState*, void*) {
  delete labels;
  labels = NULL;
  mi_delete_lock(&the_lock);
}

// Red: the label of the object hit. Green: that of its instance. Blue: the state's.
DLLEXPORT miBoolean cp_labels(miColor* result, miState* state, void*) {
  miTag item = miNULLTAG;
  miUint label = 0;
  {
    Guard guard(the_lock);
    std::map<miTag, miUint>::iterator known = labels->find(state->instance);
    if (known == labels->end()) {
      mi_query(miQ_INST_LABEL, NULL, state->instance, &label);
      known = labels->insert(std::pair<const miTag, miUint>(state->instance, label)).first;
    }
    result->g = miScalar(known->second) / 16;
  }
  mi_query(miQ_INST_ITEM, NULL, state->instance, &item);
  mi_query(miQ_OBJ_LABEL, NULL, item, &label);
  result->r = miScalar(label) / 16;
  result->b = miScalar(state->label) / 16;
  result->a = 1;
  return miTRUE;
}

}
