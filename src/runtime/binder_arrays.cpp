// SPDX-License-Identifier: Apache-2.0
// Array parameters: their elements are stored behind the struct of the parameters.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

#include "runtime/binder.h"

namespace oriel {

using scene::Value;

std::size_t Binder::append_elements(ShaderNode& node, std::size_t bytes) {
  constexpr std::size_t kUnit = sizeof(std::max_align_t);
  const std::size_t begin = node.storage_.size() * kUnit;
  const std::byte* before = node.constants_.data();
  std::vector<std::pair<std::size_t, std::ptrdiff_t>> arrays;  // parameter, its elements
  for (const ParamSpec& param : node.spec().params) {
    if (param.type != ParamType::Array) continue;
    const auto& view = *reinterpret_cast<const ArrayView<std::byte>*>(before + param.offset);
    if (view.data) arrays.emplace_back(param.offset, view.data - before);
  }
  node.storage_.resize(node.storage_.size() + bytes / kUnit + 1);
  auto* moved = reinterpret_cast<std::byte*>(node.storage_.data());
  // A unit has padding bytes, which resize() does not initialise.
  std::memset(moved + begin, 0, node.storage_.size() * kUnit - begin);
  node.constants_ = {moved, node.storage_.size() * kUnit};
  for (const auto& [offset, elements] : arrays)
    reinterpret_cast<ArrayView<std::byte>*>(moved + offset)->data = moved + elements;
  return begin;
}

void Binder::bind_element(ShaderNode& node, const ParamSpec& param, std::size_t offset,
                          const Value& value, Scope* scope) {
  if (param.element != ParamType::Struct) {
    // Only shaders that evaluate their connections themselves use connections within arrays.
    const bool by_name = param.element == ParamType::Shader ||
                         param.element == ParamType::ColorTexture ||
                         param.element == ParamType::LightProfile;
    if (value.kind == Value::Kind::Connection && !by_name && !node.spec().binding.deferred)
      return mismatch(node, param, value);
    return bind_value(node, param, offset, param.element, value, scope);
  }
  if (value.kind != Value::Kind::Struct) return mismatch(node, param, value);
  bind_members(node, param, offset, "", value.members, scope);
}

void Binder::bind_members(ShaderNode& node, const ParamSpec& param, std::size_t offset,
                          const std::string& prefix, const std::vector<scene::Argument>& members,
                          Scope* scope) {
  for (const scene::Argument& argument : members) {
    const std::string name = prefix + argument.name;
    if (argument.value.kind == Value::Kind::Struct) {
      bind_members(node, param, offset, name + ".", argument.value.members, scope);
      continue;
    }
    const auto member = std::find_if(param.members.begin(), param.members.end(),
                                     [&](const ParamSpec& m) { return name == m.name; });
    if (member != param.members.end())
      bind_value(node, *member, offset + member->offset, member->type, argument.value, scope);
    else
      diagnostics_.warning(
          "OR-RT-010", argument.where,
          fmt::format("elements of \"{}\" of \"{}\" have no member \"{}\"; skipped", param.name,
                      node.spec().name, name));
  }
}

void Binder::bind_array(ShaderNode& node, const ParamSpec& param, const Value& value,
                        Scope* scope) {
  struct Item {
    const Value* value;
    int light = -1;
  };
  std::vector<Item> items;
  for (const Value& item : value.items) {
    if (item.kind == Value::Kind::Null && param.element != ParamType::Shader) continue;
    if (param.element != ParamType::Light) {
      items.push_back({&item});
      continue;
    }
    if (item.kind != Value::Kind::Text) {
      mismatch(node, param, item);
      continue;
    }
    // A name may refer to a group of light instances.
    const auto found = lights_by_name_.find(item.text);
    if (found == lights_by_name_.end())
      diagnostics_.warning(
          "OR-RT-015", item.where,
          fmt::format("there is no light instance \"{}\" in the rendered scene", item.text));
    else
      for (const int index : found->second) items.push_back({&item, index});
  }
  const bool structs = param.element == ParamType::Struct;
  const std::size_t stride = structs ? param.stride : size_of(param.element);
  const std::size_t begin = append_elements(node, items.size() * stride);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::size_t at = begin + i * stride;
    std::byte* element = node.constants_.data() + at;
    if (!structs) set_default(param, param.element, element);
    for (const ParamSpec& m : param.members) set_default(m, m.type, element + m.offset);
    if (items[i].light >= 0) {
      new (element) LightRef{items[i].light};
    } else {
      bind_element(node, param, at, *items[i].value, scope);
    }
  }
  new (node.constants_.data() + param.offset)
      ArrayView<std::byte>{node.constants_.data() + begin, static_cast<int>(items.size())};
}

}  // namespace oriel
