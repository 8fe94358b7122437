// SPDX-License-Identifier: Apache-2.0
// Parameters of a shader from its table: declared defaults, or random values within their ranges.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <string_view>
#include <vector>

#include "runtime/shader_node.h"

namespace oriel::testing {

/// The parameter struct of a shader, without connections.
class ParamBlock {
 public:
  explicit ParamBlock(const ShaderSpec& spec)
      : spec_(spec), storage_(spec.params_size / sizeof(std::max_align_t) + 1) {
    std::memset(storage_.data(), 0, storage_.size() * sizeof(std::max_align_t));
    for (const ParamSpec& row : spec.params) {
      const auto& v = row.fallback;
      switch (row.type) {
        case ParamType::Boolean:
          set(row, v[0] != 0);
          break;
        case ParamType::Integer:
          set(row, static_cast<int>(v[0]));
          break;
        case ParamType::Scalar:
          set(row, v[0]);
          break;
        case ParamType::Color:
          set(row, Rgba(v[0], v[1], v[2], 1));
          break;
        case ParamType::Vector:
          set(row, Vec3(v[0], v[1], v[2]));
          break;
        case ParamType::Transform:
          set(row, Mat4());
          break;
        case ParamType::Light:
          set(row, LightRef{});
          break;
        case ParamType::String:
          set(row, std::string_view());
          break;
        default:
          break;
      }
    }
  }

  /// Every number, flag and colour anywhere in its range; a third of bounded ones at an end.
  void randomize(std::mt19937& engine) {
    std::uniform_real_distribution<float> unit(0, 1);
    // Unbounded ranges: how far beyond the bound is still a material somebody would write.
    constexpr float kFar = 4;
    for (const ParamSpec& row : spec_.params) {
      const float lo =
          std::isfinite(row.min) ? row.min : (std::isfinite(row.max) ? row.max - kFar : 0);
      const float hi = std::isfinite(row.max) ? row.max : lo + kFar;
      const float u = unit(engine), end = unit(engine);
      const float value = end < 0.15f ? lo : (end > 0.85f ? hi : lo + u * (hi - lo));
      switch (row.type) {
        case ParamType::Boolean:
          set(row, u < 0.5f);
          break;
        case ParamType::Integer:
          set(row, static_cast<int>(std::lround(value)));
          break;
        case ParamType::Scalar:
          set(row, value);
          break;
        case ParamType::Color:
          set(row, Rgba(unit(engine), unit(engine), unit(engine), 1));
          break;
        case ParamType::Vector:
          set(row, Vec3(unit(engine) - .5f, unit(engine) - .5f, unit(engine) + .2f) * 0.5f);
          break;
        default:
          break;
      }
    }
  }

  /// Sets a parameter by name; nothing where the shader has none of that name.
  template <class T>
  void set(std::string_view name, const T& value) {
    for (const ParamSpec& row : spec_.params)
      if (name == row.name) set(row, value);
  }
  /// The same where it is a colour.
  void set_color(std::string_view name, const Rgba& value) {
    for (const ParamSpec& row : spec_.params)
      if (name == row.name && row.type == ParamType::Color) set(row, value);
  }
  /// The texture for all texture parameters.
  void set_textures(const TextureNode* texture) {
    for (const ParamSpec& row : spec_.params)
      if (row.type == ParamType::ColorTexture || row.type == ParamType::ScalarTexture ||
          row.type == ParamType::VectorTexture)
        set(row, texture);
  }
  /// Another's value of that parameter.
  void take(const ParamBlock& other, const ParamSpec& row) {
    std::memcpy(reinterpret_cast<std::byte*>(storage_.data()) + row.offset,
                static_cast<const std::byte*>(other.data()) + row.offset, size_of(row.type));
  }
  const void* data() const { return storage_.data(); }

 private:
  template <class T>
  void set(const ParamSpec& row, const T& value) {
    std::memcpy(reinterpret_cast<std::byte*>(storage_.data()) + row.offset, &value, sizeof value);
  }

  const ShaderSpec& spec_;
  std::vector<std::max_align_t> storage_;
};

}  // namespace oriel::testing
