/* SPDX-License-Identifier: Apache-2.0 */
/* Wraps a mia_material_x: shades as it does, and puts three of its parts into the frame
   buffers 10, 11 and 12. */
/* Shows: the protocol of mia_material_api.h. */
#include <mia_material_api.h>
#include <shader.h>

struct mia_material_out_wrapper {
  miTag mtl; /* the mia_material_x that shades */
};

DLLEXPORT int mia_material_out_wrapper_version(void) { return 1; }

DLLEXPORT miBoolean mia_material_out_wrapper(miColor* result, miState* state,
                                             struct mia_material_out_wrapper* param) {
  miTag mtl = *mi_eval_tag(&param->mtl);
  mia_material_x_api_storage asked;
  const mia_material_x_api_storage* found;
  int size;
  miBoolean shaded;

  /* Leave an empty struct: its size says which of the two structs is meant. Lifetime 0 lets the
     shaders called from here see it. */
  asked.struct_size = sizeof(asked);
  asked.in_use = miFALSE;
  mi_shaderstate_set(state, miA_MATERIAL_API_STORAGE, &asked, sizeof(asked), 0);

  shaded = mi_call_shader_x(result, miSHADER_MATERIAL, state, mtl, NULL);

  /* The material has written into the stored copy, not into `asked`. */
  found = mi_shaderstate_get(state, miA_MATERIAL_API_STORAGE, &size);
  if (found && size == (int)sizeof(*found) && found->in_use) {
    mi_fb_put(state, 10, &found->output.diffuse_result);
    mi_fb_put(state, 11, &found->output.refl_result);
    mi_fb_put(state, 12, &found->output.refr_result);
  }
  return shaded;
}
