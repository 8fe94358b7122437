// SPDX-License-Identifier: Apache-2.0
// User shaders of a scene: libraries, specs, and tags.
#pragma once

#include <atomic>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <shared_mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "oriel/sdk/shader.h"
#include "runtime/world.h"
#include "scene/scene.h"
#include "sdk/crash.h"
#include "sdk/library.h"
#include "sdk/shader_elements.h"
#include "sdk/tags.h"
#include "sdk/user_spec.h"

namespace oriel::sdk {

class HangWatch;
class ShaderTurn;
struct Picture;

/// Loads the libraries of `link` statements, makes specs of declared shaders that they contain, and
/// provides tags for the rest of the scene.
///
/// Model:   outlives every World that was prepared with its registry. A built-in shader has
///          priority over a user shader of the same name.
/// Errors:  OR-SDK-nnn; shaders of unusable libraries remain unknown.
/// Checked: tests/sdk.
class Host {
  std::atomic<bool> own_stop_ = false;

 public:
  /// Inputs:  stop: set when a shader ends the rendering (`stopped`); null = an internal flag.
  Host(const scene::Scene& scene, const Registry& builtin, const TrustedFolders& folders,
       Diagnostics& diagnostics, std::atomic<bool>* stop = nullptr);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// The built-in shaders and the user shaders.
  const Registry& registry() const { return *registry_; }
  const scene::Scene& scene() const { return scene_; }
  /// The current world; set when its first user shader is bound.
  const World* world() const { return world_; }
  void attach(const World& world);
  /// Forgets the world before its nodes are destroyed, if it is the current one.
  void leave(const World& world);
  /// Points to this host during its lifetime, then to null.
  const std::shared_ptr<Host*>& self() const { return self_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  const std::vector<std::unique_ptr<Library>>& libraries() const { return libraries_; }
  /// Libraries of the scene that were not found or could not be loaded, by file name.
  const std::vector<std::string>& absent_libraries() const { return absent_; }
  /// Calls the exit functions of initialised shaders and forgets the world; has to be called before
  /// the world is destroyed.
  void end_frame();
  /// Takes over an initialised call whose world ends before the frame; its exit function runs at
  /// the end of the frame.
  void exit_later(UserInstance& instance);

  // Tags; 0 for null.
  miTag tag_of(const ShaderNode* node);
  miTag tag_of(const TextureNode* texture);
  miTag tag_of_text(std::string_view text);
  miTag tag_of(const photometry::LightProfile* profile);
  miTag tag_of(const scene::UserData* data);
  miTag tag_of(const Material* material) const;
  miTag tag_of(const UserSpec& declaration) const;
  /// Objects behind tags; null if the tag has another kind.
  const ShaderNode* node(miTag tag) const;
  const TextureNode* texture(miTag tag) const;
  /// Tag of the shader behind a texture; the tag itself if there is none.
  miTag behind_texture(miTag tag);
  const Material* material(miTag tag) const;
  const photometry::LightProfile* profile(miTag tag) const;
  const scene::UserData* user_data(miTag tag) const;
  const UserSpec* declaration(miTag tag) const;
  /// Layout of declared user data; null if it is not declared.
  const UserSpec* data_layout(const std::string& name) const;
  /// Index into World::lights of a light or light instance; -1 if not found.
  int light(miTag tag) const;
  const InstanceData* instance(miTag tag) const;

  /// Tag of the element or declaration with that name; 0 if there is none. While a geometry shader
  /// runs, names given by it are included.
  miTag tag_of_name(const std::string& name);
  /// Name of an element; empty if it has none.
  std::string name_of(miTag tag) const;
  /// Finds the declaration of a library shader by name; null if there is none.
  const UserSpec* declaration_named(const std::string& name) const;
  /// Adds a shader declared by a geometry shader, if a library contains it.
  void declare(const scene::ShaderDeclaration& declaration);

  /// The C structure behind a tag (mi_db_access), created on demand; null if unknown.
  void* access(miTag tag);
  miScene_types type_of(miTag tag) const;
  std::size_t size_of_record(miTag tag);  ///< bytes
  /// The structure of an element of that type; null if the tag is of another. Shaders create
  /// elements of any type and size (mi_db_create), which may be too small for it. `least`: bytes of
  /// its fixed part.
  template <class T>
  T* record_of(miTag tag, miScene_types type, std::size_t least = sizeof(T)) {
    if (type_of(tag) != type || size_of_record(tag) < least) return nullptr;
    return static_cast<T*>(access(tag));
  }
  /// Recreates the C structure at the next access; the current one stays readable.
  void renew(miTag tag);

  // All zero without a current world.
  const miCamera* camera();
  const miOptions* options();
  const std::vector<miTag>& lights();  ///< instances of all lights
  std::string_view text(miTag tag) const;

  /// Of init and exit functions.
  ShaderTurn& shader_turn() { return *shader_turn_; }
  miLock global_lock() const { return global_lock_; }

  /// Label in the state of a hit: that of the instance, else that of its object.
  miUint hit_label(std::size_t instance);
  /// Elements created by shaders in this frame.
  ShaderElements& elements() { return elements_; }

  /// Whether this is the first call with these words; fast otherwise.
  bool is_first(std::string_view words);

  void say(Severity severity, std::string text);
  /// Reports a crash during or after a frame, and stops the rendering.
  void stop_crashed(const Running& running);
  /// Issues a warning once per text (`is_first`).
  void warn_once(const char* code, const std::string& text);
  /// Set by mi_abort, mi_fatal and crashes: rendering stops, and the partial picture is the result.
  std::atomic<bool>& stopped;

 private:
  void forget();
  void link(const std::string& written, SourceLocation where, const TrustedFolders& folders);
  /// Calls a library function. Returns false if it crashed, which is reported.
  bool call_module(const Library& library, const char* function);
  void report_missing(SourceLocation where, const TrustedFolders& folders);
  /// Null if its result is too large.
  const UserSpec* declare(const scene::ShaderDeclaration& declaration, const Library& library,
                          void* function);
  template <class T>
  miTag remember(TagKind kind, const T* thing, std::vector<const T*>& list);
  template <class T>
  const T* recall(TagKind kind, miTag tag, const std::vector<const T*>& list) const;

  /// A C structure with the data it points to.
  struct Record {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;
  };
  Record make(miTag tag);
  /// Pixels of a texture, created on demand; null if it has no picture.
  miImg_image* image_of(miTag tag);

  const scene::Scene& scene_;
  Diagnostics& diagnostics_;
  std::set<std::string> linked_;      ///< stems of the libraries that were searched
  std::vector<std::string> missing_;  ///< libraries that were not found, by file name
  std::vector<std::string> absent_;   ///< these, and libraries that could not be loaded
  std::vector<std::unique_ptr<Library>> libraries_;
  std::vector<std::unique_ptr<UserSpec>> specs_;
  std::unique_ptr<Registry> registry_;
  const World* world_ = nullptr;
  std::shared_ptr<Host*> self_ = std::make_shared<Host*>(this);

  mutable std::shared_mutex mutex_;
  std::vector<const ShaderNode*> nodes_;
  std::vector<const TextureNode*> textures_;
  std::vector<const photometry::LightProfile*> profiles_;
  std::vector<const scene::UserData*> user_data_;
  std::deque<std::string> texts_;
  std::unordered_map<const void*, miTag> known_;
  std::unordered_map<std::string, miTag> known_texts_;
  std::unordered_map<miTag, Record> records_;
  std::unordered_map<miTag, std::unique_ptr<Picture>> pictures_;  ///< of textures
  std::vector<Record> replaced_;                  ///< replaced records that shaders may still read
  std::unordered_map<std::string, miTag> named_;  ///< elements of the world; created on demand
  std::vector<miTag> lights_;
  std::vector<miUint> labels_;  ///< per instance, valid if labels_ready_
  std::atomic<bool> labels_ready_ = false;
  std::atomic<const miCamera*> camera_ = nullptr;
  std::atomic<const miOptions*> options_ = nullptr;
  const std::unique_ptr<ShaderTurn> shader_turn_;
  std::unique_ptr<HangWatch> hang_watch_;  ///< from the first library on
  miLock global_lock_;
  ShaderElements elements_;
  std::vector<std::unique_ptr<UserInstance>> late_exits_;
  std::set<std::string, std::less<>> said_;
};

}  // namespace oriel::sdk
