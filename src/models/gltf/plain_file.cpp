// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/plain_file.h"

#include <algorithm>

#include "models/gltf/document.h"

namespace oriel::models::gltf {
namespace {

constexpr int kIndexType = 5125, kFloatType = 5126;

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace

std::size_t PlainFile::add_view(std::string_view content) {
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", content.size()}});
  bytes_ += content;
  return views_.size() - 1;
}

std::size_t PlainFile::add_accessor(std::string_view content, int component_type, std::size_t count,
                                    const char* type) {
  accessors_.push_back({{"bufferView", add_view(content)},
                        {"componentType", component_type},
                        {"count", count},
                        {"type", type}});
  return accessors_.size() - 1;
}

std::size_t PlainFile::add_numbers(const std::vector<float>& values, std::size_t components) {
  static constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  return add_accessor(bytes_of(values), kFloatType, values.size() / components, kTypes[components]);
}

std::size_t PlainFile::add_points(const std::vector<float>& values) {
  constexpr std::size_t kComponents = 3;
  const std::size_t index = add_numbers(values, kComponents);
  json low = json::array(), high = json::array();
  for (std::size_t k = 0; k < kComponents && k < values.size(); ++k) {
    float least = values[k], most = values[k];
    for (std::size_t i = k; i < values.size(); i += kComponents) {
      least = std::min(least, values[i]);
      most = std::max(most, values[i]);
    }
    low.push_back(least), high.push_back(most);
  }
  accessors_[index]["min"] = std::move(low);
  accessors_[index]["max"] = std::move(high);
  return index;
}

std::size_t PlainFile::add_indices(const std::vector<std::uint32_t>& indices) {
  return add_accessor(bytes_of(indices), kIndexType, indices.size(), "SCALAR");
}

std::string PlainFile::binary() const {
  json whole = root;
  whole["accessors"] = accessors_;
  whole["bufferViews"] = views_;
  whole["buffers"] = json::array({{{"byteLength", bytes_.size()}}});
  return glb(whole, bytes_);
}

}  // namespace oriel::models::gltf
