// SPDX-License-Identifier: Apache-2.0
// Normals of a refined surface with sharp edges. Private to subdivide.cpp.
#pragma once

#include <algorithm>
#include <vector>

#include "base/math.h"
#include "geom/refined_surface.h"

namespace oriel::geom {

/// Normals of the corners of each face. Faces around a point that are not separated by sharp edges
/// form a sector and share a normal.
class CornerNormals {
 public:
  explicit CornerNormals(const RefinedSurface& refined)
      : refined_(refined), level_(refined.level()), facets_(facets()) {
    first_.reserve(static_cast<std::size_t>(level_.GetNumFaces()) + 1);
    int corners = 0;
    for (int f = 0; f < level_.GetNumFaces(); ++f) {
      first_.push_back(corners);
      corners += level_.GetFaceVertices(f).size();
    }
    normal_of_.resize(static_cast<std::size_t>(corners));
    for (int v = 0; v < level_.GetNumVertices(); ++v) add_point(v);
  }

  std::vector<Vec3> normals;
  /// Index into normals for corner k of face f.
  std::uint32_t at(int face, int k) const { return normal_of_[corner_number(face, k)]; }

 private:
  std::vector<Vec3> facets() const {
    std::vector<Vec3> result;
    for (int f = 0; f < level_.GetNumFaces(); ++f) {
      const auto corners = level_.GetFaceVertices(f);
      const auto p = [&](int k) {
        return refined_.positions[static_cast<std::size_t>(corners[k % corners.size()])];
      };
      Vec3 sum(0);
      for (int k = 1; k + 1 < corners.size(); ++k) sum += cross(p(k) - p(0), p(k + 1) - p(0));
      result.push_back(normalize(sum));
    }
    return result;
  }

  std::size_t corner_number(int face, int k) const {
    return static_cast<std::size_t>(first_[static_cast<std::size_t>(face)]) +
           static_cast<std::size_t>(k);
  }

  void set(int face, int corner, std::uint32_t normal) {
    normal_of_[corner_number(face, corner)] = normal;
  }

  bool parts(int edge) const {
    return level_.IsEdgeInfSharp(edge) || level_.IsEdgeNonManifold(edge);
  }

  void add_point(int v) {
    const auto faces = level_.GetVertexFaces(v);
    const auto corners = level_.GetVertexFaceLocalIndices(v);
    int sharp = 0;
    for (const int e : level_.GetVertexEdges(v))
      sharp += parts(e) && level_.GetEdgeFaces(e).size() > 1;
    // A crease that ends inside the surface leaves its end point smooth.
    const int parting = level_.IsVertexBoundary(v) ? 1 : 2;
    const bool smooth = sharp < parting && !refined_.tangent_normals.empty();
    if (!smooth) return add_sectors(v);
    // A sharp point has no tangent plane, except at a boundary where it has only one face.
    const bool tip = level_.IsVertexInfSharp(v) && faces.size() > 1;
    normals.push_back(tip ? Vec3(0) : refined_.tangent_normals[static_cast<std::size_t>(v)]);
    for (int i = 0; i < faces.size(); ++i)
      set(faces[i], corners[i], static_cast<std::uint32_t>(normals.size() - 1));
  }

  void add_sectors(int v) {
    const auto faces = level_.GetVertexFaces(v);
    const auto corners = level_.GetVertexFaceLocalIndices(v);
    const auto count = static_cast<std::size_t>(faces.size());
    std::vector<std::size_t> sector(count);
    for (std::size_t i = 0; i < count; ++i) sector[i] = i;
    // Joins faces across each edge that does not separate them; few faces meet at a point.
    for (const int e : level_.GetVertexEdges(v)) {
      if (parts(e)) continue;
      const auto sides = level_.GetEdgeFaces(e);
      for (int k = 1; k < sides.size(); ++k) {
        const std::size_t a = sector[index_of(faces, sides[0])];
        const std::size_t b = sector[index_of(faces, sides[k])];
        std::replace(sector.begin(), sector.end(), b, a);
      }
    }
    for (std::size_t s = 0; s < count; ++s) {
      Vec3 sum(0);
      const auto number = static_cast<std::uint32_t>(normals.size());
      bool used = false;
      for (std::size_t i = 0; i < count; ++i) {
        if (sector[i] != s) continue;
        const int f = faces[static_cast<int>(i)];
        sum += facets_[static_cast<std::size_t>(f)] * angle_at(f, corners[static_cast<int>(i)]);
        set(f, corners[static_cast<int>(i)], number);
        used = true;
      }
      if (used) normals.push_back(normalize(sum));
    }
  }

  template <typename Array>
  static std::size_t index_of(const Array& faces, int face) {
    for (int i = 0; i < faces.size(); ++i)
      if (faces[i] == face) return static_cast<std::size_t>(i);
    return 0;
  }

  float angle_at(int face, int k) const {
    const auto corners = level_.GetFaceVertices(face);
    const auto p = [&](int i) {
      return refined_.positions[static_cast<std::size_t>(corners[i % corners.size()])];
    };
    const Vec3 a = normalize(p(k + 1) - p(k)), b = normalize(p(k + corners.size() - 1) - p(k));
    return math::acos(clamp(dot(a, b), -1.0f, 1.0f));
  }

  const RefinedSurface& refined_;
  const OpenSubdiv::Far::TopologyLevel& level_;
  std::vector<Vec3> facets_;
  std::vector<int> first_;
  std::vector<std::uint32_t> normal_of_;
};

}  // namespace oriel::geom
