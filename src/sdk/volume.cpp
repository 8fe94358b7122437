// SPDX-License-Identifier: Apache-2.0
// Volume shaders of a ray; the renderer runs one at a time.
#include "oriel/sdk/shader/volume.h"

#include "sdk/context.h"
#include "sdk/host.h"
#include "sdk/user_spec.h"

using namespace oriel::sdk;

extern "C" {

int mi_volume_num_shaders(const miState* state) {
  return context(state).call_type == miSHADER_VOLUME ? 1 : 0;
}

int mi_volume_cur_shader(const miState* state) { return mi_volume_num_shaders(state) - 1; }

miColor* mi_volume_user_color(const miState* state) {
  return mi_volume_num_shaders(state) > 0 ? &context(state).volume_color : nullptr;
}

int mi_volume_tags(const miState* state, const miTag** tags) {
  *tags = nullptr;
  const Context& c = context(state);
  if (mi_volume_num_shaders(state) == 0 || !c.shader) return 0;
  auto* list = static_cast<miTag*>(allocate_for_call(sizeof(miTag)));
  *list = c.host->tag_of(c.shader->node);
  *tags = list;
  return 1;
}

// Materials have no volumes; the only volume fills the space around all objects.
int mi_volume_instances(const miState* state, const miTag** instances) {
  static const miTag around = miNULLTAG;
  const int count = mi_volume_num_shaders(state);
  *instances = count > 0 ? &around : nullptr;
  return count;
}

}  // extern "C"
