// SPDX-License-Identifier: Apache-2.0
#include "scene_json.h"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "scene/element_settings.h"

namespace oriel::app {
namespace {

using nlohmann::json;

json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

json arguments_json(const std::vector<scene::Argument>& arguments);

json value_json(const scene::Value& value) {
  using Kind = scene::Value::Kind;
  switch (value.kind) {
    case Kind::Boolean:
      return value.boolean;
    case Kind::Numbers:
      return value.numbers.size() == 1 ? json(value.numbers[0]) : json(value.numbers);
    case Kind::Text:
      return value.text;
    case Kind::Connection:
      return {{"shader", value.text}};
    case Kind::Interface:
      return {{"interface", value.text}};
    case Kind::Struct:
      return {{"struct", arguments_json(value.members)}};
    case Kind::Array: {
      json items = json::array();
      for (const scene::Value& item : value.items) items.push_back(value_json(item));
      return {{"array", std::move(items)}};
    }
    case Kind::Null:
      break;
  }
  return nullptr;
}

json arguments_json(const std::vector<scene::Argument>& arguments) {
  json made = json::object();
  for (const scene::Argument& argument : arguments)
    made[argument.name] = value_json(argument.value);
  return made;
}

json shaders_json(const scene::ShaderList& list) {
  json made = json::array();
  for (const scene::ShaderUse& use : list) {
    if (!use.reference.empty())
      made.push_back({{"reference", use.reference}});
    else
      made.push_back({{"type", use.type}, {"parameters", arguments_json(use.arguments)}});
  }
  return made;
}

json camera_json(const scene::Camera& camera) {
  const scene::CameraSettings settings = scene::settings_of(camera);
  json made = {{"name", camera.name},
               {"orthographic", camera.orthographic},
               {"focal", camera.focal.value_or(1)},
               {"aperture", camera.aperture.value_or(1)},
               {"offset", {settings.offset.x, settings.offset.y}},
               {"clip", {settings.clip_near, settings.clip_far}},
               {"lens", shaders_json(camera.lens)},
               {"environment", shaders_json(camera.environment)}};
  if (camera.aspect) made["aspect"] = *camera.aspect;
  if (camera.resolution) made["resolution"] = *camera.resolution;
  return made;
}

json light_json(const scene::Light& light) {
  json made = {{"name", light.name}, {"shaders", shaders_json(light.shaders)}};
  if (light.origin) made["origin"] = vector_json(*light.origin);
  if (light.direction) made["direction"] = vector_json(*light.direction);
  if (light.spread) made["spread"] = *light.spread;
  if (light.area) {
    json values = json::array();
    for (const scene::Value& value : light.area->values)
      for (const double number : value.numbers) values.push_back(number);
    made["area"] = {{"shape", light.area->keyword}, {"numbers", std::move(values)}};
  }
  return made;
}

}  // namespace

std::string element_list(const scene::Element& element) {
  if (std::holds_alternative<scene::Camera>(element)) return "cameras";
  if (std::holds_alternative<scene::Light>(element)) return "lights";
  if (std::holds_alternative<scene::Material>(element)) return "materials";
  if (std::holds_alternative<scene::ShaderElement>(element)) return "shaders";
  return "";
}

json element_json(const scene::Element& element) {
  if (const auto* camera = std::get_if<scene::Camera>(&element)) return camera_json(*camera);
  if (const auto* light = std::get_if<scene::Light>(&element)) return light_json(*light);
  if (const auto* shader = std::get_if<scene::ShaderElement>(&element))
    return shaders_json(shader->functions);
  if (const auto* material = std::get_if<scene::Material>(&element))
    return {{"name", material->name}, {"shaders", shaders_json(material->shaders)}};
  return nullptr;
}

}  // namespace oriel::app
