// SPDX-License-Identifier: Apache-2.0
// Open elements of a geometry shader: at most one of each kind.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "oriel/sdk/geoshader.h"
#include "scene/scene.h"
#include "sdk/call_work.h"
#include "sdk/declaration_work.h"

namespace oriel::sdk {

struct ElementWork {
  std::optional<scene::Instance> instance;
  miInstance instance_data = {};
  std::optional<scene::InstanceGroup> group;
  miGroup group_data = {};
  std::optional<scene::Light> light;
  miLight light_data = {};
  std::optional<scene::Material> material;
  miMaterial material_data = {};
  std::optional<scene::Texture> texture;
  std::optional<scene::UserData> data;

  std::vector<std::string> light_list;                    ///< the open list
  std::map<miTag, std::vector<std::string>> light_lists;  ///< finished lists by tag

  std::deque<CallWork> calls;  ///< nested calls
  DeclarationWork declaration;
};

}  // namespace oriel::sdk
