// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include "base/math.h"

namespace oriel::models::gltf {
namespace {

constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
              kUnsignedInt = 5125, kFloat = 5126;

std::size_t components_of(const std::string& type) {
  // MAT4 of floats has no padding; MAT2 and MAT3 are not used.
  for (const auto& [name, count] :
       {std::pair("SCALAR", 1), {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}})
    if (type == name) return static_cast<std::size_t>(count);
  return 0;
}

template <class T>
double load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

double stored_at(const char* bytes, int component_type) {
  switch (component_type) {
    case kByte:
      return load<std::int8_t>(bytes);
    case kUnsignedByte:
      return load<std::uint8_t>(bytes);
    case kShort:
      return load<std::int16_t>(bytes);
    case kUnsignedShort:
      return load<std::uint16_t>(bytes);
    case kUnsignedInt:
      return load<std::uint32_t>(bytes);
    default:
      return load<float>(bytes);
  }
}

/// Elements of a buffer view, read in place.
struct Cells {
  std::string_view bytes;  ///< from the first element on
  std::size_t stride = 0;
  NumberFormat format;

  double stored(std::size_t element, std::size_t component) const {
    return stored_at(bytes.data() + element * stride + component * format.component_size(),
                     format.component_type);
  }
};

/// `place`: an object with a buffer view and an offset.
Cells cells(const json& root, Buffers& buffers, const json& place, const NumberFormat& format,
            const std::string& what) {
  const auto view = whole(member(place, "bufferView"));
  if (!view) throw Unreadable(what + " has no buffer view");
  const std::string_view bytes = buffers.view(*view);
  const std::size_t offset = whole(member(place, "byteOffset"), 0);
  const std::size_t size = format.component_size() * format.components;
  const json& written = member(at(member(root, "bufferViews"), *view), "byteStride");
  Cells made{{}, whole(written, size), format};
  if (made.stride == 0) made.stride = size;
  if (format.count == 0) return made;
  if (offset > bytes.size() || size > bytes.size() - offset ||
      format.count - 1 > (bytes.size() - offset - size) / made.stride)
    throw Unreadable(fmt::format("{} exceeds buffer view {}", what, *view));
  made.bytes = bytes.substr(offset);
  return made;
}

/// All values of an accessor, converted by `meaning`.
template <class T, class F>
std::vector<T> read(const json& root, Buffers& buffers, std::size_t index, F&& meaning) {
  const NumberFormat format = number_format(root, index);
  const std::string what = fmt::format("accessor {}", index);
  const json& accessor = at(member(root, "accessors"), index);
  const std::size_t width = format.components;
  const bool stored = !member(accessor, "bufferView").is_null();
  // Validate against the buffer view before allocating memory of the declared size.
  const Cells all = stored ? cells(root, buffers, accessor, format, what) : Cells();
  constexpr std::size_t kMaxCount = std::size_t{1} << 32;
  if (format.count > kMaxCount) throw Unreadable(what + " is too large");
  buffers.spend(format.count * width * sizeof(T));
  std::vector<T> values(format.count * width, T(0));
  if (stored)
    for (std::size_t i = 0; i < format.count; ++i)
      for (std::size_t k = 0; k < width; ++k) values[i * width + k] = meaning(all.stored(i, k));
  const json& sparse = member(accessor, "sparse");
  if (!sparse.is_object()) return values;
  const json& where = member(sparse, "indices");
  NumberFormat place;
  place.component_type = static_cast<int>(whole(member(where, "componentType"), 0));
  place.count = whole(member(sparse, "count"), 0);
  if (place.component_size() == 0)
    throw Unreadable(what + " has an invalid type of sparse indices");
  NumberFormat given = format;
  given.count = place.count;
  const Cells places = cells(root, buffers, where, place, what);
  const Cells replaced = cells(root, buffers, member(sparse, "values"), given, what);
  for (std::size_t i = 0; i < place.count; ++i) {
    const double to = places.stored(i, 0);
    if (!(to >= 0 && to < static_cast<double>(format.count)))
      throw Unreadable(what + " has a sparse index out of range");
    for (std::size_t k = 0; k < width; ++k)
      values[static_cast<std::size_t>(to) * width + k] = meaning(replaced.stored(i, k));
  }
  return values;
}

}  // namespace

std::size_t NumberFormat::component_size() const {
  switch (component_type) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

float NumberFormat::meaning(double stored) const {
  double most = 1;
  if (normalized && component_type != kFloat) {
    const bool is_signed = component_type == kByte || component_type == kShort;
    most = math::exp2(8 * static_cast<double>(component_size()) - (is_signed ? 1 : 0)) - 1;
    stored = std::max(stored / most, -1.0);
  }
  return static_cast<float>(stored);
}

NumberFormat number_format(const json& root, std::size_t index) {
  const json& accessor = at(member(root, "accessors"), index);
  if (!accessor.is_object()) throw Unreadable(fmt::format("accessor {} does not exist", index));
  NumberFormat format;
  format.component_type =
      static_cast<int>(std::min<std::size_t>(whole(member(accessor, "componentType"), 0), kFloat));
  format.normalized = member(accessor, "normalized") == json(true);
  format.components = components_of(words(member(accessor, "type")));
  const auto count = whole(member(accessor, "count"));
  if (format.component_size() == 0 || format.components == 0 || !count)
    throw Unreadable(fmt::format("accessor {} has an unknown type", index));
  format.count = *count;
  return format;
}

Column read_numbers(const json& root, Buffers& buffers, std::size_t accessor) {
  const NumberFormat format = number_format(root, accessor);
  return {format.components, read<float>(root, buffers, accessor,
                                         [&](double stored) { return format.meaning(stored); })};
}

std::vector<std::uint32_t> read_indices(const json& root, Buffers& buffers, std::size_t accessor) {
  const NumberFormat format = number_format(root, accessor);
  if (format.components != 1 || format.component_type == kFloat || format.component_type == kByte ||
      format.component_type == kShort)
    throw Unreadable(fmt::format("accessor {} does not contain integer indices", accessor));
  return read<std::uint32_t>(root, buffers, accessor,
                             [](double stored) { return static_cast<std::uint32_t>(stored); });
}

}  // namespace oriel::models::gltf
