// SPDX-License-Identifier: Apache-2.0
// Access to scene elements.
#ifndef ORIEL_SDK_DATABASE_H
#define ORIEL_SDK_DATABASE_H

// Conventions
//   mi_db_access gives lights as miLight, instances as miInstance, materials as miMaterial, shader
//   calls as miFunction, data as miUserdata, images as miImg_image, strings as char. Read only, and
//   valid to the end of the frame.
//   Elements made by shaders also exist until the end of the frame and may be written; their tags
//   are invalid in the next frame.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The element of a tag, pinned until mi_db_unpin.
void* mi_db_access(miTag tag);
/// Unpins an element of mi_db_access.
void mi_db_unpin(miTag tag);
/// miScene_types of an element.
int mi_db_type(miTag tag);
/// Size of an element in bytes.
int mi_db_size(miTag tag);
/// Like mi_db_access; also returns its miScene_types.
void* mi_db_access_type(int* type, miTag tag);
/// Creates and pins a zeroed element of `size` bytes with a type of miScene_types above
/// miSCENE_NONE. Returns NULL and tag 0 on failure.
void* mi_db_create(miTag* tag, int type, int size);
/// Resizes an element of mi_db_create; added bytes are 0. Returns its address, which may change, or
/// NULL if there is no such element.
void* mi_db_realloc(miTag tag, int size);
/// Deletes an element of mi_db_create. Elements of the scene are not deleted.
void mi_db_delete(miTag tag);
/// A copy of an element with its own tag; 0 if the type cannot be copied.
miTag mi_db_copy(miTag tag);
/// Whether the content of an element is computed at the first access. Always miFALSE.
miBoolean mi_db_isjob(miTag tag);
/// Reports the number and size of elements made by shaders.
void mi_db_dump(void);
/// Sends a changed element to other machines; no effect.
void mi_db_flush(miTag tag);
/// Starts editing an element, until mi_scene_edit_end.
void* mi_scene_edit(miTag tag);
/// Ends mi_scene_edit.
void mi_scene_edit_end(miTag tag);

#ifdef __cplusplus
}
#endif

#endif
