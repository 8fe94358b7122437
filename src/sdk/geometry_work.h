// SPDX-License-Identifier: Apache-2.0
// What a geometry shader is making.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "oriel/sdk/geoshader.h"
#include "scene/scene.h"
#include "sdk/geometry_parts.h"

namespace oriel::sdk {

/// The elements under way in this thread. Everything made goes into the scene under a name that is
/// its own.
struct GeometryWork {
  scene::Scene* scene = nullptr;
  std::string prefix;  ///< of the names of what is made

  scene::Object object;
  /// An object that was begun: what mi_api_object_begin and mi_scene_edit give.
  struct ObjectRecord {
    miObject flags = {};
    std::string file;  ///< of the content of a placeholder
  };
  std::map<std::string, std::unique_ptr<ObjectRecord>> objects;  ///< by name
  std::string filling;       ///< the placeholder whose callback runs
  bool incremental = false;  ///< elements of a known name replace it
  HairWork hair;
  SurfaceWork surface;
  MapWork map;
  std::deque<MapField> map_fields;  ///< they do not move
  scene::Instance instance;
  miInstance instance_data = {};
  scene::InstanceGroup group;
  scene::Light light;
  miLight light_data = {};
  std::deque<scene::ShaderUse> calls;  ///< function calls within each other
  std::string parameter;

  struct Callback {
    std::string object;
    miApi_object_callback call;
    void* arguments;
  };
  std::vector<Callback> callbacks;
  std::vector<std::string> results;  ///< names

  /// The work of this thread; null outside of geometry shaders.
  static GeometryWork*& current();
  /// A name for what a shader calls so; no two are the same.
  std::string name_for(const char* wanted);
  /// The same of a name that the shader no longer owns.
  std::string free_name(const std::string& wanted) const;
  /// The record behind the tag of an object of this work; null for other tags.
  static miObject* object_of(miTag tag);
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
