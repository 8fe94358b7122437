// SPDX-License-Identifier: Apache-2.0
#include "geom/subdivide.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "geom/corner_normals.h"
#include "geom/refined_surface.h"

namespace oriel::geom {

namespace {

namespace Far = OpenSubdiv::Far;

/// Whether a trim removes that child of a face.
bool cuts_away(std::uint32_t parts, int child) {
  constexpr int kMaskBits = 32;
  return child >= 0 && child < kMaskBits && (parts >> child & 1u) != 0;
}

/// Makes triangles from the refined faces, with a vertex for each distinct combination of point,
/// normal and texture values.
class MeshMaker {
 public:
  MeshMaker(const RefinedSurface& refined, Mesh& mesh)
      : refined_(refined),
        normals_(refined),
        mesh_(mesh),
        latest_(refined.positions.size(), kNone) {
    mesh_.textures.resize(refined.channels.size());
    mesh_.motion.resize(refined.motion.size());
  }

  /// slot_of(base face) returns its material slot; trims are keyed by base face.
  template <typename SlotOf>
  void make(const std::map<std::uint32_t, std::uint32_t>& trims, SlotOf&& slot_of) {
    const Far::TopologyLevel& level = refined_.level();
    for (int f = 0; f < level.GetNumFaces(); ++f) {
      const RefinedSurface::Origin origin = refined_.origin(f);
      const auto trim = trims.find(origin.face);
      if (trim != trims.end() && cuts_away(trim->second, origin.child)) continue;
      const int size = level.GetFaceVertices(f).size();
      corners_.clear();
      for (int k = 0; k < size; ++k) corners_.push_back(vertex(f, k));
      cut();
      mesh_.slot.resize(mesh_.triangles.size(), slot_of(origin.face));
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
    // Vertices of one point are a linked list, latest first.
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

  /// Splits quads along the shorter diagonal; faces of a cage become fans.
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

  const RefinedSurface& refined_;
  CornerNormals normals_;
  Mesh& mesh_;
  // latest vertex per point, previous vertex per vertex
  std::vector<std::uint32_t> latest_, before_;
  std::vector<std::uint32_t> keys_, key_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

Mesh subdivide(const scene::PolygonGroup& group, const scene::SubdivisionSurface& surface,
               bool tagged, const scene::Approximation* approximation,
               const scene::TessellationView& view, Diagnostics& diagnostics,
               std::size_t most_faces) {
  Mesh mesh;
  mesh.tagged = tagged;
  if (!surface.details.empty())
    diagnostics.warning("OR-GEOM-020", surface.where,
                        fmt::format("surface \"{}\": details and hierarchies of {} faces are "
                                    "ignored; the base faces are refined uniformly",
                                    surface.name, surface.details.size()));
  const SubdivisionCage cage = cage_of(group, surface);
  // Trims remove children of a face, so they require at least one refinement.
  const int wanted =
      std::max(subdivision_level(cage, approximation, view), surface.trims.empty() ? 0 : 1);
  const int level =
      affordable_level(cage, wanted, most_faces > 0 ? std::min(most_faces, kMaxFaces) : kMaxFaces);
  if (level < wanted && most_faces == 0)
    diagnostics.warning("OR-GEOM-021", surface.where,
                        fmt::format("surface \"{}\" exceeds {} faces; it is refined "
                                    "{} times instead of {}",
                                    surface.name, kMaxFaces, level, wanted),
                        "use a coarser approximation");
  const std::unique_ptr<RefinedSurface> refined = RefinedSurface::make(cage, level);
  const std::size_t left_out = refined ? cage.dropped : surface.faces.size();
  if (left_out > 0)
    diagnostics.warning(
        "OR-GEOM-022", surface.where,
        fmt::format("surface \"{}\": {} of its faces are skipped (coincident or non-finite "
                    "corners, or invalid topology)",
                    surface.name, left_out));
  if (!refined) return mesh;

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
  std::map<std::uint32_t, std::uint32_t> trims;
  for (const scene::SubdivisionSurface::Trim& trim : surface.trims) trims[trim.face] |= trim.parts;
  MeshMaker(*refined, mesh).make(trims, slot_of);
  return mesh;
}

}  // namespace oriel::geom
