// SPDX-License-Identifier: Apache-2.0
#include "geom/refined_surface.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

namespace oriel::geom {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;
using Refiner = std::unique_ptr<Far::TopologyRefiner>;

/// A vector in the form that OpenSubdiv requires.
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

// Suppresses the output of OpenSubdiv.
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

/// Interpolates columns of the cage to the last level.
struct RefinedColumns {
  explicit RefinedColumns(const Far::TopologyRefiner& r)
      : refiner(r), primvars(r), last(r.GetMaxLevel()) {}

  static std::vector<Vec3> plain(const Values& values) {
    std::vector<Vec3> column;
    column.reserve(values.size());
    for (const Weighted& w : values) column.push_back(w.v);
    return column;
  }

  Values to_last_level(const std::vector<Vec3>& column) const {
    Values values = weighted(column);
    for (int l = 1; l <= last; ++l) {
      Values next(static_cast<std::size_t>(refiner.GetLevel(l).GetNumVertices()));
      primvars.Interpolate(l, values, next);
      values = std::move(next);
    }
    return values;
  }

  std::vector<Vec3> channel(const std::vector<Vec3>& column, int c) const {
    if (column.empty() || last == 0) return column;
    Values values = weighted(column);
    for (int l = 1; l <= last; ++l) {
      Values next(static_cast<std::size_t>(refiner.GetLevel(l).GetNumFVarValues(c)));
      primvars.InterpolateFaceVarying(l, values, next, c);
      values = std::move(next);
    }
    Values limit(values.size());
    primvars.LimitFaceVarying(values, limit, c);
    return plain(limit);
  }

  const Far::TopologyRefiner& refiner;
  Far::PrimvarRefiner primvars;
  int last;
};

}  // namespace

std::unique_ptr<RefinedSurface> RefinedSurface::make(const SubdivisionCage& cage, int level) {
  Refiner refiner = cage.empty() ? nullptr : refine(cage, level);
  if (!refiner) return nullptr;
  return std::unique_ptr<RefinedSurface>(new RefinedSurface(cage, std::move(refiner)));
}

RefinedSurface::RefinedSurface(const SubdivisionCage& cage, Refiner refiner)
    : cage_(cage), refiner_(std::move(refiner)) {
  const RefinedColumns columns(*refiner_);
  const Values points = columns.to_last_level(cage.points);
  if (columns.last > 0) {
    Values limit(points.size()), du(points.size()), dv(points.size());
    columns.primvars.Limit(points, limit, du, dv);
    for (std::size_t i = 0; i < points.size(); ++i)
      tangent_normals.push_back(normalize(cross(du[i].v, dv[i].v)));
    positions = RefinedColumns::plain(limit);
  } else {
    positions = RefinedColumns::plain(points);
  }
  for (const std::vector<Vec3>& step : cage.motion) {
    const Values values = columns.to_last_level(step);
    Values limit = values;
    if (columns.last > 0) columns.primvars.Limit(values, limit);
    motion.push_back(RefinedColumns::plain(limit));
  }
  for (int c = 0; c < static_cast<int>(cage.channels.size()); ++c) {
    const SubdivisionCage::Channel& from = cage.channels[static_cast<std::size_t>(c)];
    channels.push_back({columns.channel(from.coordinate, c), columns.channel(from.basis_u, c),
                        columns.channel(from.basis_v, c)});
  }
}

RefinedSurface::Origin RefinedSurface::origin(int face) const {
  int child = face;
  for (int l = refiner_->GetMaxLevel(); l > 0; --l) {
    child = face;
    face = refiner_->GetLevel(l).GetFaceParentFace(face);
  }
  Origin origin{cage_.base_face[static_cast<std::size_t>(face)]};
  if (refiner_->GetMaxLevel() == 0) return origin;
  const auto children = refiner_->GetLevel(0).GetFaceChildFaces(face);
  for (int k = 0; k < children.size(); ++k)
    if (children[k] == child) origin.child = k;
  return origin;
}

}  // namespace oriel::geom
