// SPDX-License-Identifier: Apache-2.0
#include "geom/subdivision_cage.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "geom/tessellate.h"

namespace oriel::geom {

namespace {

using TextureRule = scene::SubdivisionSurface::TextureRule;

/// OpenSubdiv's infinite sharpness; a crease of 1 is mapped to it.
/// Source: OpenSubdiv, Sdc::Crease::SHARPNESS_INFINITE.
constexpr float kSharpForEver = 10;
constexpr float kFarthestCagePoint = 1e18f;

bool is_usable(const Vec3& p) {
  return std::abs(p.x) < kFarthestCagePoint && std::abs(p.y) < kFarthestCagePoint &&
         std::abs(p.z) < kFarthestCagePoint;
}

class CageMaker {
 public:
  CageMaker(const scene::PolygonGroup& group, const scene::SubdivisionSurface& surface)
      : group_(group), surface_(surface) {}

  SubdivisionCage make() {
    add_faces();
    cage_.loop = surface_.form == scene::SubdivisionSurface::Form::Surface && !cage_.empty() &&
                 std::all_of(cage_.face_sizes.begin(), cage_.face_sizes.end(),
                             [](int size) { return size == 3; });
    add_creases();
    add_marks();
    const std::size_t spaces = std::min(group_.vertices.textures.size(), kMaxTextureSpaces);
    for (std::size_t s = 0; s < spaces; ++s) add_channel(s);
    for (const auto& step : group_.vertices.motion) add_motion(step);
    return std::move(cage_);
  }

 private:
  Vec3 vector(std::uint32_t i) const {
    const Vec3 v = i < group_.vectors.size() ? group_.vectors[i] : Vec3(0);
    return is_finite(v) ? v : Vec3(0);
  }
  static std::uint32_t at(const std::vector<std::uint32_t>& column, std::uint32_t i) {
    return i < column.size() ? column[i] : kNone;
  }

  int point_of(std::uint32_t vertex) {
    const std::uint32_t place = group_.vertices.point[vertex];
    const auto [entry, is_new] = known_.try_emplace(place, static_cast<int>(cage_.points.size()));
    if (is_new) {
      cage_.points.push_back(vector(place));
      vertex_of_.push_back(vertex);
    }
    return entry->second;
  }

  bool is_face(std::uint32_t begin, std::uint32_t end) {
    places_.clear();
    for (std::uint32_t c = begin; c < end; ++c) {
      const std::uint32_t vertex = surface_.faces.indices[c];
      if (vertex >= group_.vertices.size()) return false;
      places_.push_back(group_.vertices.point[vertex]);
      if (places_.back() >= group_.vectors.size() || !is_usable(group_.vectors[places_.back()]))
        return false;
    }
    std::sort(places_.begin(), places_.end());
    return places_.size() >= 3 &&
           std::adjacent_find(places_.begin(), places_.end()) == places_.end();
  }

  void add_faces() {
    const scene::PolygonList& faces = surface_.faces;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      const std::uint32_t begin = faces.first[f], end = faces.first[f + 1];
      if (end < begin || end > faces.indices.size() || !is_face(begin, end)) {
        ++cage_.dropped;
        continue;
      }
      cage_.base_face.push_back(f);
      cage_.face_sizes.push_back(static_cast<int>(end - begin));
      for (std::uint32_t c = begin; c < end; ++c) {
        cage_.corners.push_back(point_of(faces.indices[c]));
        vertices_.push_back(faces.indices[c]);
      }
    }
  }

  void add_creases() {
    const scene::PolygonList& faces = surface_.faces;
    // Both faces of an edge may define a sharpness; the larger one is used.
    std::map<std::pair<int, int>, float> sharpness;
    for (const auto& crease : surface_.creases) {
      if (crease.face >= faces.size()) continue;
      const std::uint32_t begin = faces.first[crease.face];
      const std::uint32_t size = faces.first[crease.face + 1] - begin;
      const auto corner = [&](std::uint32_t k) {
        const std::uint32_t vertex = faces.indices[begin + k % size];
        const auto found = vertex < group_.vertices.size()
                               ? known_.find(group_.vertices.point[vertex])
                               : known_.end();
        return found == known_.end() ? -1 : found->second;
      };
      if (crease.edge >= size || !(crease.sharpness > 0)) continue;
      const auto [low, high] = std::minmax({corner(crease.edge), corner(crease.edge + 1)});
      if (low < 0 || low == high) continue;
      float& s = sharpness[{low, high}];
      s = std::max(s, std::min(1.0f, crease.sharpness) * kSharpForEver);
    }
    for (const auto& [pair, s] : sharpness) {
      cage_.crease_pairs.insert(cage_.crease_pairs.end(), {pair.first, pair.second});
      cage_.crease_sharpness.push_back(s);
    }
  }

  void add_marks() {
    for (const scene::VertexMark& mark : group_.vertices.marks) {
      if (mark.kind == scene::VertexMark::Kind::Dart || mark.vertex >= group_.vertices.size())
        continue;
      const auto point = known_.find(group_.vertices.point[mark.vertex]);
      if (point == known_.end()) continue;
      cage_.sharp_points.push_back(point->second);
      cage_.point_sharpness.push_back(
          mark.level ? std::min(kSharpForEver, static_cast<float>(*mark.level)) : kSharpForEver);
    }
  }

  // Corners at one point with equal values share one, so that the space is smooth there.
  void add_channel(std::size_t s) {
    const scene::TextureColumn& column = group_.vertices.textures[s];
    const auto& rules = surface_.texture_rules;
    const bool apart = s < rules.size() && rules[s] == TextureRule::Face;
    const bool has_basis = !column.basis_u.empty() && !column.basis_v.empty();
    SubdivisionCage::Channel& channel = cage_.channels.emplace_back();
    channel.corner.reserve(vertices_.size());
    std::vector<std::vector<int>> values_at(apart ? 0 : cage_.points.size());
    for (std::size_t c = 0; c < vertices_.size(); ++c) {
      const Vec3 coordinate = vector(at(column.coordinate, vertices_[c]));
      const Vec3 u = has_basis ? vector(at(column.basis_u, vertices_[c])) : Vec3(0);
      const Vec3 v = has_basis ? vector(at(column.basis_v, vertices_[c])) : Vec3(0);
      int value = -1;
      if (!apart)
        for (const int i : values_at[static_cast<std::size_t>(cage_.corners[c])]) {
          const auto n = static_cast<std::size_t>(i);
          if (channel.coordinate[n] == coordinate &&
              (!has_basis || (channel.basis_u[n] == u && channel.basis_v[n] == v)))
            value = i;
        }
      if (value < 0) {
        value = static_cast<int>(channel.coordinate.size());
        channel.coordinate.push_back(coordinate);
        if (has_basis) channel.basis_u.push_back(u);
        if (has_basis) channel.basis_v.push_back(v);
        if (!apart) values_at[static_cast<std::size_t>(cage_.corners[c])].push_back(value);
      }
      channel.corner.push_back(value);
    }
  }

  void add_motion(const std::vector<std::uint32_t>& step) {
    std::vector<Vec3>& column = cage_.motion.emplace_back();
    column.reserve(vertex_of_.size());
    for (const std::uint32_t vertex : vertex_of_) column.push_back(vector(at(step, vertex)));
  }

  const scene::PolygonGroup& group_;
  const scene::SubdivisionSurface& surface_;
  SubdivisionCage cage_;
  std::unordered_map<std::uint32_t, int> known_;  // indices of vectors that are points of the cage
  std::vector<std::uint32_t> vertex_of_;          // the first vertex of each point
  std::vector<std::uint32_t> vertices_;           // per corner
  std::vector<std::uint32_t> places_;             // of the current face
};

}  // namespace

SubdivisionCage cage_of(const scene::PolygonGroup& group,
                        const scene::SubdivisionSurface& surface) {
  return CageMaker(group, surface).make();
}

}  // namespace oriel::geom
