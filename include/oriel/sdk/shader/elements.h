// SPDX-License-Identifier: Apache-2.0
// Instances, groups, lights, textures, materials and user data made by geometry shaders.
#ifndef ORIEL_SDK_ELEMENTS_H
#define ORIEL_SDK_ELEMENTS_H

// Conventions
//   Only geometry shaders may call these functions. Strings are allocated with mi_mem_strdup; the
//   API takes ownership and frees them. Functions that return miBoolean return miFALSE if nothing
//   was done; those that return a tag return 0.

#include "scene.h"
#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Begins an instance; its matrices are identity.
miInstance* mi_api_instance_begin(const char* name);
/// Ends an instance of the element named item, or (item NULL) of the result of a geometry shader
/// call; returns its tag. params: shader that computes the transformation, unsupported, 0.
miTag mi_api_instance_end(const char* item, miTag function, miTag params);
/// Begins a list of lights for light_list or shadow_list of an instance.
miBoolean mi_api_light_list_begin(void);
/// Adds a light instance to the list.
miBoolean mi_api_light_list_add(const char* instance);
/// Ends the list of lights and returns its tag.
miTag mi_api_light_list_end(void);

/// Begins a group.
miGroup* mi_api_instgroup_begin(const char* name);
/// Adds a named instance to the group. Further arguments are ignored, except for a tag if the name
/// is NULL.
miBoolean mi_api_instgroup_additem(const char* instance_name, ...);
/// Removes all instances from the group.
miBoolean mi_api_instgroup_clear(void);
/// Ends a group and returns its tag.
miTag mi_api_instgroup_end(void);

/// Begins a light.
miLight* mi_api_light_begin(const char* name);
/// Ends a light, which mi_api_name_lookup finds.
miBoolean mi_api_light_end(void);

/// Begins a texture. If the name exists, returns its tag, otherwise 0. type: 0 color, 1 scalar, 2
/// vector; flags: 1 local, 2 filter, 4 writable.
miTag mi_api_texture_begin(const char* name, int type, int flags);
/// Ends the texture with the name of its picture file and returns its tag.
miTag mi_api_texture_file_def(const char* file);
/// Tag of a named texture; 0 if there is none.
miTag mi_api_texture_lookup(const char* name, miTag unused);

/// Begins a material.
miMaterial* mi_api_material_begin(const char* name);
/// Ends a material and returns its tag.
miTag mi_api_material_end(void);

/// Begins user data. kind: 0 bytes follow, 1 value is the name of a file, 2 value is the tag of a
/// call whose parameters are the data.
miBoolean mi_api_data_begin(const char* name, int kind, void* value);
/// Appends bytes to the data.
miBoolean mi_api_data_byte_copy(int size, miUchar* bytes);
/// Ends user data and returns its tag.
miTag mi_api_data_end(void);
/// Appends data to other data; returns the tag of the first.
miTag mi_api_data_append(miTag list, miTag next);

/// Removes a named element from the scene.
miBoolean mi_api_delete(const char* name);
/// Removes a named element and all elements below it.
miBoolean mi_api_delete_tree(const char* name);
/// Marks a named element as changed.
miBoolean mi_api_touch(const char* name);

#ifdef __cplusplus
}
#endif

#endif
