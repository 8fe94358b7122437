// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/draco_mesh.h"

#include <draco/compression/decode.h>

#include <array>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

namespace oriel::models::gltf {
namespace {

Column column_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute,
                 const NumberFormat& format, Buffers& buffers) {
  constexpr int kMaxComponents = 4;
  const int width = std::min<int>(attribute.num_components(), kMaxComponents);
  Column column{static_cast<std::size_t>(width), {}};
  buffers.spend(std::size_t{mesh.num_points()} * column.components * sizeof(float));
  column.values.reserve(std::size_t{mesh.num_points()} * column.components);
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
    std::array<float, kMaxComponents> value{};
    const draco::AttributeValueIndex at = attribute.mapped_index(i);
    if (at.value() >= attribute.size() ||
        !attribute.ConvertValue<float>(at, static_cast<std::int8_t>(width), value.data()))
      throw Unreadable("a Draco mesh has attributes that cannot be read");
    // Draco scales attributes that it marks as normalized; for others the accessor defines the
    // scale.
    for (int k = 0; k < width; ++k)
      column.values.push_back(attribute.normalized()
                                  ? value[static_cast<std::size_t>(k)]
                                  : format.meaning(value[static_cast<std::size_t>(k)]));
  }
  return column;
}

std::unique_ptr<draco::Mesh> decode(draco::DecoderBuffer& source) {
  const std::string what = "a Draco mesh cannot be decompressed";
  try {
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&source);
    if (decoded.ok()) return std::move(decoded).value();
    throw Unreadable(what + ": " + decoded.status().error_msg());
  } catch (const std::bad_alloc&) {
    // Draco allocates whatever size the data declares.
    throw Unreadable(what);
  } catch (const std::length_error&) {
    throw Unreadable(what);
  }
}

}  // namespace

UnpackedMesh unpack_draco(const json& root, Buffers& buffers, const json& primitive) {
  const json& packed = extension(primitive, "KHR_draco_mesh_compression");
  const auto view = whole(member(packed, "bufferView"));
  if (!view) throw Unreadable("a Draco mesh has no buffer view");
  const std::string_view bytes = buffers.view(*view);
  draco::DecoderBuffer source;
  source.Init(bytes.data(), bytes.size());
  const std::unique_ptr<draco::Mesh> decoded = decode(source);
  const draco::Mesh& mesh = *decoded;
  UnpackedMesh made;
  for (const auto& [name, id] : member(packed, "attributes").items()) {
    const auto accessor = whole(member(member(primitive, "attributes"), name.c_str()));
    const auto unique = whole(id);
    if (!accessor || !unique) continue;
    if (const draco::PointAttribute* attribute =
            mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(*unique)))
      made.attributes[name] = column_of(mesh, *attribute, number_format(root, *accessor), buffers);
  }
  buffers.spend(std::size_t{mesh.num_faces()} * 3 * sizeof(std::uint32_t));
  made.corners.reserve(std::size_t{mesh.num_faces()} * 3);
  for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i)
    for (const draco::PointIndex& corner : mesh.face(i)) made.corners.push_back(corner.value());
  return made;
}

}  // namespace oriel::models::gltf
