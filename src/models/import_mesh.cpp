// SPDX-License-Identifier: Apache-2.0
#include "models/import_mesh.h"

#include <assimp/mesh.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/math.h"

namespace oriel::models {
namespace {

Vec3 vec(const aiVector3D& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) ? Vec3(v.x, v.y, v.z)
                                                                        : Vec3(0);
}

/// Appends a column of vectors; returns the index of the first.
template <class F>
std::uint32_t append(scene::PolygonGroup& group, const aiVector3D* values, unsigned count, F&& f) {
  const auto first = static_cast<std::uint32_t>(group.vectors.size());
  for (unsigned i = 0; i < count; ++i) group.vectors.push_back(f(vec(values[i])));
  return first;
}
std::uint32_t append(scene::PolygonGroup& group, const aiVector3D* values, unsigned count) {
  return append(group, values, count, [](const Vec3& v) { return v; });
}

std::vector<std::uint32_t> column(std::uint32_t first, unsigned count) {
  std::vector<std::uint32_t> indices(count);
  for (unsigned i = 0; i < count; ++i) indices[i] = first + i;
  return indices;
}

scene::Statement flag(const char* keyword) { return {keyword, false, {}, {}}; }

/// Linear vertex colour, or its alpha.
Vec3 color_of(const aiMesh& mesh, unsigned corner, bool alpha, float gamma) {
  const aiColor4D& c = mesh.mColors[0][corner];
  const auto light = [&](float x) { return x > 0 && std::isfinite(x) ? math::pow(x, gamma) : 0; };
  return alpha ? Vec3(c.a >= 0 ? std::min(c.a, 1.0f) : 0)
               : Vec3(light(c.r), light(c.g), light(c.b));
}

/// Values of one texture space: transformed texture coordinates or colours.
std::vector<std::uint32_t> coordinates(const aiMesh& mesh, const TextureSpace& space, float gamma,
                                       scene::PolygonGroup& group) {
  const unsigned channels = mesh.GetNumUVChannels(), count = mesh.mNumVertices;
  const auto first = static_cast<std::uint32_t>(group.vectors.size());
  if (space.channel >= kColorChannel) {
    if (!mesh.HasVertexColors(0)) {
      group.vectors.emplace_back(1);
      return std::vector<std::uint32_t>(count, first);
    }
    for (unsigned i = 0; i < count; ++i)
      group.vectors.push_back(color_of(mesh, i, space.channel == kAlphaChannel, gamma));
    return column(first, count);
  }
  if (channels == 0) {
    group.vectors.emplace_back(0);
    return std::vector<std::uint32_t>(count, first);
  }
  append(group, mesh.mTextureCoords[std::min(space.channel, channels - 1)], count,
         [&](const Vec3& uv) { return space.of(uv); });
  return column(first, count);
}

/// Adds the requested texture spaces; if the mesh lacks a channel, the preceding channel is used.
void add_texture_spaces(const aiMesh& mesh, const SurfaceSpaces& surface,
                        scene::PolygonGroup& group) {
  const unsigned channels = mesh.GetNumUVChannels(), count = mesh.mNumVertices;
  std::vector<TextureSpace> spaces = surface.spaces;
  const auto asks_for = [&](unsigned channel) {
    return std::any_of(spaces.begin(), spaces.end(),
                       [&](const TextureSpace& space) { return space.channel == channel; });
  };
  if (channels == 0 && !asks_for(kColorChannel)) return;
  for (unsigned i = 0; i < channels && spaces.size() < kMaxTextureSpaces; ++i)
    if (!asks_for(i)) spaces.push_back({.channel = i});
  for (const TextureSpace& space : spaces)
    group.vertices.textures.push_back(
        {coordinates(mesh, space, surface.color_gamma, group), {}, {}});
  if (!surface.tangents || !mesh.HasTangentsAndBitangents()) return;
  group.vertices.textures[0].basis_u = column(append(group, mesh.mTangents, count), count);
  group.vertices.textures[0].basis_v = column(append(group, mesh.mBitangents, count), count);
}

}  // namespace

scene::Object object_of(const aiMesh& mesh, std::string name, const SurfaceSpaces& surface) {
  scene::Object object;
  object.name = std::move(name);
  object.flags = {flag("visible"), flag("shadow"), flag("trace")};
  scene::PolygonGroup group;
  const unsigned count = mesh.mNumVertices;
  group.vertices.point = column(append(group, mesh.mVertices, count), count);
  if (mesh.HasNormals()) group.vertices.normal = column(append(group, mesh.mNormals, count), count);
  add_texture_spaces(mesh, surface, group);
  scene::PolygonList& polygons = group.polygons;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    const unsigned* const begin = face.mIndices;
    const unsigned* const end = begin + face.mNumIndices;
    if (face.mNumIndices < 3 ||
        std::any_of(begin, end, [&](unsigned index) { return index >= count; }))
      continue;
    if (polygons.first.empty()) polygons.first.push_back(0);
    polygons.indices.insert(polygons.indices.end(), begin, end);
    polygons.first.push_back(static_cast<std::uint32_t>(polygons.indices.size()));
  }
  object.groups.push_back(std::move(group));
  return object;
}

}  // namespace oriel::models
