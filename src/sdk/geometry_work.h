// SPDX-License-Identifier: Apache-2.0
// Scene data under construction by a geometry shader.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "oriel/sdk/geoshader.h"
#include "scene/scene.h"
#include "sdk/element_work.h"
#include "sdk/geometry_parts.h"

namespace oriel::sdk {

/// Open elements of this thread. Finished elements are added to the scene under the name given by
/// the shader, or under another one if that exists.
struct GeometryWork {
  scene::Scene* scene = nullptr;
  std::string prefix;        ///< prefix of generated names
  bool incremental = false;  ///< an element replaces an existing one of the same name

  scene::Object object;
  /// An object under construction, returned by mi_api_object_begin and mi_scene_edit.
  struct ObjectRecord {
    miObject flags = {};
    std::string file;  ///< file with the content of a placeholder
  };
  std::map<std::string, std::unique_ptr<ObjectRecord>> objects;  ///< by name
  std::string filling;  ///< the placeholder whose callback is running
  HairWork hair;
  SurfaceWork surface;
  MapWork map;
  std::deque<MapField> map_fields;  ///< stable addresses
  ElementWork elements;

  struct Callback {
    std::string object;
    miApi_object_callback call;
    void* arguments;
  };
  std::vector<Callback> callbacks;
  std::vector<std::string> results;  ///< names
  /// Names given by the shader, mapped to names in the scene.
  std::map<std::string, std::string> given;

  /// The work of this thread; null outside of geometry shaders.
  static GeometryWork*& current();
  /// Name in the scene for a name given by a shader; unique except in incremental mode.
  std::string name_for(const char* wanted);
  /// An unused name: the wanted one if possible; empty: any.
  std::string free_name(const std::string& wanted);
  /// The object behind a tag of this work; null for other tags.
  static miObject* object_of(miTag tag);
  /// Name in the scene of a name given by the shader.
  std::string own_name(const std::string& name) const;
  /// Adds an element to the scene and returns its tag.
  miTag add(scene::Element element);
  /// Conversion between names and tags.
  static miTag tag_of(const std::string& name);
  static const std::string* name_of(miTag tag);
};

/// Creates the content of placeholders, and sets the flags of all objects.
void finish_objects(GeometryWork& work);

/// The element that represents all results: the only one, or a group of their instances; empty if
/// there are none.
std::string finish(GeometryWork& work);

}  // namespace oriel::sdk
