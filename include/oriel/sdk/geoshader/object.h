// SPDX-License-Identifier: Apache-2.0
// Objects made by geometry shaders, immediately or on demand.
#ifndef ORIEL_SDK_OBJECT_H
#define ORIEL_SDK_OBJECT_H

// Conventions
//   A call of mi_api_object_callback or mi_api_object_file instead of a group makes the open object
//   a placeholder. Oriel creates the content of placeholders after the geometry shader has
//   returned. A callback passes the name of the placeholder (mi_api_tag_lookup) to
//   mi_api_object_begin. The miObject that it receives has the flags of the placeholder.

#include "hair.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum miObject_type {
  miOBJECT_POLYGONS = 0,
  miOBJECT_FACES,
  miOBJECT_BOXES,
  miOBJECT_SPACECURVES,
  miOBJECT_SUBDIVSURFS,
  miOBJECT_ALGEBRAICS,
  miOBJECT_PLACEHOLDER,
  miOBJECT_HAIR,
  miOBJECT_INTERSECT_FUNC
} miObject_type;

/// An object under construction. Set its members between begin and end, or between mi_scene_edit
/// and mi_scene_edit_end in the same geometry shader.
typedef struct miObject {
  miObject_type type;
  miUchar visible, shadow;
  miUchar reflection, refraction, transparency;
  miUchar caustic, globillum, finalgather;  ///< bit 0 casts, bit 1 receives
  char face;                                ///< 'f', 'b', 'a'
  miUchar select;
  miCBoolean fine;
  miBoolean view_dependent, mtl_is_label, hardware;
  miScalar maxdisplace;
  miTag userdata;
  miTag finalgather_file;
  miUint label, volume_id;
  miVector bbox_min, bbox_max;      ///< object space
  miVector bbox_min_m, bbox_max_m;  ///< with motion
  miBoolean mbox_explicit;
  int min_samples, max_samples;
  double ray_offset;
  struct {
    struct {
      miTag group;
    } polygon_list, face_list;
    struct {
      miObject_type type;  ///< expected type; the actual content decides
    } placeholder_list;
    miHair_list hair_list;
  } geo;
} miObject;

/// Callback that makes the content of a placeholder; `args` as given to mi_api_object_callback.
typedef miBoolean (*miApi_object_callback)(miTag tag, void* args);

/// Begins an object. In incremental mode the name of an existing object replaces its geometry and
/// keeps its tag and flags. NULL: unnamed.
miObject* mi_api_object_begin(const char* name);
/// Ends an object and returns its tag.
miTag mi_api_object_end(void);
/// Makes the open object a placeholder with content from a callback.
miBoolean mi_api_object_callback(miApi_object_callback callback, void* args);
/// Makes the open object a placeholder with content from an object in a .mi file.
miBoolean mi_api_object_file(const char* filename);
/// Sets whether elements with an existing name replace it.
miBoolean mi_api_incremental(miBoolean on);

#ifdef __cplusplus
}
#endif

#endif
