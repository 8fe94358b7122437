// SPDX-License-Identifier: Apache-2.0
// Hair in a scene: a list of numbers and its layout.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace oriel::scene {

/// `hair ... end hair`: bundles of curves with a radius.
struct Hair {
  /// A field of a hair or of a vertex: `n` (3 numbers), `m` (3 each), `t`, `u` (1 each), `radius`.
  struct Field {
    enum class Kind : std::uint8_t { Normal, Motion, Texture, Radius, User };
    Kind kind = Kind::Radius;
    int count = 1;  ///< number of motion vectors, or of values of t and u
    std::size_t numbers() const {
      const auto n = static_cast<std::size_t>(count);
      return kind == Kind::Normal ? 3 : kind == Kind::Motion ? n * 3 : kind == Kind::Radius ? 1 : n;
    }
    bool operator==(const Field&) const = default;
  };

  std::string material;  ///< empty: from the instance
  std::optional<float> radius;
  std::optional<int> approximate;          ///< pieces per curve segment
  std::optional<int> degree;               ///< 1 lines (default), 2 or 3 Bezier curves
  std::optional<int> max_size, max_depth;  ///< for the acceleration structure of the exporter
  std::vector<Field> per_hair;             ///< before the vertices of each hair
  std::vector<Field> per_vertex;           ///< after the position of each vertex
  std::vector<float> scalars;
  std::vector<std::uint32_t> first;  ///< hairs + 1 offsets into scalars
  SourceLocation where;

  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
  bool operator==(const Hair&) const = default;
};

}  // namespace oriel::scene
