// SPDX-License-Identifier: Apache-2.0
// What a geometry shader is making.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "oriel/sdk/geoshader.h"
#include "scene/scene.h"
#include "sdk/element_work.h"

namespace oriel::sdk {

/// The elements under way in this thread. Everything made goes into the scene under the name that
/// the shader gives; where that is taken, under another one.
struct GeometryWork {
  scene::Scene* scene = nullptr;
  std::string prefix;        ///< of names where the shader's own is taken, or it gave none
  bool incremental = false;  ///< elements of a known name replace it

  scene::Object object;
  miObject object_flags = {};
  ElementWork elements;

  struct Callback {
    std::string object;
    miGeoshader_callback call;
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
  /// The name in the scene of what a shader calls so.
  std::string own_name(const std::string& name) const;
  /// Adds an element to the scene; its tag.
  miTag add(scene::Element element);
  /// Tags for names and back.
  static miTag tag_of(const std::string& name);
  static const std::string* name_of(miTag tag);
};

/// The element that stands for all results: the only one, or a group of instances of them; empty
/// when there are none.
std::string finish(GeometryWork& work);

}  // namespace oriel::sdk
