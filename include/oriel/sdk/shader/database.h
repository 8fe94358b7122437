// SPDX-License-Identifier: Apache-2.0
// How does a shader reach elements of the scene?
#ifndef ORIEL_SDK_DATABASE_H
#define ORIEL_SDK_DATABASE_H

// Conventions
//   mi_db_access gives lights as miLight, instances as miInstance, materials as miMaterial, shader
//   calls as miFunction, data as miUserdata, images as miImg_image, strings as char. Read only, and
//   valid to the end of the frame.
//   Elements that shaders make live to the end of the frame as well and may be written; the frame
//   after it does not know their tags.

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
/// A new element of `size` bytes of 0, of one of miScene_types above miSCENE_NONE; pinned. NULL,
/// and tag 0, where none can be made.
void* mi_db_create(miTag* tag, int type, int size);
/// Gives an element of mi_db_create another size; what is new is 0. Its address, which may change;
/// NULL: there is no such element.
void* mi_db_realloc(miTag tag, int size);
/// Ends an element of mi_db_create. Elements of the scene stay.
void mi_db_delete(miTag tag);
/// A copy of an element with a tag of its own; 0: of this kind there are no copies.
miTag mi_db_copy(miTag tag);
/// Whether the content of an element is computed on first access. Always miFALSE.
miBoolean mi_db_isjob(miTag tag);
/// Tells how many elements shaders have made, and their bytes.
void mi_db_dump(void);
/// Sends a changed element to other machines; there are none.
void mi_db_flush(miTag tag);
/// An element to be changed, until mi_scene_edit_end.
void* mi_scene_edit(miTag tag);
/// Ends mi_scene_edit.
void mi_scene_edit_end(miTag tag);

#ifdef __cplusplus
}
#endif

#endif
