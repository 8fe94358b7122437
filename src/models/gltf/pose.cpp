// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/pose.h"

#include <ImathQuat.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/math.h"
#include "base/vec.h"
#include "models/gltf/accessor.h"

namespace oriel::models::gltf {
namespace {

constexpr int kMaxNodeDepth = 600;

/// The numbers of glTF's matrices are those of matrices for row vectors, row by row.
Mat4 matrix_of(const json& numbers) {
  Mat4 m;
  for (std::size_t k = 0; k < 16; ++k)
    m[static_cast<int>(k / 4)][static_cast<int>(k % 4)] =
        number_at(numbers, k, k / 4 == k % 4 ? 1.f : 0.f);
  return m;
}

Mat4 local_of(const json& node) {
  if (const json& m = member(node, "matrix"); m.is_array()) return matrix_of(m);
  const json &t = member(node, "translation"), &r = member(node, "rotation");
  const json& s = member(node, "scale");
  Mat4 scale, move;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    scale[k][k] = number_at(s, i, 1);
    move[3][k] = number_at(t, i, 0);
  }
  Imath::Quatf turn(number_at(r, 3, 1),
                    Vec3(number_at(r, 0, 0), number_at(r, 1, 0), number_at(r, 2, 0)));
  return scale * turn.normalized().toMatrix44() * move;
}

/// Values of a sampler at a time.
class Sampler {
 public:
  Sampler(const json& root, Buffers& buffers, const json& sampler) {
    const auto input = whole(member(sampler, "input")), output = whole(member(sampler, "output"));
    if (!input || !output) throw Unreadable("a sampler of an animation has no data");
    times_ = read_numbers(root, buffers, *input).values;
    values_ = read_numbers(root, buffers, *output).values;
    const std::string interpolation = words(member(sampler, "interpolation"));
    is_step_ = interpolation == "STEP";
    is_cubic_ = interpolation == "CUBICSPLINE";
    const std::size_t parts = times_.size() * (is_cubic_ ? 3 : 1);
    width_ = parts > 0 ? values_.size() / parts : 0;
    if (width_ == 0) throw Unreadable("a sampler of an animation has too few values");
  }

  std::vector<float> at(float seconds, bool is_rotation) const {
    const auto after = std::upper_bound(times_.begin(), times_.end(), seconds);
    if (after == times_.begin()) return key(0);
    const auto i = static_cast<std::size_t>(after - times_.begin()) - 1;
    if (i + 1 == times_.size() || is_step_) return key(i);
    const float length = times_[i + 1] - times_[i];
    const float t = (seconds - times_[i]) / length;
    std::vector<float> a = key(i), b = key(i + 1);
    if (is_cubic_) return cubic(i, t, length);
    if (is_rotation && width_ == 4) return turned(a, b, t);
    for (std::size_t k = 0; k < width_; ++k) a[k] += t * (b[k] - a[k]);
    return a;
  }

 private:
  /// In tangent, value and out tangent of a cubic key are parts 0, 1 and 2.
  std::vector<float> part(std::size_t i, std::size_t part) const {
    const auto first =
        values_.begin() + static_cast<std::ptrdiff_t>((is_cubic_ ? 3 * i + part : i) * width_);
    return {first, first + static_cast<std::ptrdiff_t>(width_)};
  }
  std::vector<float> key(std::size_t i) const { return part(i, 1); }

  static std::vector<float> turned(const std::vector<float>& a, const std::vector<float>& b,
                                   float t) {
    const Imath::Quatf from(a[3], Vec3(a[0], a[1], a[2])), to(b[3], Vec3(b[0], b[1], b[2]));
    const Imath::Quatf q = Imath::slerpShortestArc(from, to, t);
    return {q.v.x, q.v.y, q.v.z, q.r};
  }

  std::vector<float> cubic(std::size_t i, float t, float length) const {
    const std::vector<float> p = key(i), q = key(i + 1), out = part(i, 2), in = part(i + 1, 0);
    const float t2 = t * t, t3 = t2 * t;
    std::vector<float> made(width_);
    for (std::size_t k = 0; k < width_; ++k)
      made[k] = (2 * t3 - 3 * t2 + 1) * p[k] + length * (t3 - 2 * t2 + t) * out[k] +
                (3 * t2 - 2 * t3) * q[k] + length * (t3 - t2) * in[k];
    return made;
  }

  std::vector<float> times_, values_;
  std::size_t width_ = 0;
  bool is_step_ = false, is_cubic_ = false;
};

class Poser {
 public:
  Poser(const json& root, Buffers& buffers) : root_(root), buffers_(buffers) {}

  json make(std::optional<float> seconds) {
    if (seconds) animate(*seconds);
    const json& nodes = member(root_, "nodes");
    worlds_.assign(nodes.size(), Mat4());
    is_placed_.assign(nodes.size(), false);
    const std::size_t scene = whole(member(root_, "scene"), 0);
    const json& scenes = member(root_, "scenes");
    if (scenes.is_array() && !scenes.empty()) {
      const std::size_t chosen = scene < scenes.size() ? scene : 0;
      for (const json& index : member(scenes[chosen], "nodes"))
        if (const auto node = whole(index)) place(*node, Mat4(), 0);
      pose_nodes(&root_["scenes"][chosen]["nodes"]);
    } else {
      place_trees();
      pose_nodes(nullptr);
    }
    return std::move(root_);
  }

 private:
  void animate(float seconds) {
    const json& animation = at(member(root_, "animations"), 0);
    const json& samplers = member(animation, "samplers");
    for (const json& channel : member(animation, "channels")) {
      const json& target = member(channel, "target");
      const auto node = whole(member(target, "node"));
      const std::string path = words(member(target, "path"));
      const json& sampler = at(samplers, whole(member(channel, "sampler"), samplers.size()));
      if (!node || *node >= root_["nodes"].size() || !root_["nodes"][*node].is_object() ||
          !sampler.is_object())
        continue;
      const bool is_known = path == "translation" || path == "rotation" || path == "scale";
      if (!is_known && path != "weights") continue;
      json& moved = root_["nodes"][*node];
      moved[path] = Sampler(root_, buffers_, sampler).at(seconds, path == "rotation");
      if (is_known) moved.erase("matrix");
    }
  }

  void place(std::size_t index, const Mat4& parent, int depth) {
    if (index >= is_placed_.size() || is_placed_[index] || depth > kMaxNodeDepth) return;
    is_placed_[index] = true;
    const json& node = member(root_, "nodes")[index];
    worlds_[index] = local_of(node) * parent;
    for (const json& child : member(node, "children"))
      if (const auto below = whole(child)) place(*below, worlds_[index], depth + 1);
  }

  /// Without scenes, the roots are the nodes that are no children.
  void place_trees() {
    std::vector<bool> is_child(is_placed_.size(), false);
    for (const json& node : member(root_, "nodes"))
      for (const json& child : member(node, "children"))
        if (const auto index = whole(child); index && *index < is_child.size())
          is_child[*index] = true;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) place(i, Mat4(), 0);
  }

  void pose_nodes(json* roots) {
    for (std::size_t i = 0; i < is_placed_.size(); ++i) {
      const json node = root_["nodes"][i];
      const auto mesh = whole(member(node, "mesh"));
      const json& written = at(member(root_, "meshes"), mesh.value_or(SIZE_MAX));
      if (!is_placed_[i] || !mesh || !written.is_object()) continue;
      const json& skin = at(member(root_, "skins"), whole(member(node, "skin"), SIZE_MAX));
      const json& weights = member(node, "weights");
      const bool is_skinned =
          skin.is_object() && !extension(node, "EXT_mesh_gpu_instancing").is_object();
      if (!is_skinned && !weights.is_array()) continue;
      json copy = written;
      if (weights.is_array()) copy["weights"] = weights;
      if (is_skinned) copy[kJoints] = joints_of(skin);
      const std::size_t index = root_["meshes"].size();
      root_["meshes"].push_back(std::move(copy));
      if (!is_skinned) {
        root_["nodes"][i]["mesh"] = index;
        continue;
      }
      root_["nodes"][i].erase("mesh");
      json place = {{"mesh", index}};
      if (node.contains("name")) place["name"] = node["name"];
      if (roots) roots->push_back(root_["nodes"].size());
      root_["nodes"].push_back(std::move(place));
    }
  }

  json joints_of(const json& skin) {
    std::vector<float> inverse;
    if (const auto accessor = whole(member(skin, "inverseBindMatrices")))
      inverse = read_numbers(root_, buffers_, *accessor).values;
    json list = json::array();
    std::size_t first = 0;
    for (const json& joint : member(skin, "joints")) {
      const std::size_t node = whole(joint, SIZE_MAX);
      Mat4 bind;
      for (std::size_t k = 0; k < 16 && first + 16 <= inverse.size(); ++k)
        bind[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = inverse[first + k];
      const Mat4 whole_way = node < worlds_.size() ? bind * worlds_[node] : bind;
      json numbers = json::array();
      for (int k = 0; k < 16; ++k) numbers.push_back(whole_way[k / 4][k % 4]);
      list.push_back(std::move(numbers));
      first += 16;
    }
    return list;
  }

  json root_;
  Buffers& buffers_;
  std::vector<Mat4> worlds_;
  std::vector<bool> is_placed_;
};

}  // namespace

std::optional<json> posed(const json& root, Buffers& buffers, std::optional<float> seconds) {
  const json& nodes = member(root, "nodes");
  const bool is_animated = seconds && at(member(root, "animations"), 0).is_object();
  if (!nodes.is_array() || !member(root, "meshes").is_array()) return std::nullopt;
  if (!is_animated && std::none_of(nodes.begin(), nodes.end(), [](const json& node) {
        return member(node, "skin").is_number() || member(node, "weights").is_array();
      }))
    return std::nullopt;
  return Poser(root, buffers).make(is_animated ? seconds : std::nullopt);
}

}  // namespace oriel::models::gltf
