// SPDX-License-Identifier: Apache-2.0
#include "geom/subdivide.h"

#include <fmt/format.h>
#include <opensubdiv/far/error.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace oriel::geom {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using Refiner = std::unique_ptr<Far::TopologyRefiner>;

/// A vector as the refiner sums it.
struct Weighted {
  Vec3 v{0, 0, 0};
  // The refiner's names. NOLINTNEXTLINE(readability-identifier-naming)
  void Clear() { v = Vec3(0); }
  // NOLINTNEXTLINE(readability-identifier-naming)
  void AddWithWeight(const Weighted& other, float weight) { v += other.v * weight; }
};
using Values = std::vector<Weighted>;

Values weighted(const std::vector<Vec3>& column) {
  Values values;
  values.reserve(column.size());
  for (const Vec3& v : column) values.push_back({v});
  return values;
}

// What the library would print.
void say_nothing(Far::ErrorType /*type*/, const char* /*message*/) {}
void say_nothing(const char* /*message*/) {}

Refiner refine(const SubdivisionCage& cage, int level) {
  Far::SetErrorCallback(say_nothing);
  Far::SetWarningCallback(say_nothing);
  Far::TopologyDescriptor topology;
  topology.numVertices = static_cast<int>(cage.points.size());
  topology.numFaces = static_cast<int>(cage.face_sizes.size());
  topology.numVertsPerFace = cage.face_sizes.data();
  topology.vertIndicesPerFace = cage.corners.data();
  topology.numCreases = static_cast<int>(cage.crease_sharpness.size());
  topology.creaseVertexIndexPairs = cage.crease_pairs.data();
  topology.creaseWeights = cage.crease_sharpness.data();
  topology.numCorners = static_cast<int>(cage.sharp_points.size());
  topology.cornerVertexIndices = cage.sharp_points.data();
  topology.cornerWeights = cage.point_sharpness.data();
  std::vector<Far::TopologyDescriptor::FVarChannel> channels(cage.channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    channels[c].numValues = static_cast<int>(cage.channels[c].coordinate.size());
    channels[c].valueIndices = cage.channels[c].corner.data();
  }
  topology.numFVarChannels = static_cast<int>(channels.size());
  topology.fvarChannels = channels.data();

  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
  options.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_CORNERS_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  Refiner refiner(
      Factory::Create(topology, {cage.loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK, options}));
  if (!refiner || level == 0) return refiner;
  Far::TopologyRefiner::UniformOptions uniform(level);
  uniform.fullTopologyInLastLevel = true;
  refiner->RefineUniform(uniform);
  return refiner;
}

/// The refined surface with all its columns, one entry per point of the last level.
class Refined {
 public:
  Refined(const SubdivisionCage& cage, const Refiner& refiner)
      : cage_(cage), refiner_(*refiner), primvars_(*refiner), last_(refiner->GetMaxLevel()) {
    const Values points = to_last_level(cage.points);
    if (last_ > 0) {
      Values limit(points.size()), du(points.size()), dv(points.size());
      primvars_.Limit(points, limit, du, dv);
      for (std::size_t i = 0; i < points.size(); ++i)
        tangent_normals.push_back(normalize(cross(du[i].v, dv[i].v)));
      positions = plain(limit);
    } else {
      positions = plain(points);
    }
    for (const std::vector<Vec3>& step : cage.motion) {
      const Values values = to_last_level(step);
      Values limit = values;
      if (last_ > 0) primvars_.Limit(values, limit);
      motion.push_back(plain(limit));
    }
    for (int c = 0; c < static_cast<int>(cage.channels.size()); ++c) {
      const SubdivisionCage::Channel& from = cage.channels[static_cast<std::size_t>(c)];
      channels.push_back(
          {channel(from.coordinate, c), channel(from.basis_u, c), channel(from.basis_v, c)});
    }
  }

  const Far::TopologyLevel& level() const { return refiner_.GetLevel(last_); }
  /// Number, in the scene's list, of the face that a face of the last level is part of.
  std::uint32_t base_face(int face) const {
    for (int l = last_; l > 0; --l) face = refiner_.GetLevel(l).GetFaceParentFace(face);
    return cage_.base_face[static_cast<std::size_t>(face)];
  }

  std::vector<Vec3> positions;
  std::vector<Vec3> tangent_normals;  ///< of the limit; empty at level 0
  std::vector<std::vector<Vec3>> motion;
  std::vector<TextureSpace> channels;

 private:
  static std::vector<Vec3> plain(const Values& values) {
    std::vector<Vec3> column;
    column.reserve(values.size());
    for (const Weighted& w : values) column.push_back(w.v);
    return column;
  }

  Values to_last_level(const std::vector<Vec3>& column) const {
    Values values = weighted(column);
    for (int l = 1; l <= last_; ++l) {
      Values next(static_cast<std::size_t>(refiner_.GetLevel(l).GetNumVertices()));
      primvars_.Interpolate(l, values, next);
      values = std::move(next);
    }
    return values;
  }

  std::vector<Vec3> channel(const std::vector<Vec3>& column, int c) const {
    if (column.empty() || last_ == 0) return column;
    Values values = weighted(column);
    for (int l = 1; l <= last_; ++l) {
      Values next(static_cast<std::size_t>(refiner_.GetLevel(l).GetNumFVarValues(c)));
      primvars_.InterpolateFaceVarying(l, values, next, c);
      values = std::move(next);
    }
    Values limit(values.size());
    primvars_.LimitFaceVarying(values, limit, c);
    return plain(limit);
  }

  const SubdivisionCage& cage_;
  const Far::TopologyRefiner& refiner_;
  Far::PrimvarRefiner primvars_;
  int last_;
};

/// Normals of the corners of each face. Faces around a point that no sharp edge parts form a sector
/// and share one.
class CornerNormals {
 public:
  explicit CornerNormals(const Refined& refined)
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
    // A crease that ends inside the surface leaves its end smooth.
    const int parting = level_.IsVertexBoundary(v) ? 1 : 2;
    const bool smooth = sharp < parting && !refined_.tangent_normals.empty();
    if (!smooth) return add_sectors(v);
    // A sharp point alone has no tangent plane; at a boundary its one face does.
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
    // Joined across each edge that does not part them; few faces meet at a point.
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
    return std::acos(clamp(dot(a, b), -1.0f, 1.0f));
  }

  const Refined& refined_;
  const Far::TopologyLevel& level_;
  std::vector<Vec3> facets_;
  std::vector<int> first_;
  std::vector<std::uint32_t> normal_of_;
};

/// Triangles of the refined faces; a vertex for each point, normal and texture values that differ.
class MeshMaker {
 public:
  MeshMaker(const Refined& refined, Mesh& mesh)
      : refined_(refined),
        normals_(refined),
        mesh_(mesh),
        latest_(refined.positions.size(), kNone) {
    mesh_.textures.resize(refined.channels.size());
    mesh_.motion.resize(refined.motion.size());
  }

  /// slot_of(base face) is the number of its material slot.
  template <typename SlotOf>
  void make(SlotOf&& slot_of) {
    const Far::TopologyLevel& level = refined_.level();
    for (int f = 0; f < level.GetNumFaces(); ++f) {
      const int size = level.GetFaceVertices(f).size();
      corners_.clear();
      for (int k = 0; k < size; ++k) corners_.push_back(vertex(f, k));
      cut();
      mesh_.slot.resize(mesh_.triangles.size(), slot_of(refined_.base_face(f)));
    }
    mesh_.positions.push_back(Vec3(0));
    if (mesh_.slots.size() == 1) mesh_.slot.clear();
  }

 private:
  std::uint32_t vertex(int f, int k) {
    const Far::TopologyLevel& level = refined_.level();
    const auto point = static_cast<std::size_t>(level.GetFaceVertices(f)[k]);
    key_.assign(1, normals_.at(f, k));
    for (int c = 0; c < static_cast<int>(refined_.channels.size()); ++c)
      key_.push_back(static_cast<std::uint32_t>(level.GetFaceFVarValues(f, c)[k]));
    // Those of one point are a chain from its latest one.
    std::uint32_t v = latest_[point];
    while (v != kNone && !std::equal(key_.begin(), key_.end(), keys_.begin() + offset(v)))
      v = before_[v];
    if (v != kNone) return v;
    v = static_cast<std::uint32_t>(mesh_.positions.size());
    before_.push_back(latest_[point]);
    latest_[point] = v;
    keys_.insert(keys_.end(), key_.begin(), key_.end());
    mesh_.positions.push_back(refined_.positions[point]);
    mesh_.normals.push_back(normals_.normals[key_[0]]);
    for (std::size_t m = 0; m < mesh_.motion.size(); ++m)
      mesh_.motion[m].push_back(refined_.motion[m][point]);
    for (std::size_t c = 0; c < mesh_.textures.size(); ++c) {
      const TextureSpace& from = refined_.channels[c];
      const auto put = [&](const std::vector<Vec3>& source, std::vector<Vec3>& column) {
        if (!source.empty()) column.push_back(source[key_[c + 1]]);
      };
      put(from.coordinate, mesh_.textures[c].coordinate);
      put(from.basis_u, mesh_.textures[c].basis_u);
      put(from.basis_v, mesh_.textures[c].basis_v);
    }
    return v;
  }
  std::ptrdiff_t offset(std::uint32_t v) const {
    return static_cast<std::ptrdiff_t>(v * key_.size());
  }

  /// Quads along their shorter diagonal; faces of a cage as fans.
  void cut() {
    const auto distance = [this](std::size_t a, std::size_t b) {
      return length(mesh_.positions[corners_[b]] - mesh_.positions[corners_[a]]);
    };
    std::size_t start = 0;
    if (corners_.size() == 4 && distance(1, 3) < distance(0, 2)) start = 1;
    const std::size_t n = corners_.size();
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const Triangle t{corners_[start], corners_[(start + k) % n], corners_[(start + k + 1) % n]};
      const Vec3& a = mesh_.positions[t.a];
      if (cross(mesh_.positions[t.b] - a, mesh_.positions[t.c] - a) != Vec3(0))
        mesh_.triangles.push_back(t);
    }
  }

  const Refined& refined_;
  CornerNormals normals_;
  Mesh& mesh_;
  std::vector<std::uint32_t> latest_, before_;  // vertices per point, vertex per vertex
  std::vector<std::uint32_t> keys_, key_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh subdivide(const scene::PolygonGroup& group, const scene::SubdivisionSurface& surface,
               bool tagged, const scene::Approximation* approximation,
               const scene::TessellationView& view, Diagnostics& diagnostics) {
  Mesh mesh;
  mesh.tagged = tagged;
  if (!surface.details.empty())
    diagnostics.warning("OR-GEOM-020", surface.where,
                        fmt::format("surface \"{}\": trims, details and hierarchies of {} faces "
                                    "are not followed; the base faces are refined alike",
                                    surface.name, surface.details.size()));
  const SubdivisionCage cage = cage_of(group, surface);
  const int wanted = subdivision_level(cage, approximation, view);
  const int level = affordable_level(cage, wanted);
  if (level < wanted)
    diagnostics.warning("OR-GEOM-021", surface.where,
                        fmt::format("surface \"{}\" would have more than {} faces; it is refined "
                                    "{} times, not {}",
                                    surface.name, kMostFaces, level, wanted),
                        "ask for less in its approximation");
  const Refiner refiner = cage.empty() ? nullptr : refine(cage, level);
  const std::size_t left_out = refiner ? cage.dropped : surface.faces.size();
  if (left_out > 0)
    diagnostics.warning(
        "OR-GEOM-022", surface.where,
        fmt::format("surface \"{}\": {} of its faces left out (corners that coincide, are not "
                    "finite, or meet in a way that is no surface)",
                    surface.name, left_out));
  if (!refiner) return mesh;

  const Refined refined(cage, refiner);
  const auto slot_of = [&](std::uint32_t face) {
    MaterialSlot slot;
    const std::uint32_t material =
        face < surface.faces.material.size() ? surface.faces.material[face] : kNone;
    if (tagged)
      slot.label = material;
    else if (material < group.materials.size())
      slot.name = group.materials[material];
    if (!mesh.slots.empty() && mesh.slots.back() == slot)
      return static_cast<std::uint32_t>(mesh.slots.size() - 1);
    auto found = std::find(mesh.slots.begin(), mesh.slots.end(), slot);
    if (found == mesh.slots.end()) found = mesh.slots.insert(found, slot);
    return static_cast<std::uint32_t>(found - mesh.slots.begin());
  };
  MeshMaker(refined, mesh).make(slot_of);
  return mesh;
}

}  // namespace oriel::geom
