// SPDX-License-Identifier: Apache-2.0
// Subdivision surfaces as a scene holds them: base faces, creases, rules of texture spaces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/polygon_list.h"
#include "scene/value.h"

namespace oriel::scene {

/// `subdivision surface "n" ... end subdivision surface` or `ccmesh "n" ... end ccmesh`, over the
/// vertices of its group.
struct SubdivisionSurface {
  enum class Form : std::uint8_t { Surface, CcMesh };
  enum class TextureRule : std::uint8_t {
    Subdivision,  ///< smooth, as the points are
    Face          ///< linear within each base face
  };
  /// An edge that stays sharper than the rest: from corner `edge` of the face to the next one.
  struct Crease {
    std::uint32_t face = 0, edge = 0;
    float sharpness = 1;  ///< 0 smooth, 1 (and more) sharp for ever
    bool operator==(const Crease&) const = default;
  };
  /// Parts of a base face that are cut away.
  struct Trim {
    std::uint32_t face = 0;
    /// Bit k: what the first refinement makes at corner k; bit 3 of a triangle by Loop's scheme its
    /// middle. [I] by the mask of creases: nothing public says what the number means.
    std::uint32_t parts = 0;
    bool operator==(const Trim&) const = default;
  };
  /// What stands behind a base face and is not followed: `detail`, the hierarchy in braces.
  struct Detail {
    std::uint32_t face = 0;
    UninterpretedStatement text;
    bool operator==(const Detail&) const = default;
  };
  /// `derivative order [space texture space]`: which derivatives shaders will ask for.
  struct Derivative {
    int order = 1;
    std::optional<int> space;
    bool operator==(const Derivative&) const = default;
  };

  Form form = Form::Surface;
  std::string name;
  std::vector<int> announced;  ///< `polygon a b c d`, sizes an exporter expects; empty: not written
  std::vector<TextureRule> texture_rules;  ///< per texture space; further ones are Subdivision
  PolygonList faces;                       ///< no holes
  std::vector<Crease> creases;             ///< by face, then edge
  std::vector<Trim> trims;                 ///< by face
  std::vector<Detail> details;             ///< by face
  std::vector<Derivative> derivatives;
  SourceLocation where;
  bool operator==(const SubdivisionSurface&) const = default;
};

/// Marks of a vertex, `cusp|conic|corner [level N] | dart`: how subdivision treats it.
struct VertexMark {
  enum class Kind : std::uint8_t { Cusp, Conic, Corner, Dart };
  std::uint32_t vertex = 0;
  Kind kind = Kind::Corner;
  std::optional<int> level;  ///< the mark holds for that many subdivisions; unset: for ever
  bool operator==(const VertexMark&) const = default;
};

}  // namespace oriel::scene
