// SPDX-License-Identifier: Apache-2.0
#include "sdk/material_api.h"

#include <cstddef>
#include <cstring>

#include "oriel/sdk/mia_material_api.h"
#include "sdk/shader_state.h"

namespace oriel::sdk {
namespace {

/// Members of mia_material_x_return in the order of the outputs; opacity is a scalar.
void store_outputs(const MaterialOutputs& outputs, float alpha, mia_material_x_return& to) {
  miColor* const targets[] = {
      &to.result,      &to.diffuse_result,  &to.diffuse_raw,  &to.diffuse_level,   &to.spec_result,
      &to.spec_raw,    &to.spec_level,      &to.refl_result,  &to.refl_raw,        &to.refl_level,
      &to.refr_result, &to.refr_raw,        &to.refr_level,   &to.tran_result,     &to.tran_raw,
      &to.tran_level,  &to.indirect_result, &to.indirect_raw, &to.indirect_cooked, &to.ao_raw,
      &to.add_result,  &to.opacity_result,  &to.opacity_raw};
  std::size_t i = 0;
  for (miColor* target : targets) *target = as_c(outputs[i++], alpha);
  to.opacity = outputs[i].x;
}

void store_outputs(const mia_material_x_return& from, mia_material_api_storage& to) {
  to.opacity = from.opacity;
  to.indir_result = from.indirect_result;
  to.diff_result = from.diffuse_result;
  to.spec_result = from.spec_result;
  to.tran_result = from.tran_result;
  to.refl_result = from.refl_result;
  to.refr_result = from.refr_result;
  to.add_result = from.add_result;
  to.ao_result = from.ao_raw;
  to.diff_level = from.diffuse_level;
  to.refl_level = from.refl_level;
  to.refr_level = from.refr_level;
  to.tran_level = from.tran_level;
}

}  // namespace

bool shade_material(const ShaderNode& node, ShadingPoint& point, miState& state, void* result) {
  if (!point.tracer) return false;
  int size = 0;
  void* const storage = left_value(miA_MATERIAL_API_STORAGE, &size);
  // As in the example of the manual, callers that read the parts from the storage pass the address
  // of a miColor to materials with several results.
  const ShaderSpec& spec = node.spec();
  const bool whole = !storage && spec.results.size() == kMaterialResults &&
                     (!spec.material.has_outputs || spec.material.has_outputs(node));
  MaterialOutputs parts{};
  const NodeList surface{&node};
  const Rgba colour = point.tracer->shade(surface, point, storage || whole ? &parts : nullptr);
  mia_material_x_return outputs = {};
  if (storage || whole) store_outputs(parts, colour.a, outputs);
  outputs.result = as_c(colour);
  if (whole)
    std::memcpy(result, &outputs, offsetof(mia_material_x_return, spare));
  else
    *static_cast<miColor*>(result) = outputs.result;
  if (!storage) return true;
  const miUint written = *static_cast<miUint*>(storage);
  if (size == sizeof(mia_material_x_api_storage) && written == sizeof(mia_material_x_api_storage)) {
    auto& target = *static_cast<mia_material_x_api_storage*>(storage);
    target.output = outputs;
    target.type = state.type;
    target.in_use = miTRUE;
  } else if (size == sizeof(mia_material_api_storage) &&
             written == sizeof(mia_material_api_storage)) {
    auto& target = *static_cast<mia_material_api_storage*>(storage);
    store_outputs(outputs, target);
    target.type = state.type;
    target.in_use = miTRUE;
  }
  return true;
}

}  // namespace oriel::sdk
