// SPDX-License-Identifier: Apache-2.0
// Subdivision surfaces in a scene: base faces, creases, interpolation rules of texture spaces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/polygon_list.h"
#include "scene/value.h"

namespace oriel::scene {

/// `subdivision surface "n" ... end subdivision surface` or `ccmesh "n" ... end ccmesh`, over the
/// vertices of the group.
struct SubdivisionSurface {
  enum class Form : std::uint8_t { Surface, CcMesh };
  enum class TextureRule : std::uint8_t {
    Subdivision,  ///< smooth, like the points
    Face          ///< linear within each base face
  };
  /// A sharp or semi-sharp edge: from corner `edge` of the face to the next corner.
  struct Crease {
    std::uint32_t face = 0, edge = 0;
    float sharpness = 1;  ///< 0 smooth, 1 (and more) infinitely sharp
    bool operator==(const Crease&) const = default;
  };
  /// Removed parts of a base face.
  struct Trim {
    std::uint32_t face = 0;
    /// Bit k: the part at corner k after the first refinement; bit 3 of a triangle in Loop's
    /// scheme: the middle part. [I] by analogy with crease masks: the number is not documented
    /// publicly.
    std::uint32_t parts = 0;
    bool operator==(const Trim&) const = default;
  };
  /// Uninterpreted text after a base face: `detail`, the hierarchy in braces.
  struct Detail {
    std::uint32_t face = 0;
    UninterpretedStatement text;
    bool operator==(const Detail&) const = default;
  };
  /// `derivative order [space texture space]`: a derivative that shaders use.
  struct Derivative {
    int order = 1;
    std::optional<int> space;
    bool operator==(const Derivative&) const = default;
  };

  Form form = Form::Surface;
  std::string name;
  std::vector<int> announced;  ///< `polygon a b c d`: sizes from the exporter; empty: none
  std::vector<TextureRule> texture_rules;  ///< per texture space; default Subdivision
  PolygonList faces;                       ///< no holes
  std::vector<Crease> creases;             ///< by face, then edge
  std::vector<Trim> trims;                 ///< by face
  std::vector<Detail> details;             ///< by face
  std::vector<Derivative> derivatives;
  SourceLocation where;
  bool operator==(const SubdivisionSurface&) const = default;
};

/// Vertex mark, `cusp|conic|corner [level N] | dart`: the subdivision rule of the vertex.
struct VertexMark {
  enum class Kind : std::uint8_t { Cusp, Conic, Corner, Dart };
  std::uint32_t vertex = 0;
  Kind kind = Kind::Corner;
  std::optional<int> level;  ///< number of subdivisions the mark applies to; unset: all
  bool operator==(const VertexMark&) const = default;
};

}  // namespace oriel::scene
