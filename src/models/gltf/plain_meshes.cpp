// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/plain_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "base/vec.h"
#include "models/gltf/accessor.h"
#include "models/gltf/draco_mesh.h"
#include "models/gltf/pose.h"

namespace oriel::models::gltf {
namespace {

constexpr std::size_t kTexcoords = 8;
constexpr std::size_t kTriangles = 4, kFan = 6;  // modes of primitives

std::string texcoord(std::size_t index) { return fmt::format("TEXCOORD_{}", index); }

/// Number of components of an attribute; 0 if the attribute is ignored.
std::size_t width_of(const std::string& name) {
  if (name == "POSITION" || name == "NORMAL") return 3;
  if (name == "TANGENT" || name == "COLOR_0") return 4;
  for (std::size_t i = 0; i < kTexcoords; ++i)
    if (name == texcoord(i)) return 2;
  return 0;
}

/// Adds an alpha of 1 to colours without alpha. Returns whether the column has the right width.
bool fit(Column& column, const std::string& name) {
  const std::size_t width = width_of(name);
  if (name == "COLOR_0" && column.components == 3) {
    std::vector<float> with_alpha;
    with_alpha.reserve(column.count() * 4);
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      with_alpha.push_back(column.values[i]);
      if (i % 3 == 2) with_alpha.push_back(1);
    }
    column = {4, std::move(with_alpha)};
  }
  return column.components == width;
}

/// Texture coordinate sets are numbered without gaps; a missing set is replaced by the next one.
void fill_gaps(json& attributes) {
  for (std::size_t i = kTexcoords - 1; i > 0; --i)
    if (attributes.contains(texcoord(i)) && !attributes.contains(texcoord(i - 1)))
      attributes[texcoord(i - 1)] = attributes[texcoord(i)];
}

class MeshMaker {
 public:
  MeshMaker(const json& root, Buffers& buffers, PlainFile& file)
      : root_(root), buffers_(buffers), file_(file) {}

  PlainMeshes all() {
    for (const json& mesh : member(root_, "meshes")) {
      json made = json::object();
      if (const std::string name = words(member(mesh, "name")); !name.empty()) made["name"] = name;
      json& primitives = made["primitives"] = json::array();
      for (const json& primitive : member(mesh, "primitives"))
        add(primitive, {member(mesh, "weights"), member(mesh, kJoints)}, primitives);
      result_.meshes.push_back(std::move(made));
    }
    return std::move(result_);
  }

 private:
  /// Morph weights and joint matrices of a mesh.
  struct Pose {
    const json &weights, &joints;
  };

  void add(const json& primitive, const Pose& pose, json& primitives) {
    try {
      primitives.push_back(plain(primitive, pose));
      ++result_.read;
    } catch (const Unreadable& error) {
      if (result_.left_out++ == 0) result_.why = error.what();
    }
  }

  json plain(const json& primitive, const Pose& pose) {
    if (extension(primitive, "KHR_draco_mesh_compression").is_object()) return of_draco(primitive);
    json made = common(primitive);
    json& attributes = made["attributes"] = json::object();
    const json& written = member(primitive, "attributes");
    const auto position = whole(member(written, "POSITION"));
    if (!position) throw Unreadable("a mesh has no positions");
    const std::size_t count = number_format(root_, *position).count;
    const std::vector<Mat4> skin = skin_of(written, pose.joints, count);
    for (const auto& [name, index] : written.items()) {
      if (width_of(name) == 0 || !whole(index)) continue;
      const bool is_skinned =
          !skin.empty() && (name == "POSITION" || name == "NORMAL" || name == "TANGENT");
      const auto added = is_skinned || moved_by(primitive, pose.weights, name)
                             ? own(morphed(primitive, pose.weights, name, *whole(index), count),
                                   name, is_skinned ? skin : std::vector<Mat4>())
                             : shared(name, *whole(index), count);
      if (added) attributes[name] = *added;
    }
    if (!attributes.contains("POSITION"))
      throw Unreadable("the positions of a mesh are not 3D points");
    fill_gaps(attributes);
    if (const json& corners = member(primitive, "indices"); !corners.is_null())
      made["indices"] = shared_corners(whole(corners, static_cast<std::size_t>(-1)), count,
                                       made["mode"] == kTriangles);
    return made;
  }

  json common(const json& primitive) const {
    json made = json::object();
    made["mode"] = whole(member(primitive, "mode"), kTriangles);
    if (made["mode"].get<std::size_t>() > kFan)
      throw Unreadable("a mesh has an unknown primitive mode");
    if (const auto material = whole(member(primitive, "material"));
        material && !at(member(root_, "materials"), *material).is_null())
      made["material"] = *material;
    return made;
  }

  json of_draco(const json& primitive) {
    json made = common(primitive);
    UnpackedMesh mesh = unpack_draco(root_, buffers_, primitive);
    json& attributes = made["attributes"] = json::object();
    for (auto& [name, column] : mesh.attributes)
      if (width_of(name) > 0 && fit(column, name))
        attributes[name] = file_.add_numbers(column.values, column.components);
    if (!attributes.contains("POSITION")) throw Unreadable("a Draco mesh has no positions");
    for (const std::uint32_t corner : mesh.corners)
      if (corner >= mesh.attributes["POSITION"].count())
        throw Unreadable("a Draco mesh has vertex indices out of range");
    fill_gaps(attributes);
    made["mode"] = kTriangles;
    made["indices"] = file_.add_indices(mesh.corners);
    return made;
  }

  Column column(const std::string& name, std::size_t accessor, std::size_t count) {
    Column column = read_numbers(root_, buffers_, accessor);
    if (column.count() != count || !fit(column, name)) return {};
    return column;
  }

  /// Index of the accessor in the new file; unset if its size does not match the mesh.
  std::optional<std::size_t> shared(const std::string& name, std::size_t accessor,
                                    std::size_t count) {
    const auto [known, is_new] = numbers_.try_emplace({accessor, width_of(name)});
    if (is_new)
      if (const Column read = column(name, accessor, count); read.count() > 0)
        known->second = {file_.add_numbers(read.values, read.components), read.count()};
    if (known->second.count != count || count == 0) return std::nullopt;
    return known->second.index;
  }

  std::size_t shared_corners(std::size_t accessor, std::size_t count, bool triangles) {
    const auto [known, is_new] = corners_.try_emplace(accessor);
    if (is_new) {
      const auto read = read_indices(root_, buffers_, accessor);
      const auto most = std::max_element(read.begin(), read.end());
      known->second = {file_.add_indices(read), most == read.end() ? 0 : std::size_t{*most} + 1};
    }
    return known->second.count <= count ? known->second.index : rest_of(accessor, count, triangles);
  }

  /// The triangles with valid vertex indices, if there are any.
  std::size_t rest_of(std::size_t accessor, std::size_t count, bool triangles) {
    const std::vector<std::uint32_t> all = read_indices(root_, buffers_, accessor);
    std::vector<std::uint32_t> left;
    for (std::size_t i = 0; triangles && i + 3 <= all.size(); i += 3) {
      const auto* const first = all.data() + i;
      if (*std::max_element(first, first + 3) < count) left.insert(left.end(), first, first + 3);
    }
    if (left.empty())
      throw Unreadable(fmt::format("accessor {} has vertex indices out of range", accessor));
    result_.lost_triangles += (all.size() - left.size()) / 3;
    return file_.add_indices(left);
  }

  static bool moved_by(const json& primitive, const json& weights, const std::string& name) {
    const json& targets = member(primitive, "targets");
    for (std::size_t i = 0; i < targets.size(); ++i)
      if (number_at(weights, i, 0) != 0 && !member(at(targets, i), name.c_str()).is_null())
        return true;
    return false;
  }

  /// The blended matrix of each vertex; none without joints.
  std::vector<Mat4> skin_of(const json& attributes, const json& joints, std::size_t count) {
    if (!joints.is_array() || joints.empty()) return {};
    std::vector<Mat4> matrices, sum(count, Mat4(0.0f));
    for (const json& joint : joints) {
      matrices.emplace_back();
      for (std::size_t k = 0; k < 16; ++k)
        matrices.back()[static_cast<int>(k / 4)][static_cast<int>(k % 4)] = number_at(joint, k, 0);
    }
    std::vector<float> total(count, 0.0f);
    for (int set = 0;; ++set) {
      const auto index = whole(member(attributes, fmt::format("JOINTS_{}", set).c_str()));
      const auto share = whole(member(attributes, fmt::format("WEIGHTS_{}", set).c_str()));
      if (!index || !share) break;
      const Column of = read_numbers(root_, buffers_, *index);
      const Column weights = read_numbers(root_, buffers_, *share);
      if (of.count() != count || weights.count() != count || of.components != 4 ||
          weights.components != 4)
        throw Unreadable("the joints of a mesh do not match its vertices");
      for (std::size_t i = 0; i < count * 4; ++i) {
        if (!(weights.values[i] > 0) || !(of.values[i] < static_cast<float>(matrices.size())))
          continue;
        sum[i / 4] += matrices[static_cast<std::size_t>(of.values[i])] * weights.values[i];
        total[i / 4] += weights.values[i];
      }
    }
    for (std::size_t v = 0; v < count; ++v)
      if (total[v] > 0)
        sum[v] *= 1 / total[v];
      else
        sum[v] = matrices.front();
    return sum;
  }

  /// Adds a column that belongs to one mesh, moved by the matrices of its vertices.
  std::optional<std::size_t> own(Column column, const std::string& name,
                                 const std::vector<Mat4>& skin) {
    if (column.count() == 0) return std::nullopt;
    buffers_.spend(column.values.size() * sizeof(float));
    for (std::size_t v = 0; v < column.count() && !skin.empty(); ++v) {
      float* const at = &column.values[v * column.components];
      const Vec3 from(at[0], at[1], at[2]);
      Vec3 to;
      if (name == "POSITION") {
        to = from * skin[v];
      } else if (name == "NORMAL") {
        to = transform_normal(from, skin[v].inverse());
        to.normalize();
      } else {
        to = transform_vector(from, skin[v]);
        to.normalize();
      }
      for (int k = 0; k < 3; ++k) at[k] = to[k];
    }
    return file_.add_numbers(column.values, column.components);
  }

  /// Applies the morph weights of the mesh.
  Column morphed(const json& primitive, const json& weights, const std::string& name,
                 std::size_t accessor, std::size_t count) {
    Column sum = column(name, accessor, count);
    const json& targets = member(primitive, "targets");
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const float weight = number_at(weights, i, 0);
      const auto target = whole(member(at(targets, i), name.c_str()));
      if (weight == 0 || !target) continue;
      const Column moved = read_numbers(root_, buffers_, *target);
      // Morph targets of tangents have no handedness.
      if (moved.count() != sum.count() || moved.components > sum.components) continue;
      for (std::size_t v = 0; v < sum.count(); ++v)
        for (std::size_t k = 0; k < moved.components; ++k)
          sum.values[v * sum.components + k] += weight * moved.values[v * moved.components + k];
    }
    return sum;
  }

  struct Added {
    std::size_t index = 0, count = 0;  ///< 1 + largest vertex index
  };
  const json& root_;
  Buffers& buffers_;
  PlainFile& file_;
  PlainMeshes result_;
  std::map<std::pair<std::size_t, std::size_t>, Added> numbers_;  ///< by accessor and width
  std::map<std::size_t, Added> corners_;
};

}  // namespace

PlainMeshes plain_meshes(const json& root, Buffers& buffers, PlainFile& file) {
  return MeshMaker(root, buffers, file).all();
}

}  // namespace oriel::models::gltf
