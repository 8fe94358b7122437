// SPDX-License-Identifier: Apache-2.0
// What a geometry shader is making.
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

/// The elements under way in this thread. Everything made goes into the scene under the name that
/// the shader gives; where that is taken, under another one.
struct GeometryWork {
  scene::Scene* scene = nullptr;
  std::string prefix;        ///< of names where the shader's own is taken, or it gave none
  bool incremental = false;  ///< elements of a known name replace it

  scene::Object object;
  /// An object that was begun: what mi_api_object_begin and mi_scene_edit give.
  struct ObjectRecord {
    miObject flags = {};
    std::string file;  ///< of the content of a placeholder
  };
  std::map<std::string, std::unique_ptr<ObjectRecord>> objects;  ///< by name
  std::string filling;  ///< the placeholder whose callback runs
  HairWork hair;
  SurfaceWork surface;
  MapWork map;
  std::deque<MapField> map_fields;  ///< they do not move
  ElementWork elements;

  struct Callback {
    std::string object;
    miApi_object_callback call;
    void* arguments;
  };
  std::vector<Callback> callbacks;
  std::vector<std::string> results;  ///< names
  /// Names that the shader gave, with the elements' own.
  std::map<std::string, std::string> given;

  /// The work of this thread; null outside of geometry shaders.
  static GeometryWork*& current();
  /// A name for what a shader calls so; no two are the same, except in incremental mode.
  std::string name_for(const char* wanted);
  /// A name that nothing has yet: the wanted one where it is free; empty: any.
  std::string free_name(const std::string& wanted);
  /// The record behind the tag of an object of this work; null for other tags.
  static miObject* object_of(miTag tag);
  /// The name in the scene of what a shader calls so.
  std::string own_name(const std::string& name) const;
  /// Adds an element to the scene; its tag.
  miTag add(scene::Element element);
  /// Tags for names and back.
  static miTag tag_of(const std::string& name);
  static const std::string* name_of(miTag tag);
};

/// Makes what placeholders stand for, and gives all objects their flags.
void finish_objects(GeometryWork& work);

/// The element that stands for all results: the only one, or a group of instances of them; empty
/// when there are none.
std::string finish(GeometryWork& work);

}  // namespace oriel::sdk
