// SPDX-License-Identifier: Apache-2.0
// The parameter table of a shader: name, type, default, range, unit and doc of each parameter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "base/vec.h"
#include "runtime/shading_point.h"
#include "scene/shader.h"

namespace oriel {

using scene::ParamType;

namespace photometry {
class LightProfile;
}
class ShaderNode;
class TextureNode;

// Conventions
//   A shader's parameters are a plain struct; the table lists its members. The C++ type of a member
//   determines the `.mi` type: bool boolean, int integer, float scalar, Rgba color, Vec3 vector,
//   Mat4 transform, std::string_view string, ShaderRef shader, LightRef light,
//   ColorTextureRef/ScalarTextureRef/VectorTextureRef textures, ArrayView<T> array of T.

/// A parameter of type shader; null if unset.
struct ShaderRef {
  const ShaderNode* node = nullptr;
};
/// A light instance: index into World::lights, -1 if unset.
struct LightRef {
  int index = -1;
};
/// Parameters of types material, geometry and data: the name of a scene element.
struct ElementRef {
  const std::string* name = nullptr;  ///< null = none
};
struct ColorTextureRef {
  const TextureNode* texture = nullptr;
};
struct ScalarTextureRef {
  const TextureNode* texture = nullptr;
};
struct VectorTextureRef {
  const TextureNode* texture = nullptr;
};
/// A light profile (IES, EULUMDAT); null if unset.
struct LightProfileRef {
  const photometry::LightProfile* profile = nullptr;
};
/// An array parameter; the elements live as long as the world.
template <class T>
struct ArrayView {
  const T* data = nullptr;
  int size = 0;
  const T* begin() const { return data; }
  const T* end() const { return data + size; }
};

namespace detail {
template <class T>
struct ParamTypeOf;
template <>
struct ParamTypeOf<bool> {
  static constexpr ParamType value = ParamType::Boolean;
};
template <>
struct ParamTypeOf<int> {
  static constexpr ParamType value = ParamType::Integer;
};
template <>
struct ParamTypeOf<float> {
  static constexpr ParamType value = ParamType::Scalar;
};
template <>
struct ParamTypeOf<Rgba> {
  static constexpr ParamType value = ParamType::Color;
};
template <>
struct ParamTypeOf<Vec3> {
  static constexpr ParamType value = ParamType::Vector;
};
template <>
struct ParamTypeOf<Mat4> {
  static constexpr ParamType value = ParamType::Transform;
};
template <>
struct ParamTypeOf<std::string_view> {
  static constexpr ParamType value = ParamType::String;
};
template <>
struct ParamTypeOf<ShaderRef> {
  static constexpr ParamType value = ParamType::Shader;
};
template <>
struct ParamTypeOf<LightRef> {
  static constexpr ParamType value = ParamType::Light;
};
template <>
struct ParamTypeOf<LightProfileRef> {
  static constexpr ParamType value = ParamType::LightProfile;
};
template <>
struct ParamTypeOf<ColorTextureRef> {
  static constexpr ParamType value = ParamType::ColorTexture;
};
template <>
struct ParamTypeOf<ScalarTextureRef> {
  static constexpr ParamType value = ParamType::ScalarTexture;
};
template <>
struct ParamTypeOf<VectorTextureRef> {
  static constexpr ParamType value = ParamType::VectorTexture;
};
template <class T>
struct ParamTypeOf<ArrayView<T>> {
  static constexpr ParamType value = ParamType::Array;
  static constexpr ParamType element = ParamTypeOf<T>::value;
};
template <class T>
constexpr ParamType element_type() {
  if constexpr (ParamTypeOf<T>::value == ParamType::Array)
    return ParamTypeOf<T>::element;
  else
    return ParamTypeOf<T>::value;
}
}  // namespace detail

/// How exactly a parameter is implemented; `oriel check` reports scene settings that are not Exact.
enum class Support : std::uint8_t { Exact, Approximated, Ignored };

/// One row of a shader's parameter table.
struct ParamSpec {
  const char* name;
  ParamType type;
  ParamType element;  ///< of an array; otherwise equal to type
  std::size_t offset;
  std::array<float, 4> fallback{};  ///< declared default; alpha of colours is 1 if left 0
  float min = -std::numeric_limits<float>::infinity();
  float max = std::numeric_limits<float>::infinity();
  const char* unit = "";
  const char* doc = "";
  Support support = Support::Exact;
  const char* alias = nullptr;   ///< another accepted spelling
  bool declared_default = true;  ///< false: without declared default; unset = 0
  /// For connected textures. Nearest: values that wrap around, such as angles. Interpolated: shares
  /// by which paths choose at random; the choice of filtered shares would have more noise than a
  /// picture that each path sees sharply.
  LookUp look_up = LookUp::Filtered;
  /// The shader evaluates this connection itself (ShaderNode::ask).
  bool asked_for = false;
  /// Accepts another material, connected or as a shader: see runtime/shade_input.h.
  bool takes_material = false;
  const char* text = nullptr;            ///< default of a string; null = empty
  std::span<const ParamSpec> members{};  ///< of array elements that are structs
  std::size_t stride = 0;                ///< bytes per struct
};

/// Starts a row with name, types and offset of the struct's member.
#define ORIEL_PARAM(Struct, member)                                                       \
  .name = #member, .type = ::oriel::detail::ParamTypeOf<decltype(Struct::member)>::value, \
  .element = ::oriel::detail::element_type<decltype(Struct::member)>(),                   \
  .offset = offsetof(Struct, member)

}  // namespace oriel
