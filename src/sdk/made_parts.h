// SPDX-License-Identifier: Apache-2.0
// Functions shared by the element functions: values, statements.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oriel/sdk/shader/types.h"
#include "scene/elements.h"

namespace oriel::scene {
class Scene;
}

namespace oriel::sdk::made {

scene::Value boolean(bool on);
scene::Value integer(int number);
scene::Value label(miUint number);
scene::Value numbers(std::span<const float> values);
scene::Value text(std::string_view words);
void say(std::vector<scene::Statement>& statements, const char* keyword, scene::Value value);

/// Name of the element of a tag; empty if there is none.
std::string name_of(miTag tag);

/// User data and label of a C structure as statements.
template <class T>
void attach(const T& from, std::vector<scene::Statement>& statements) {
  if (const std::string data = name_of(from.userdata); !data.empty())
    say(statements, "data", text(data));
  if (from.label != 0) say(statements, "tag", label(from.label));
}

Mat4 matrix_of(const miMatrix m);

/// The shader list of a call tag, with one use for each chained call.
scene::ShaderList shader_list(const scene::Scene& scene, miTag call);

}  // namespace oriel::sdk::made
