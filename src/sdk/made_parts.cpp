// SPDX-License-Identifier: Apache-2.0
#include "sdk/made_parts.h"

#include <cstring>

#include "sdk/current.h"
#include "sdk/geometry_work.h"
#include "sdk/host.h"

namespace oriel::sdk::made {
namespace {

/// Lists nested deeper than this are cyclic.
constexpr int kMaxListDepth = 64;

void append_uses(const scene::Scene& scene, const std::string& name, int depth,
                 scene::ShaderList& list) {
  const auto* element = scene.get<scene::ShaderElement>(name);
  if (!element || depth > kMaxListDepth) return;
  // A single call is stored as a reference, so that its users share it.
  if (element->functions.size() == 1) {
    scene::ShaderUse use;
    use.reference = name;
    list.push_back(std::move(use));
    return;
  }
  for (const scene::ShaderUse& use : element->functions)
    if (scene.get<scene::ShaderElement>(use.reference))
      append_uses(scene, use.reference, depth + 1, list);
    else
      list.push_back(use);
}

}  // namespace

scene::Value boolean(bool on) {
  scene::Value v;
  v.kind = scene::Value::Kind::Boolean;
  v.boolean = on;
  return v;
}

scene::Value integer(int number) {
  scene::Value v;
  v.kind = scene::Value::Kind::Numbers;
  v.integral = true;
  v.numbers = {static_cast<double>(number)};
  return v;
}

scene::Value label(miUint number) {
  scene::Value v = integer(0);
  v.numbers[0] = number;
  return v;
}

scene::Value numbers(std::span<const float> values) {
  scene::Value v;
  v.kind = scene::Value::Kind::Numbers;
  v.numbers.assign(values.begin(), values.end());
  return v;
}

scene::Value text(std::string_view words) {
  scene::Value v;
  v.kind = scene::Value::Kind::Text;
  v.text = words;
  return v;
}

void say(std::vector<scene::Statement>& statements, const char* keyword, scene::Value value) {
  statements.push_back({keyword, false, {std::move(value)}, {}});
}

Mat4 matrix_of(const miMatrix m) {
  Mat4 out;
  std::memcpy(out.getValue(), m, sizeof(miMatrix));
  return out;
}

std::string name_of(miTag tag) {
  if (const std::string* name = GeometryWork::name_of(tag)) return *name;
  const Host* host = current_host();
  return host && kind_of(tag) != TagKind::Made ? host->name_of(tag) : std::string();
}

scene::ShaderList shader_list(const scene::Scene& scene, miTag call) {
  scene::ShaderList list;
  if (call != miNULLTAG) append_uses(scene, name_of(call), 0, list);
  return list;
}

}  // namespace oriel::sdk::made
