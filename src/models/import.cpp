// SPDX-License-Identifier: Apache-2.0
#include "models/import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>

#include "base/file_text.h"
#include "models/axes.h"
#include "models/import_material.h"
#include "models/import_mesh.h"
#include "models/import_texture.h"
#include "models/shader_call.h"

namespace oriel::models {
namespace {

namespace fs = std::filesystem;

/// Nodes within nodes; deeper ones are left out.
constexpr int kMostDepth = 500;
/// Degrees between faces; a guess that keeps edges of buildings sharp.
constexpr float kSmoothBelow = 45;
/// Film width of cameras, which then have the angle of the model's: full frame, millimetres.
constexpr float kAperture = 36;

/// Row vectors here, column vectors there.
Mat4 matrix(const aiMatrix4x4& m) {
  return Mat4(m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4,
              m.c4, m.d4);
}

Vec3 vec(const aiVector3D& v) { return Vec3(v.x, v.y, v.z); }

scene::Statement statement(std::string keyword, std::vector<scene::Value> values,
                           bool quoted = false) {
  return {std::move(keyword), quoted, std::move(values), {}};
}

/// Puts one model into a scene.
class Builder {
 public:
  Builder(const aiScene& model, const std::string& path,
          const std::map<std::string, GltfExtras>& extras, const ImportOptions& options,
          Diagnostics& diagnostics)
      : model_(model),
        extras_(extras),
        options_(options),
        textures_(options_, fs::path(path).parent_path().string(), scene_, diagnostics),
        diagnostics_(diagnostics) {}

  scene::Scene build() {
    scene_.packages = {"base.mi", "physics.mi", "architectural.mi"};
    add_options();
    for (unsigned i = 0; i < model_.mNumMaterials; ++i)
      materials_.push_back(add_material(model_, i, extras_, textures_, scene_, diagnostics_));
    if (std::any_of(materials_.begin(), materials_.end(),
                    [](const ImportedMaterial& made) { return made.needs_own_package; }))
      scene_.packages.emplace_back("oriel.mi");
    for (unsigned i = 0; i < model_.mNumMeshes; ++i) add_mesh(i);
    if (model_.mRootNode) add_node(*model_.mRootNode, upright(model_, options_.up), 0);
    for (unsigned i = 0; i < model_.mNumLights; ++i) add_light(*model_.mLights[i]);
    for (unsigned i = 0; i < model_.mNumCameras; ++i) add_camera(*model_.mCameras[i]);
    scene_.add(std::move(root_));
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
    if (depth > kMostDepth) {
      diagnostics_.warning("OR-MD-002", {},
                           fmt::format("nodes nested deeper than {} are left out", kMostDepth));
      return;
    }
    const Mat4 to_world = matrix(node.mTransformation) * parent;
    nodes_.try_emplace(node.mName.C_Str(), to_world);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const unsigned mesh = node.mMeshes[i];
      if (mesh >= objects_.size() || objects_[mesh].empty()) continue;
      const unsigned material = model_.mMeshes[mesh]->mMaterialIndex;
      place(node.mName.length > 0 ? node.mName.C_Str() : objects_[mesh], objects_[mesh], to_world,
            material < materials_.size() ? materials_[material].name : "");
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
      add_node(*node.mChildren[i], to_world, depth + 1);
  }

  /// Adds an instance to the root group; returns its name.
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
          fmt::format("\"{}\" stands in a flat or endless space; its place is lost",
                      instance.name));
    }
    if (!material.empty()) instance.materials = {material};
    root_.members.push_back(instance.name);
    std::string name = instance.name;
    scene_.add(std::move(instance));
    return name;
  }

  Mat4 space_of(const aiString& node) const {
    const auto found = nodes_.find(node.C_Str());
    return found == nodes_.end() ? Mat4() : found->second;
  }

  /// Pixels become cd/m2 where the model's lights are in candela and lux, as glTF has them.
  void add_light(const aiLight& source) {
    scene::Light light;
    light.name = unique_name(scene_, source.mName.length > 0 ? source.mName.C_Str() : "light");
    const Vec3 color(source.mColorDiffuse.r, source.mColorDiffuse.g, source.mColorDiffuse.b);
    if (source.mType == aiLightSource_DIRECTIONAL) {
      ShaderCall call("mib_light_infinite");
      call.set("color", color / kPi).set("shadow", true);
      light.shaders = {call.use()};
      light.direction = vec(source.mDirection);
    } else if (source.mType == aiLightSource_POINT || source.mType == aiLightSource_SPOT) {
      // It spreads its colour over 4 pi; a surface facing it shows it over pi.
      ShaderCall call("physical_light");
      call.set("color", color * 4.0f);
      light.origin = vec(source.mPosition);
      if (source.mType == aiLightSource_SPOT) {
        light.direction = vec(source.mDirection);
        light.spread = std::cos(std::min(source.mAngleOuterCone, kPi));
        call.set("cone", std::cos(std::min(source.mAngleInnerCone, kPi)));
      }
      light.shaders = {call.use()};
    } else {
      diagnostics_.note("OR-MD-006", {},
                        fmt::format("light \"{}\" is of a kind that is left out", light.name));
      return;
    }
    const std::string name = light.name;
    scene_.add(std::move(light));
    place(name, name, space_of(source.mName));
  }

  void add_camera(const aiCamera& source) {
    scene::Camera camera;
    camera.name = unique_name(scene_, source.mName.length > 0 ? source.mName.C_Str() : "camera");
    const float half = source.mHorizontalFOV / 2;
    camera.aperture = kAperture;
    camera.focal = half > 0 && half < kPi / 2 ? kAperture / 2 / std::tan(half) : kAperture;
    camera.aspect = source.mAspect > 0 ? source.mAspect : 1.5f;
    const int width = 960;
    camera.resolution = {
        {width, std::max(1, static_cast<int>(std::lround(width / *camera.aspect)))}};
    // It looks down -z here, and where it says there.
    const Vec3 z = normalize(-vec(source.mLookAt));
    const Vec3 x = normalize(cross(vec(source.mUp), z)), y = cross(z, x);
    // Of glTF, assimp 5 gives a camera its node's translation once more.
    const aiNode* node = model_.mRootNode ? model_.mRootNode->FindNode(source.mName) : nullptr;
    const bool twice = node && Vec3(node->mTransformation.a4, node->mTransformation.b4,
                                    node->mTransformation.c4) == vec(source.mPosition);
    const Vec3 p = twice ? Vec3(0) : vec(source.mPosition);
    const Mat4 own(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, p.x, p.y, p.z, 1);
    const std::string name = camera.name;
    scene_.add(std::move(camera));
    const std::string placed = place(name, name, own * space_of(source.mName));
    if (first_camera_.empty()) first_camera_ = placed;
  }

  const aiScene& model_;
  const std::map<std::string, GltfExtras>& extras_;
  const ImportOptions options_;
  scene::Scene scene_;
  TextureMaker textures_;
  Diagnostics& diagnostics_;
  scene::InstanceGroup root_{kRootGroup, {}, {}, {}};
  std::vector<ImportedMaterial> materials_;
  std::vector<std::string> objects_;
  std::map<std::string, Mat4> nodes_;
  std::string first_camera_;
};

}  // namespace

std::optional<scene::Scene> import_model(const std::string& path, const ImportOptions& options,
                                         Diagnostics& diagnostics) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  // Else it leaves the inverse of PostRotation out and moves children by geometric transforms.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  // Formats that write no normals mean smooth surfaces, as far as they bend gently; glTF means flat
  // ones (specification, 3.7.2.1).
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, kSmoothBelow);
  const std::string suffix = fs::path(path).extension().string();
  const bool gltf = suffix == ".gltf" || suffix == ".glb";
  // assimp moves glTF's texture coordinates about another place than the file says: see
  // gltf_extras.h.
  const unsigned but_for_gltf =
      gltf ? 0 : unsigned{aiProcess_GenSmoothNormals} | unsigned{aiProcess_TransformUVCoords};
  const aiScene* model = importer.ReadFile(
      path, but_for_gltf | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType |
                aiProcess_GenUVCoords | aiProcess_ValidateDataStructure | aiProcess_GlobalScale);
  if (!model) {
    diagnostics.error(
        "OR-MD-001", {},
        fmt::format("'{}' is no model that can be read: {}", path, importer.GetErrorString()));
    return std::nullopt;
  }
  std::map<std::string, GltfExtras> extras;
  if (gltf) extras = gltf_extras(file_text(path));
  ImportOptions known = options;
  if (!known.up && (suffix == ".stl" || suffix == ".STL")) known.up = 'z';
  return Builder(*model, path, extras, known, diagnostics).build();
}

}  // namespace oriel::models
