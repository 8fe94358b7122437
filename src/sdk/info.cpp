// SPDX-License-Identifier: Apache-2.0
// Information about instances and shaders.
#include "oriel/sdk/shader/info.h"

#include "oriel/sdk/shader/vector.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "sdk/user_spec.h"

using namespace oriel::sdk;

extern "C" {

void mi_instance_info(miTag instance, miTag* item, miTag* material, miMatrix global_to_local,
                      miMatrix local_to_global) {
  Host* host = current_host();
  const miInstance* found =
      host ? host->record_of<miInstance>(instance, miSCENE_INSTANCE) : nullptr;
  if (item) *item = found ? found->item : miNULLTAG;
  if (material) *material = found ? found->material : miNULLTAG;
  if (global_to_local) {
    mi_matrix_ident(global_to_local);
    if (found) mi_matrix_copy(global_to_local, found->tf.global_to_local);
  }
  if (local_to_global) {
    mi_matrix_ident(local_to_global);
    if (found) mi_matrix_copy(local_to_global, found->tf.local_to_global);
  }
}

void mi_shader_info(miTag shader, char** name, int* version, void** paras) {
  Host* host = current_host();
  const oriel::ShaderNode* node = host ? host->node(shader) : nullptr;
  // The interface lacks const; callers do not modify the names.
  if (name) *name = node ? const_cast<char*>(node->spec().name) : nullptr;
  if (version) *version = node ? node->spec().version : 0;
  if (!paras) return;
  const UserInstance* user = node ? user_instance(*node) : nullptr;
  *paras = user && host->access(shader) ? user->parameters : nullptr;
}

}  // extern "C"
