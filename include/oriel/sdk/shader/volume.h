// SPDX-License-Identifier: Apache-2.0
// Volume shaders of a ray.
#ifndef ORIEL_SDK_VOLUME_H
#define ORIEL_SDK_VOLUME_H

// Conventions
//   Oriel does not track volumes (option autovolume): the list of a volume shader is the shader
//   alone, that of others is empty.
//   The signatures are specific to Oriel, because no description of them was available. Lists are
//   valid while the shader runs.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Number of volume shaders of the ray.
int mi_volume_num_shaders(const miState* state);
/// Index of the running shader among them; -1 if it is not a volume shader.
int mi_volume_cur_shader(const miState* state);
/// A colour shared by the volume shaders of a ray, initially black; NULL if there are none.
miColor* mi_volume_user_color(const miState* state);
/// Tags of the volume shaders of the ray; returns their number.
int mi_volume_tags(const miState* state, const miTag** tags);
/// Instances of the objects that contain the volumes, 0 for the surrounding space; returns their
/// number.
int mi_volume_instances(const miState* state, const miTag** instances);

#ifdef __cplusplus
}
#endif

#endif
