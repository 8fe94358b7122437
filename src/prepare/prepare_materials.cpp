// SPDX-License-Identifier: Apache-2.0
// Binds materials by name, also again after edits.
#include <fmt/format.h>

#include "lights/emission.h"
#include "prepare/prepare_parts.h"
#include "scene/references.h"

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

bool refers_to(const scene::References& references, const std::set<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return references.contains(name); });
}

/// Whether anything other than materials refers to the elements. All elements and phenomena count,
/// used or not.
bool is_used_elsewhere(const scene::Scene& scene, const std::set<std::string>& names) {
  scene::References references(scene);
  for (const scene::Element& element : scene.elements()) {
    if (const auto* options = std::get_if<scene::Options>(&element)) {
      references.follow(options->state);
    } else if (const auto* camera = std::get_if<scene::Camera>(&element)) {
      for (const auto* list : {&camera->lens, &camera->volume, &camera->environment})
        references.follow(*list);
      for (const scene::Output& output : camera->outputs) references.follow(output.shaders);
    } else if (const auto* light = std::get_if<scene::Light>(&element)) {
      references.follow(light->shaders);
      references.follow(light->emitters);
    } else if (const auto* instance = std::get_if<scene::Instance>(&element)) {
      references.follow(instance->geometry);
      references.follow(instance->transform_shaders);
    }
  }
  for (const scene::Phenomenon& phenomenon : scene.phenomena) {
    for (const scene::ShaderElement& shader : phenomenon.shaders)
      references.follow(shader.functions);
    for (const scene::Material& material : phenomenon.materials) {
      references.follow(material.shaders);
      for (const scene::Material::Slot& slot : material.slots) references.follow(slot.shaders);
    }
    for (const scene::Light& light : phenomenon.lights) references.follow(light.shaders);
    for (const scene::Phenomenon::Root& root : phenomenon.roots) {
      references.follow(root.name);
      references.follow(root.shaders);
    }
  }
  return refers_to(references, names);
}

/// Whether the rest of a world is the same with either material: surfaces without emission,
/// displacement and volumes, which both let light through or both do not.
bool can_replace(const Material& a, const Material& b) {
  const auto is_plain = [](const Material& m) {
    return m.displace.empty() && m.volume.empty() && !may_emit(m);
  };
  return is_plain(a) && is_plain(b) && a.may_transmit == b.may_transmit &&
         a.may_have_holes == b.may_have_holes && a.opaque == b.opaque && a.outputs == b.outputs &&
         a.has_shadow_shader == b.has_shadow_shader;
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

bool bind_materials_again(const scene::Scene& scene, const std::set<std::string>& changed,
                          const Registry& registry, World& world) {
  if (is_used_elsewhere(scene, changed)) return false;
  const auto is_of_users = [](const auto& node) { return node->runs_code_of_users(); };
  if (std::any_of(world.nodes.begin(), world.nodes.end(), is_of_users)) return false;
  Diagnostics reported;
  Binder binder(scene, registry, world, world.light_names, reported);
  std::vector<std::pair<std::size_t, Material>> bound;
  for (std::size_t i = 0; i < world.materials.size(); ++i) {
    const Material& old = world.materials[i];
    scene::References references(scene);
    references.follow(old.name);
    if (!refers_to(references, changed)) continue;
    bound.emplace_back(i, bind_material(scene, old.name, {}, binder, reported));
    if (!can_replace(old, bound.back().second)) return false;
  }
  // Messages would be listed twice, or those of before would stay.
  if (!reported.all().empty()) return false;
  for (auto& [index, material] : bound) world.materials[index] = std::move(material);
  return true;
}

}  // namespace oriel
