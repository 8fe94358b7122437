// SPDX-License-Identifier: Apache-2.0
#include "models/import.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "models/axes.h"
#include "models/import_material.h"
#include "models/import_mesh.h"
#include "models/import_texture.h"
#include "models/import_view.h"
#include "models/read_model.h"
#include "models/shader_call.h"

namespace oriel::models {
namespace {

namespace fs = std::filesystem;

/// Maximum nesting depth of nodes.
constexpr int kMaxDepth = 500;

/// Scenes use row vectors, assimp column vectors.
Mat4 matrix(const aiMatrix4x4& m) {
  return Mat4(m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4,
              m.c4, m.d4);
}

scene::Statement statement(std::string keyword, std::vector<scene::Value> values,
                           bool quoted = false) {
  return {std::move(keyword), quoted, std::move(values), {}};
}

scene::Value word(std::string content) {
  scene::Value value = text(std::move(content));
  value.bare = true;
  return value;
}

/// Adds a model to a scene.
class Builder {
 public:
  Builder(const aiScene& model, const std::string& path,
          const std::map<std::string, GltfExtras>& extras, const ImportOptions& options,
          Diagnostics& diagnostics)
      : model_(model),
        extras_(extras),
        colors_(colors_of(suffix_of(path))),
        is_ifc_(suffix_of(path) == ".ifc"),
        options_(options),
        textures_(options_, fs::path(path).parent_path().string(), scene_, diagnostics),
        diagnostics_(diagnostics) {}

  scene::Scene build() {
    scene_.packages = {"base.mi", "physics.mi", "architectural.mi"};
    for (unsigned i = 0; i < model_.mNumMaterials; ++i)
      materials_.push_back(
          add_material(model_, i, extras_, colors_, textures_, scene_, diagnostics_));
    if (std::any_of(materials_.begin(), materials_.end(),
                    [](const ImportedMaterial& made) { return made.needs_own_package; }))
      scene_.packages.emplace_back("oriel.mi");
    add_options();
    for (unsigned i = 0; i < model_.mNumMeshes; ++i) add_mesh(i);
    if (model_.mRootNode) add_node(*model_.mRootNode, upright(model_, options_.up), 0);
    for (unsigned i = 0; i < model_.mNumLights; ++i) add_light(*model_.mLights[i]);
    for (unsigned i = 0; i < model_.mNumCameras; ++i) add_camera(*model_.mCameras[i]);
    scene_.add(std::move(root_));
    if (std::all_of(objects_.begin(), objects_.end(),
                    [](const std::string& name) { return name.empty(); }))
      diagnostics_.warning("OR-MD-012", {}, "the file has no surfaces; the picture will be empty");
    if (!first_camera_.empty()) scene_.renders.push_back({kRootGroup, first_camera_, kOptions, {}});
    return std::move(scene_);
  }

 private:
  void add_options() {
    scene::Options options;
    options.name = kOptions;
    options.statements = {statement("samples", {numbers({0, 2}, true)}),
                          statement("trace depth", {numbers({8, 8, 16}, true)}),
                          statement("gamma", {numbers({kTextureGamma})}),
                          statement("indirect", {text("path")}, true)};
    if (std::any_of(materials_.begin(), materials_.end(),
                    [](const ImportedMaterial& made) { return made.absorbs; }))
      options.statements.push_back(statement("shadow", {word("segments")}));
    scene_.add(std::move(options));
  }

  void add_mesh(unsigned index) {
    const aiMesh& mesh = *model_.mMeshes[index];
    const std::string wish =
        mesh.mName.length > 0 ? mesh.mName.C_Str() : fmt::format("mesh_{}", index);
    const unsigned material = mesh.mMaterialIndex;
    scene::Object object =
        object_of(mesh, unique_name(scene_, wish),
                  material < materials_.size() ? materials_[material].surface : SurfaceSpaces());
    objects_.push_back(object.groups[0].polygons.size() > 0 ? object.name : "");
    if (!objects_.back().empty()) scene_.add(std::move(object));
  }

  void add_node(const aiNode& node, const Mat4& parent, int depth) {
    if (depth > kMaxDepth) {
      diagnostics_.warning("OR-MD-002", {},
                           fmt::format("nodes nested deeper than {} are skipped", kMaxDepth));
      return;
    }
    const Mat4 to_world = matrix(node.mTransformation) * parent;
    const std::string name = name_of(node);
    if (is_ifc_ && into_ == &root_ && name.starts_with("IfcBuildingStorey_")) {
      add_storey(node, parent, depth, name);
      return;
    }
    nodes_.try_emplace(node.mName.C_Str(), to_world);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const unsigned mesh = node.mMeshes[i];
      if (mesh >= objects_.size() || objects_[mesh].empty()) continue;
      const unsigned material = model_.mMeshes[mesh]->mMaterialIndex;
      place(!name.empty() ? name : objects_[mesh], objects_[mesh], to_world,
            material < materials_.size() ? materials_[material].name : "");
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
      add_node(*node.mChildren[i], to_world, depth + 1);
  }

  /// As written; of IFC without the global id behind the name.
  std::string name_of(const aiNode& node) const {
    constexpr std::size_t kGlobalId = 22;
    std::string name = node.mName.C_Str();
    if (is_ifc_ && name.starts_with("Ifc") && name.size() > kGlobalId + 1 &&
        name[name.size() - kGlobalId - 1] == '_')
      name.resize(name.size() - kGlobalId - 1);
    return name;
  }

  /// Adds a group of all that a storey contains.
  void add_storey(const aiNode& node, const Mat4& parent, int depth, const std::string& name) {
    scene::InstanceGroup storey{unique_name(scene_, name), {}, {}, {}};
    const std::string group = storey.name;
    scene_.add(storey);  // keeps the name
    into_ = &storey;
    add_node(node, parent, depth);
    into_ = &root_;
    scene_.remove(group);
    if (storey.members.empty()) return;
    scene_.add(std::move(storey));  // behind its members
    place(group, group, Mat4());
  }

  /// Adds an instance to the group; returns its name.
  std::string place(const std::string& wish, const std::string& element, const Mat4& to_world,
                    const std::string& material = {}) {
    scene::Instance instance;
    instance.name = unique_name(scene_, wish + "_inst");
    instance.element = element;
    const float volume = to_world.determinant();
    if (std::isfinite(volume) && volume != 0) {
      if (to_world != Mat4()) instance.transform = to_world.inverse();
    } else {
      diagnostics_.warning(
          "OR-MD-005", {},
          fmt::format("the transform of \"{}\" is singular or not finite and is ignored",
                      instance.name));
    }
    if (!material.empty()) instance.materials = {material};
    into_->members.push_back(instance.name);
    std::string name = instance.name;
    scene_.add(std::move(instance));
    return name;
  }

  void add_light(const aiLight& source) {
    const std::string name =
        unique_name(scene_, source.mName.length > 0 ? source.mName.C_Str() : "light");
    auto light = light_of(source, nodes_);
    if (!light) {
      diagnostics_.note("OR-MD-006", {},
                        fmt::format("light \"{}\" has an unsupported type and is skipped", name));
      return;
    }
    light->element.name = name;
    scene_.add(std::move(light->element));
    place(name, name, light->to_world);
  }

  void add_camera(const aiCamera& source) {
    const std::string name =
        unique_name(scene_, source.mName.length > 0 ? source.mName.C_Str() : "camera");
    auto camera = camera_of(model_, source, nodes_);
    camera.element.name = name;
    scene_.add(std::move(camera.element));
    const std::string placed = place(name, name, camera.to_world);
    if (first_camera_.empty()) first_camera_ = placed;
  }

  const aiScene& model_;
  const std::map<std::string, GltfExtras>& extras_;
  const ColorsAre colors_;
  const bool is_ifc_;
  const ImportOptions options_;
  scene::Scene scene_;
  TextureMaker textures_;
  Diagnostics& diagnostics_;
  scene::InstanceGroup root_{kRootGroup, {}, {}, {}};
  std::vector<ImportedMaterial> materials_;
  std::vector<std::string> objects_;
  NodePlaces nodes_;
  std::string first_camera_;
  scene::InstanceGroup* into_ = &root_;  ///< the group that instances join
};

}  // namespace

std::string lower_suffix(const std::string& path) { return suffix_of(path); }

std::optional<scene::Scene> import_model(const std::string& path, const ImportOptions& options,
                                         Diagnostics& diagnostics) {
  ImportOptions known = options;
  known.files.permit(std::filesystem::path(path).parent_path().string());
  if (!options.texture_folder.empty()) known.files.permit(options.texture_folder);
  const ReadModel read = read_model(path, known, diagnostics);
  if (!read.scene) return std::nullopt;
  if (!known.up && suffix_of(path) == ".stl") known.up = 'z';
  return Builder(*read.scene, path, read.extras, known, diagnostics).build();
}

}  // namespace oriel::models
