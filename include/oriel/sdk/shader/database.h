// SPDX-License-Identifier: Apache-2.0
// How does a shader reach elements of the scene?
#ifndef ORIEL_SDK_DATABASE_H
#define ORIEL_SDK_DATABASE_H

// Conventions
//   mi_db_access gives lights as miLight, instances as miInstance, materials as miMaterial, shader
//   calls as miFunction, data as miUserdata, images as miImg_image, strings as char. Read only, and
//   valid to the end of the frame.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The element of a tag, pinned until mi_db_unpin.
void* mi_db_access(miTag tag);
/// Ends mi_db_access.
void mi_db_unpin(miTag tag);
/// miScene_types of an element.
int mi_db_type(miTag tag);
/// Size of an element, bytes.
int mi_db_size(miTag tag);
/// As mi_db_access, and its miScene_types.
void* mi_db_access_type(int* type, miTag tag);
/// An element to be changed, until mi_scene_edit_end.
void* mi_scene_edit(miTag tag);
/// Ends mi_scene_edit.
void mi_scene_edit_end(miTag tag);

#ifdef __cplusplus
}
#endif

#endif
