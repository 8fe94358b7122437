// SPDX-License-Identifier: Apache-2.0
// Binds materials by name.
#include <fmt/format.h>

#include "prepare/prepare_parts.h"

namespace oriel {
namespace {

/// Default material of geometry without one: mid grey.
scene::Material grey_material(const std::string& name) {
  scene::Material grey;
  grey.name = name;
  scene::Value colour;
  colour.kind = scene::Value::Kind::Numbers;
  colour.numbers = {0.5, 0.5, 0.5};
  grey.shaders.push_back({.reference = {},
                          .type = "mib_illum_lambert",
                          .arguments = {{"diffuse", colour, {}}},
                          .where = {}});
  return grey;
}

}  // namespace

Material bind_material(const scene::Scene& scene, const std::string& name, SourceLocation where,
                       Binder& binder, Diagnostics& diagnostics) {
  if (name.empty()) return binder.bind_material(grey_material(name));
  if (const auto* element = scene.get<scene::Material>(name)) return binder.bind_material(*element);
  // An instance's material list may name a shader: it is used as surface and shadow shader.
  if (scene.get<scene::ShaderElement>(name)) {
    scene::Material made;
    made.name = name;
    made.shaders.push_back({.reference = name, .type = {}, .arguments = {}, .where = where});
    made.slots.push_back({"shadow", made.shaders});
    return binder.bind_material(made);
  }
  diagnostics.warning("OR-RN-030", where, fmt::format("there is no material \"{}\"", name),
                      "a grey one is used");
  return binder.bind_material(grey_material(name));
}

}  // namespace oriel
