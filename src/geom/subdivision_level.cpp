// SPDX-License-Identifier: Apache-2.0
// Computes the number of refinements of a subdivision surface.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/math.h"
#include "geom/subdivide.h"

namespace oriel::geom {

namespace {

using scene::Approximation;

/// Measures of the cage that a refinement reduces.
struct Extent {
  float length = 0;  ///< of the longest edge, in the unit of the criterion
  /// of a point from the mean of its neighbours; bounds its distance from the limit
  float distance = 0;
  float angle = 0;  ///< between normals of two adjacent faces, radians
};

Vec3 face_normal(const SubdivisionCage& cage, std::size_t first, std::size_t size) {
  Vec3 sum(0);
  const auto point = [&](std::size_t k) {
    return cage.points[static_cast<std::size_t>(cage.corners[first + k % size])];
  };
  for (std::size_t k = 0; k < size; ++k) sum += cross(point(k) - point(0), point(k + 1) - point(0));
  return normalize(sum);
}

Extent measure(const SubdivisionCage& cage, const Approximation& approximation,
               const scene::TessellationView& view) {
  Extent extent;
  const auto length_of = [&](const Vec3& a, const Vec3& b) {
    return approximation.view ? view.pixels(a, b) : length(b - a);
  };
  std::vector<Vec3> sums(cage.points.size(), Vec3(0));
  std::vector<float> counts(cage.points.size(), 0);
  std::map<std::pair<int, int>, Vec3> normals;  // normal of the first face at each edge
  std::size_t first = 0;
  for (const int face_size : cage.face_sizes) {
    const auto size = static_cast<std::size_t>(face_size);
    const Vec3 normal = face_normal(cage, first, size);
    for (std::size_t k = 0; k < size; ++k) {
      const int a = cage.corners[first + k], b = cage.corners[first + (k + 1) % size];
      const Vec3& pa = cage.points[static_cast<std::size_t>(a)];
      const Vec3& pb = cage.points[static_cast<std::size_t>(b)];
      extent.length = std::max(extent.length, length_of(pa, pb));
      sums[static_cast<std::size_t>(a)] += pb;
      sums[static_cast<std::size_t>(b)] += pa;
      ++counts[static_cast<std::size_t>(a)];
      ++counts[static_cast<std::size_t>(b)];
      const auto [other, is_new] = normals.try_emplace(std::minmax(a, b), normal);
      if (!is_new)
        extent.angle =
            std::max(extent.angle, math::acos(clamp(dot(other->second, normal), -1.0f, 1.0f)));
    }
    first += size;
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (counts[i] > 0)
      extent.distance =
          std::max(extent.distance, length_of(cage.points[i], sums[i] * (1 / counts[i])));
  return extent;
}

/// Number of refinements until `extent` is at most `wanted`, if each divides it by `by`.
int refinements(float extent, float wanted, float by) {
  if (!(extent > wanted)) return 0;
  constexpr float kMax = 16;
  return static_cast<int>(std::min(kMax, std::ceil(math::log(extent / wanted) / math::log(by))));
}

}  // namespace

int subdivision_level(const SubdivisionCage& cage, const Approximation* approximation,
                      const scene::TessellationView& view) {
  if (!approximation) return kSubdivisionLevel;
  const Approximation& a = *approximation;
  if (a.technique != Approximation::Technique::Criteria)
    return std::min(static_cast<int>(a.u), scene::kMaxSubdivisions);
  const Extent extent = measure(cage, a, view);
  std::vector<int> levels;
  if (a.length > 0) levels.push_back(refinements(extent.length, a.length, 2));
  if (a.distance > 0) levels.push_back(refinements(extent.distance, a.distance, 4));
  if (a.angle > 0) levels.push_back(refinements(extent.angle, a.angle, 2));
  const int most = std::max(a.min_subdivisions, a.max_subdivisions);
  if (levels.empty()) levels.push_back(kSubdivisionLevel);
  const auto [least, greatest] = std::minmax_element(levels.begin(), levels.end());
  const int level = std::clamp(a.any ? *least : *greatest, a.min_subdivisions, most);
  if (a.max_triangles == 0) return level;
  return affordable_level(cage, level,
                          static_cast<std::size_t>(a.max_triangles) / (cage.loop ? 1 : 2));
}

std::uint64_t triangles_at_level(const SubdivisionCage& cage, int level) {
  const std::uint64_t of_face = cage.loop ? 1 : 2;
  if (level == 0) return of_face * cage.face_sizes.size();
  const std::uint64_t first = cage.loop ? cage.face_sizes.size() * 4 : cage.corners.size();
  return of_face * (first << (2 * (level - 1)));
}

int affordable_level(const SubdivisionCage& cage, int level, std::size_t most_faces) {
  // The first refinement makes a quad for each corner, later ones four faces of each.
  const std::size_t first = cage.loop ? cage.face_sizes.size() * 4 : cage.corners.size();
  int most = 1;
  for (std::size_t faces = first; most < level && faces * 4 <= most_faces; ++most) faces *= 4;
  return std::min(level, first <= most_faces ? most : 0);
}

}  // namespace oriel::geom
