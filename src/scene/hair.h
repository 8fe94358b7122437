// SPDX-License-Identifier: Apache-2.0
// Hair as a scene holds it: one list of numbers, and what they are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace oriel::scene {

/// `hair ... end hair`: bundles of curves with a radius.
struct Hair {
  /// Numbers of one hair or of one vertex of it: `n` (3), `m` (3 each), `t`, `u` (1 each),
  /// `radius`.
  struct Field {
    enum class Kind : std::uint8_t { Normal, Motion, Texture, Radius, User };
    Kind kind = Kind::Radius;
    int count = 1;  ///< motion vectors, or numbers of t and u
    std::size_t numbers() const {
      const auto n = static_cast<std::size_t>(count);
      return kind == Kind::Normal ? 3 : kind == Kind::Motion ? n * 3 : kind == Kind::Radius ? 1 : n;
    }
    bool operator==(const Field&) const = default;
  };

  std::string material;  ///< empty: the instance supplies one
  std::optional<float> radius;
  std::optional<int> approximate;          ///< pieces per curve segment
  std::optional<int> degree;               ///< 1 lines (when not written), 2 or 3 Bezier curves
  std::optional<int> max_size, max_depth;  ///< of the exporter's acceleration structure
  std::vector<Field> per_hair;             ///< stand before the vertices of each hair
  std::vector<Field> per_vertex;           ///< stand behind the position of each vertex
  std::vector<float> scalars;
  std::vector<std::uint32_t> first;  ///< hairs + 1 offsets into scalars
  SourceLocation where;

  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
  bool operator==(const Hair&) const = default;
};

}  // namespace oriel::scene
