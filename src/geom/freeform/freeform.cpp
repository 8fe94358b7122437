// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/freeform.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "geom/append_mesh.h"
#include "geom/freeform/seams.h"
#include "geom/freeform/surface_mesh.h"
#include "geom/freeform/weld.h"
#include "scene/element_settings.h"

namespace oriel::geom {
namespace {

using namespace freeform;
using Kind = scene::Approximation::Kind;

/// Data shared by the surfaces of a group during tessellation.
struct GroupWork {
  const scene::Object& object;
  const scene::PolygonGroup& group;
  const scene::ApproximationContext& context;
  Diagnostics& diagnostics;
  scene::ApproximationRules rules;
  scene::Approximation standard;
  NamedCurves curves;
  std::map<std::string, std::size_t, std::less<>> number;  // usable surfaces by name
  std::vector<std::optional<SurfaceNet>> nets;             // per surface
  std::vector<std::map<std::string, Seam>> seams;          // per surface

  const scene::Approximation& of_surface(const scene::FreeSurface& surface) const {
    const scene::Approximation* a = rules.find(Kind::Surface, surface.name);
    return a ? *a : standard;
  }
  OutlineInput input(std::size_t i) const {
    const scene::FreeSurface& surface = group.freeform.surfaces[i];
    const scene::Approximation& own = of_surface(surface);
    return {*nets[i],
            range_of(surface, *nets[i]),
            curves,
            seams[i],
            [this, &own, &surface](const std::string& curve) -> const scene::Approximation& {
              const scene::Approximation* a = rules.find(Kind::Curve, curve);
              if (!a) a = rules.find(Kind::Trim, surface.name);
              return a ? *a : own;
            },
            own,
            context.view};
  }
};

void make_nets(GroupWork& work) {
  std::string fault;
  for (const scene::FreeCurve& curve : work.group.freeform.curves) {
    if (curve.space) continue;
    if (auto net = CurveNet::make(curve, work.object.bases, work.group, fault))
      work.curves.insert_or_assign(curve.name, std::move(*net));
    else
      work.diagnostics.warning("OR-GEOM-031", curve.where,
                               fmt::format("curve \"{}\" is skipped: {}", curve.name, fault));
  }
  for (const scene::FreeSurface& surface : work.group.freeform.surfaces) {
    auto net = SurfaceNet::make(surface.u, surface.v, surface.points, work.object.bases, work.group,
                                fault);
    if (net && !is_range(range_of(surface, *net))) {
      fault = "its parameter range is empty";
      net.reset();
    }
    if (!net)
      work.diagnostics.warning("OR-GEOM-030", surface.where,
                               fmt::format("surface \"{}\" is skipped: {}", surface.name, fault));
    else
      work.number.try_emplace(surface.name, work.nets.size());
    work.nets.push_back(std::move(net));
  }
  work.seams.resize(work.nets.size());
}

void make_seams(GroupWork& work, Budget& budget) {
  for (const scene::Connection& connection : work.group.freeform.connections) {
    std::size_t surface[2] = {};
    const CurveNet* curve[2] = {};
    bool fits = true;
    for (int side = 0; side < 2; ++side) {
      const auto known = work.number.find(connection.surface[side]);
      fits = fits && known != work.number.end();
      if (fits) surface[side] = known->second;
      const auto found = work.curves.find(connection.part[side].curve);
      if (found != work.curves.end()) curve[side] = &found->second;
    }
    if (!fits || !curve[0] || !curve[1]) {
      work.diagnostics.warning(
          "OR-GEOM-032", connection.where,
          fmt::format(
              "a connection of surfaces \"{}\" and \"{}\" refers to a surface or curve that "
              "does not exist",
              connection.surface[0], connection.surface[1]));
      continue;
    }
    const SeamSide a{work.input(surface[0]), *curve[0], connection.part[0]};
    const SeamSide b{work.input(surface[1]), *curve[1], connection.part[1]};
    auto [first, second] = make_seam(a, b, budget);
    work.seams[surface[0]].insert_or_assign(connection.part[0].curve, std::move(first));
    work.seams[surface[1]].insert_or_assign(connection.part[1].curve, std::move(second));
  }
}

MaterialSlot slot_of(const GroupWork& work, const scene::FreeSurface& surface) {
  MaterialSlot slot;
  if (scene::settings_of(work.object).tagged)
    slot.label = surface.material;
  else if (surface.material < work.group.materials.size())
    slot.name = work.group.materials[surface.material];
  return slot;
}

/// Point limit of each surface, such that all surfaces of a group together stay within the memory
/// limit.
std::size_t points_per_surface(std::size_t surfaces) {
  constexpr std::size_t kAll = 32'000'000, kMin = 20'000, kMax = 4'000'000;
  return std::clamp(kAll / std::max<std::size_t>(surfaces, 1), kMin, kMax);
}

}  // namespace

Mesh tessellate_freeform(const scene::Object& object, const scene::PolygonGroup& group,
                         const scene::ApproximationContext& context, Diagnostics& diagnostics) {
  Mesh mesh;
  if (group.freeform.surfaces.empty()) return mesh;
  scene::Approximation standard;
  standard.u = standard.v = kDefaultPieces;
  GroupWork work{object,   group, context, diagnostics, context.rules(group),
                 standard, {},    {},      {},          {}};
  make_nets(work);
  Budget seams_budget;
  make_seams(work, seams_budget);

  std::vector<SurfacePart> parts(work.nets.size());
  parallel_for(parts.size(), [&](std::size_t i) {
    if (!work.nets[i]) return;
    std::size_t points = points_per_surface(parts.size());
    if (context.most_triangles > 0) points = std::min(points, context.most_triangles / 2);
    Budget budget{points};
    const SurfaceInput input{object, group, group.freeform.surfaces[i], work.input(i)};
    parts[i] = make_surface(input, budget, diagnostics);
    parts[i].mesh.slots = {slot_of(work, input.surface)};
    parts[i].mesh.tagged = scene::settings_of(object).tagged;
  });
  weld_edges(parts, scene::settings_of(group).merge);
  for (const SurfacePart& part : parts) append_mesh(mesh, part.mesh);
  mesh.tagged = scene::settings_of(object).tagged;
  return mesh;
}

}  // namespace oriel::geom
