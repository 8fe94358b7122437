// SPDX-License-Identifier: Apache-2.0
#include "sdk/shader_elements.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "oriel/sdk/shader/enums.h"
#include "sdk/tags.h"

namespace oriel::sdk {

void ShaderElements::Free::operator()(void* memory) const { std::free(memory); }

miTag ShaderElements::add(Element element) {
  const std::lock_guard lock(mutex_);
  if (made_ >= kMaxIndex) return miNULLTAG;
  const miTag tag = make_tag(TagKind::Element, made_++);
  elements_.emplace(tag, std::move(element));
  return tag;
}

miTag ShaderElements::create(int type, std::size_t bytes) {
  if (bytes > kMaxBytes) return miNULLTAG;
  Element element;
  element.type = type;
  element.size = bytes;
  element.bytes.reset(std::calloc(1, std::max<std::size_t>(bytes, 1)));
  return element.bytes ? add(std::move(element)) : miNULLTAG;
}

miTag ShaderElements::create(std::shared_ptr<geom::PointTree> tree) {
  Element element;
  element.type = miSCENE_VENDOR;
  element.tree = std::move(tree);
  return add(std::move(element));
}

bool ShaderElements::resize(miTag tag, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  const auto found = elements_.find(tag);
  if (found == elements_.end() || !found->second.bytes || bytes > kMaxBytes) return false;
  Element& element = found->second;
  void* memory = std::realloc(element.bytes.get(), std::max<std::size_t>(bytes, 1));
  if (!memory) return false;
  static_cast<void>(element.bytes.release());  // now owned by the new block
  element.bytes.reset(memory);
  if (bytes > element.size)
    std::memset(static_cast<std::byte*>(memory) + element.size, 0, bytes - element.size);
  element.size = bytes;
  return true;
}

bool ShaderElements::erase(miTag tag) {
  const std::lock_guard lock(mutex_);
  const auto found = elements_.find(tag);
  if (found == elements_.end() || !found->second.bytes) return false;
  elements_.erase(found);
  return true;
}

void ShaderElements::erase_tree(miTag tag) {
  const std::lock_guard lock(mutex_);
  const auto found = elements_.find(tag);
  if (found != elements_.end() && found->second.tree) elements_.erase(found);
}

void ShaderElements::clear() {
  const std::lock_guard lock(mutex_);
  elements_.clear();
  pinned_.clear();
  made_ = 0;
}

const ShaderElements::Element* ShaderElements::find(miTag tag) const {
  const auto found = elements_.find(tag);
  return found == elements_.end() ? nullptr : &found->second;
}

void* ShaderElements::bytes(miTag tag) {
  const std::lock_guard lock(mutex_);
  const Element* element = find(tag);
  return element ? element->bytes.get() : nullptr;
}

std::size_t ShaderElements::size(miTag tag) const {
  const std::lock_guard lock(mutex_);
  const Element* element = find(tag);
  return element ? element->size : 0;
}

int ShaderElements::type(miTag tag) const {
  const std::lock_guard lock(mutex_);
  const Element* element = find(tag);
  return element ? element->type : static_cast<int>(miSCENE_NONE);
}

geom::PointTree* ShaderElements::pin(miTag tag) {
  const std::lock_guard lock(mutex_);
  const Element* element = find(tag);
  if (!element || !element->tree) return nullptr;
  Pinned& pinned = pinned_[element->tree.get()];
  pinned.tree = element->tree;
  ++pinned.times;
  return pinned.tree.get();
}

void ShaderElements::unpin(const geom::PointTree* tree) {
  const std::lock_guard lock(mutex_);
  const auto found = pinned_.find(tree);
  if (found != pinned_.end() && --found->second.times == 0) pinned_.erase(found);
}

ShaderElements::Sum ShaderElements::sum() const {
  const std::lock_guard lock(mutex_);
  Sum all;
  for (const auto& [tag, element] : elements_) {
    ++all.elements;
    all.bytes += element.size + (element.tree ? element.tree->bytes() : 0);
  }
  return all;
}

}  // namespace oriel::sdk
