// SPDX-License-Identifier: Apache-2.0
#include "models/camera_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "models/import.h"
#include "scene/hierarchy.h"

namespace oriel::models {
namespace {

/// The view frustum of a camera at the origin that looks down -z.
class Frame {
 public:
  explicit Frame(const scene::Camera& camera) {
    const float half = camera.aperture.value_or(1) / 2, shape = camera.aspect.value_or(1);
    if (camera.orthographic) {
      sides_ = {Side{Vec3(1, 0, 0), half}, Side{Vec3(-1, 0, 0), half},
                Side{Vec3(0, 1, 0), half / shape}, Side{Vec3(0, -1, 0), half / shape},
                Side{Vec3(0, 0, -1), 0}};
      return;
    }
    const float wide = half / camera.focal.value_or(1), high = wide / shape;
    sides_ = {Side{Vec3(1, 0, -wide), 0}, Side{Vec3(-1, 0, -wide), 0}, Side{Vec3(0, 1, -high), 0},
              Side{Vec3(0, -1, -high), 0}};
  }

  bool holds(const Vec3& p) const {
    return std::all_of(sides_.begin(), sides_.end(),
                       [&](const Side& side) { return side.depth(p) > 0; });
  }
  /// Exact for convex polygons; a concave polygon near the frustum may count as visible.
  bool meets(std::vector<Vec3>& polygon) {
    for (const Side& side : sides_) {
      cut_.clear();
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const float da = side.depth(a), db = side.depth(b);
        if (da > 0) cut_.push_back(a);
        if ((da > 0) != (db > 0)) cut_.push_back(a + (b - a) * (da / (da - db)));
      }
      std::swap(polygon, cut_);
    }
    return polygon.size() >= 3;
  }

 private:
  /// A plane of the frustum: inward normal, and its distance behind the eye.
  struct Side {
    Vec3 normal{0};
    float offset = 0;
    float depth(const Vec3& p) const { return dot(normal, p) + offset; }
  };
  std::vector<Side> sides_;
  std::vector<Vec3> cut_;
};

bool sees(Frame& frame, const scene::PolygonGroup& group, const Mat4& to_camera) {
  const auto at = [&](std::uint32_t corner) {
    const auto& points = group.vertices.point;
    const std::size_t index = corner < points.size() ? points[corner] : group.vectors.size();
    return index < group.vectors.size() ? transform_point(group.vectors[index], to_camera)
                                        : Vec3(0);
  };
  const scene::PolygonList& polygons = group.polygons;
  for (const std::uint32_t corner : polygons.indices)
    if (frame.holds(at(corner))) return true;
  // A large polygon can fill the frame with all vertices outside, so clip it.
  std::vector<Vec3> polygon;
  for (std::size_t i = 0; i + 1 < polygons.first.size(); ++i) {
    polygon.clear();
    for (std::size_t k = polygons.first[i]; k < polygons.first[i + 1]; ++k)
      polygon.push_back(at(polygons.indices[k]));
    if (frame.meets(polygon)) return true;
  }
  return false;
}

/// Instances of cameras that are direct members of the root group.
std::vector<std::string> cameras_of(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const std::string& member : scene.get<scene::InstanceGroup>(kRootGroup)->members) {
    const auto* instance = scene.get<scene::Instance>(member);
    if (instance && scene.get<scene::Camera>(instance->element)) names.push_back(member);
  }
  return names;
}

}  // namespace

bool sees_model(const scene::Scene& scene, const std::string& placed) {
  const auto* instance = scene.get<scene::Instance>(placed);
  const auto* camera = instance ? scene.get<scene::Camera>(instance->element) : nullptr;
  if (!camera) return false;
  Frame frame(*camera);
  const Mat4 to_camera = instance->transform.value_or(Mat4());
  Diagnostics ignored;  // rendering reports them again
  for (const scene::Leaf& leaf : scene::flatten(scene, kRootGroup, ignored)) {
    if (leaf.kind != scene::LeafKind::Object) continue;
    for (const scene::PolygonGroup& group : leaf.object()->groups)
      if (sees(frame, group, leaf.local_to_world * to_camera)) return true;
  }
  return false;
}

bool choose_camera(scene::Scene& scene, const DaylightOptions& options, Diagnostics& diagnostics) {
  const std::vector<std::string> cameras = cameras_of(scene);
  const auto& elements = scene.elements();
  const bool empty = std::none_of(elements.begin(), elements.end(), [](const scene::Element& e) {
    return std::holds_alternative<scene::Object>(e);
  });
  const auto seeing = std::find_if(cameras.begin(), cameras.end(), [&](const std::string& name) {
    return empty || sees_model(scene, name);
  });
  const bool of_file = seeing != cameras.end();
  if (seeing != cameras.begin())
    diagnostics.warning(
        "OR-MD-011", {},
        fmt::format(
            "camera \"{}\" of the file shows no part of the model; the model is rendered {}",
            cameras.front(),
            of_file ? fmt::format("with camera \"{}\"", *seeing) : "from its front"),
        "the scene still contains the cameras of the file");
  if (of_file)
    scene.renders = {{kRootGroup, *seeing, kOptions, {}}};
  else
    add_camera(scene, options);
  return of_file;
}

}  // namespace oriel::models
