// SPDX-License-Identifier: Apache-2.0
// What a geometry shader is making.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "oriel/sdk/geoshader.h"
#include "scene/scene.h"

namespace oriel::sdk {

/// The elements under way in this thread. Everything made goes into the scene under a name that is
/// its own.
struct GeometryWork {
  scene::Scene* scene = nullptr;
  std::string prefix;  ///< of the names of what is made

  scene::Object object;
  miObject object_flags = {};
  scene::Instance instance;
  miInstance instance_data = {};
  scene::InstanceGroup group;
  scene::Light light;
  miLight light_data = {};
  std::deque<scene::ShaderUse> calls;  ///< function calls within each other
  std::string parameter;

  struct Callback {
    std::string object;
    miGeoshader_callback call;
    void* arguments;
  };
  std::vector<Callback> callbacks;
  std::vector<std::string> results;  ///< names

  /// The work of this thread; null outside of geometry shaders.
  static GeometryWork*& current();
  /// A name for what a shader calls so; no two are the same.
  std::string name_for(const char* wanted);
  /// Tags for names and back.
  static miTag tag_of(const std::string& name);
  static const std::string* name_of(miTag tag);
};

/// The element that stands for all results: the only one, or a group of instances of them; empty
/// when there are none.
std::string finish(GeometryWork& work);

}  // namespace oriel::sdk
