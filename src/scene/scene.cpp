// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <algorithm>

namespace oriel::scene {

const std::string& name_of(const Element& element) {
  return std::visit([](const auto& e) -> const std::string& { return e.name; }, element);
}

SourceLocation place_of(const Element& element) {
  return std::visit([](const auto& e) { return e.where; }, element);
}

bool Scene::add(Element element) {
  const auto [entry, is_new] = by_name_.try_emplace(name_of(element), elements_.size());
  if (is_new) {
    elements_.push_back(std::move(element));
    revisions_.push_back(++last_revision_);
  } else {
    elements_[entry->second] = std::move(element);
    revisions_[entry->second] = ++last_revision_;
  }
  return is_new;
}

std::uint64_t Scene::revision(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? 0 : revisions_[found->second];
}

bool Scene::touch(std::string_view name) {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return false;
  revisions_[found->second] = ++last_revision_;
  return true;
}

bool Scene::remove(std::string_view name) {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return false;
  const std::size_t index = found->second;
  elements_.erase(elements_.begin() + static_cast<std::ptrdiff_t>(index));
  revisions_.erase(revisions_.begin() + static_cast<std::ptrdiff_t>(index));
  by_name_.erase(found);
  for (auto& [key, i] : by_name_)
    if (i > index) --i;
  return true;
}

Element* Scene::find(std::string_view name) {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &elements_[found->second];
}

const Element* Scene::find(std::string_view name) const {
  return const_cast<Scene*>(this)->find(name);
}

const ShaderDeclaration* Scene::find_declaration(std::string_view name) const {
  const auto found = std::find_if(declarations.rbegin(), declarations.rend(),
                                  [&](const ShaderDeclaration& d) { return d.name == name; });
  return found == declarations.rend() ? nullptr : &*found;
}

const Phenomenon* Scene::find_phenomenon(std::string_view name) const {
  const auto found = std::find_if(phenomena.rbegin(), phenomena.rend(),
                                  [&](const Phenomenon& p) { return p.declaration.name == name; });
  return found == phenomena.rend() ? nullptr : &*found;
}

const DataDeclaration* Scene::find_data_declaration(std::string_view name) const {
  const auto found = std::find_if(data_declarations.rbegin(), data_declarations.rend(),
                                  [&](const DataDeclaration& d) { return d.name == name; });
  return found == data_declarations.rend() ? nullptr : &*found;
}

bool Scene::operator==(const Scene& other) const {
  return elements_ == other.elements_ && declarations == other.declarations &&
         phenomena == other.phenomena && data_declarations == other.data_declarations &&
         commands == other.commands && packages == other.packages && renders == other.renders;
}

}  // namespace oriel::scene
