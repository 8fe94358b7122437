// SPDX-License-Identifier: Apache-2.0
// A scene read from its file, with edits, and the world prepared from it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "interactive/edited_scene.h"
#include "interactive/view_settings.h"
#include "mi/reader.h"
#include "prepare/prepare.h"
#include "render/unit_luminance.h"

namespace oriel::sdk {
class Host;
}

namespace oriel::interactive {

/// As sdk::TrustedFolders.
using ShaderFolders = std::vector<std::filesystem::path>;

/// Where a scene comes from.
struct SceneSource {
  std::string path;  ///< .mi
  int frame = 1;     ///< the render statement that counts, from 1
  mi::ReadOptions read;
  const Registry* registry = nullptr;  ///< built-in shaders; has to outlive the session
  ShaderFolders folders;               ///< of users' shader libraries
  /// Called after reading and before shaders are loaded; returns the folders of shader libraries
  /// from then on. May be empty.
  std::function<ShaderFolders(scene::Scene&)> after_reading;
  std::optional<float> unit_luminance = {};  ///< cd/m2 of one pixel unit; unset: from the scene
  std::optional<scene::IndirectMethod> indirect = {};
};

/// A scene and its world.
///
/// Model:   update() prepares as little as the effects allow: nothing of the world for the film,
///          the camera alone, what depends on an element, else everything but unchanged meshes.
///          Shaders that are bound again are added to the world, which is prepared as a whole
///          before it has more than twice as many (and kSpareNodes) as at first. After complete()
///          the world is equal to that of a scene that was read and edited afresh.
/// Checked: EditTable.* in tests/interactive
class PreparedScene {
 public:
  PreparedScene(SceneSource source, Diagnostics& diagnostics);
  ~PreparedScene();
  PreparedScene(const PreparedScene&) = delete;
  PreparedScene& operator=(const PreparedScene&) = delete;

  /// Reads the frame; also again, without edits. Returns false if there is none.
  bool read();
  bool is_read() const { return edited_.has_value(); }
  /// Brings the world up to date for reduced pictures. Returns false if it cannot be rendered.
  /// Inputs:  width, height: of the picture; 0 = from the camera.
  bool update(const EditEffects& effects, const ViewSettings& view, int width, int height);
  /// Brings it up to date for all pictures; see complete_light_sampler().
  void complete();
  /// Places the camera for a picture of that size; the geometry is that of the size in update().
  void resize_camera(const ViewSettings& view, int width, int height);

  scene::Scene& scene() { return *scene_; }
  const scene::Scene& scene() const { return *scene_; }
  EditedScene& edited() { return *edited_; }
  const EditedScene& edited() const { return *edited_; }
  const scene::RenderCommand& command() const { return scene_->renders.back(); }
  World* world() { return world_.get(); }
  const World* world() const { return world_.get(); }
  const Registry& registry() const;
  const SceneSource& source() const { return source_; }
  /// How often everything but meshes was prepared.
  std::size_t preparations() const { return preparations_; }
  const UnitLuminance& unit() const { return unit_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  /// Output shaders of the camera.
  const NodeList& output_shaders() const { return outputs_; }
  /// The light groups of a view, besides those of the scene.
  std::vector<scene::LightGroup> light_groups(const ViewSettings& view) const;
  /// A world of the present scene for one use, e.g. with other light layers; null on failure.
  std::unique_ptr<World> separate_world(const ViewSettings& view);

 private:
  PrepareOptions prepare_options(const ViewSettings& view, int width, int height) const;
  bool prepare_all(const ViewSettings& view, int width, int height);
  bool is_crowded() const;
  /// Prepares what depends on the elements. False: the world has to be prepared again.
  bool prepare_dependents(const std::set<std::string>& elements, const ViewSettings& view,
                          int width, int height);
  void find_unit();
  /// Places the scene's camera again. False: more depends on its change.
  bool place_camera_alone(const ViewSettings& view, int width, int height);
  void apply_look(const ViewSettings& view);
  void close_world();

  SceneSource source_;
  Diagnostics& diagnostics_;
  std::unique_ptr<scene::Scene> scene_;
  std::optional<EditedScene> edited_;
  std::unique_ptr<sdk::Host> host_;
  GeometryCache cache_;
  std::unique_ptr<World> world_;
  std::size_t reading_diagnostics_ = 0;  ///< number of messages of the reader
  std::size_t preparations_ = 0;
  /// bound shaders and textures after the last preparation of everything
  std::size_t nodes_at_first_ = 0, textures_at_first_ = 0;
  Camera searched_camera_;  ///< the scene's camera, without the view's look
  NodeList outputs_;
  UnitLuminance unit_;
};

}  // namespace oriel::interactive
