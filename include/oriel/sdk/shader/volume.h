// SPDX-License-Identifier: Apache-2.0
// Which volume shaders are mixed along a ray?
#ifndef ORIEL_SDK_VOLUME_H
#define ORIEL_SDK_VOLUME_H

// Conventions
//   Oriel does not track volumes by itself (option autovolume): the list of a volume shader is the
//   shader alone, that of others is empty.
//   The arguments are Oriel's choice: no description of them was available. Lists last while the
//   shader runs.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Number of volume shaders of the ray.
int mi_volume_num_shaders(const miState* state);
/// Place of the running shader among them; -1: it is no volume shader.
int mi_volume_cur_shader(const miState* state);
/// A colour that the volume shaders of a ray share, at first black; NULL: there are none.
miColor* mi_volume_user_color(const miState* state);
/// Tags of the volume shaders of the ray; their number.
int mi_volume_tags(const miState* state, const miTag** tags);
/// Instances of the objects that the volumes fill, 0 for the space around; their number.
int mi_volume_instances(const miState* state, const miTag** instances);

#ifdef __cplusplus
}
#endif

#endif
