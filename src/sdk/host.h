// SPDX-License-Identifier: Apache-2.0
// The users' shaders of one scene: their libraries, their calls, and tags for what they reach.
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

struct Picture;

/// Finds what `link` statements name, makes specs of the shaders that the scene declares and the
/// libraries have, and lends the rest of the scene to them by tags.
///
/// Model:   lives longer than the World that was prepared with its registry. A built-in shader wins
///          over a user's of the same name.
/// Errors:  OR-SDK-nnn; libraries that cannot be used leave their shaders unknown.
/// Checked: tests/sdk.
class Host {
  std::atomic<bool> own_stop_ = false;

 public:
  /// Inputs:  stop: set when a shader ends the rendering (`stopped`); null = a flag of its own.
  Host(const scene::Scene& scene, const Registry& builtin, const TrustedFolders& folders,
       Diagnostics& diagnostics, std::atomic<bool>* stop = nullptr);
  ~Host();
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  /// The built-in shaders and the users'.
  const Registry& registry() const { return *registry_; }
  const scene::Scene& scene() const { return scene_; }
  /// The world under way: known from when its first user's shader is bound.
  const World* world() const { return world_; }
  void attach(const World& world);
  /// Forgets the world, if it is the one under way: its nodes go.
  void leave(const World& world);
  /// Points to this host as long as it lives, then to null.
  const std::shared_ptr<Host*>& self() const { return self_; }
  Diagnostics& diagnostics() { return diagnostics_; }
  const std::vector<std::unique_ptr<Library>>& libraries() const { return libraries_; }
  /// Libraries of the scene that were not found or could not be loaded, by file name.
  const std::vector<std::string>& absent_libraries() const { return absent_; }
  /// Calls the exit functions of the shaders that were initialised, and forgets the world; to be
  /// called before it goes.
  void end_frame();
  /// Takes a call that was initialised over from its world, which ends before the frame: its exit
  /// function runs at the end of the frame.
  void exit_later(UserInstance& instance);

  // Tags; 0 for null.
  miTag tag_of(const ShaderNode* node);
  miTag tag_of(const TextureNode* texture);
  miTag tag_of_text(std::string_view text);
  miTag tag_of(const photometry::LightProfile* profile);
  miTag tag_of(const scene::UserData* data);
  miTag tag_of(const Material* material) const;
  miTag tag_of(const UserSpec& declaration) const;
  /// What they stand for; null where the tag is of another kind.
  const ShaderNode* node(miTag tag) const;
  const TextureNode* texture(miTag tag) const;
  /// The tag of the shader that stands for a texture; that of the texture itself where it is none.
  miTag behind_texture(miTag tag);
  const Material* material(miTag tag) const;
  const photometry::LightProfile* profile(miTag tag) const;
  const scene::UserData* user_data(miTag tag) const;
  const UserSpec* declaration(miTag tag) const;
  /// Layout of declared user data; null when nothing declares it.
  const UserSpec* data_layout(const std::string& name) const;
  /// Index into World::lights of a light's instance or of the light; -1.
  int light(miTag tag) const;
  const InstanceData* instance(miTag tag) const;

  /// Tag of the element or declaration of that name; 0: there is none. While a geometry shader runs
  /// by the names that it gave.
  miTag tag_of_name(const std::string& name);
  /// Name of an element; empty: it has none.
  std::string name_of(miTag tag) const;
  /// A declaration by its name, of a shader in one of the libraries; null: there is none.
  const UserSpec* declaration_named(const std::string& name) const;
  /// Declares a shader that a geometry shader describes, if a library has it.
  void declare(const scene::ShaderDeclaration& declaration);

  /// The C structure behind a tag (mi_db_access), made when first asked for; null when unknown.
  void* access(miTag tag);
  miScene_types type_of(miTag tag) const;
  std::size_t size_of_record(miTag tag);  ///< bytes
  /// Makes the C structure anew when it is next asked for; the present one stays readable.
  void renew(miTag tag);

  // Zeros while no world is under way.
  const miCamera* camera();
  const miOptions* options();
  const std::vector<miTag>& lights();  ///< instances of all lights
  std::string_view text(miTag tag) const;

  /// Init and exit functions run under it; they may make other shaders ready.
  std::recursive_mutex& shader_lock() { return shader_lock_; }
  miLock global_lock() const { return global_lock_; }

  /// What the state of a hit has as label: that of the instance, or else that of its object.
  miUint hit_label(std::size_t instance);
  /// What shaders made for themselves in this frame.
  ShaderElements& elements() { return elements_; }

  /// Whether this host is asked for the first time with these words; quick where it is not.
  bool is_first(std::string_view words);

  void say(Severity severity, std::string text);
  /// Reports a crash while a frame is rendered, or after it, and stops the rendering.
  void stop_crashed(const Running& running);
  /// A warning that is given the first time that this host is asked for its text (`is_first`).
  void warn_once(const char* code, const std::string& text);
  /// Set by mi_abort, mi_fatal and crashes: the picture so far is all there will be.
  std::atomic<bool>& stopped;

 private:
  void forget();
  void link(const std::string& written, SourceLocation where, const TrustedFolders& folders);
  /// Calls a function of the whole library. False: it crashed, which is reported.
  bool call_module(const Library& library, const char* function);
  void report_missing(SourceLocation where, const TrustedFolders& folders);
  /// Null: its result is too large.
  const UserSpec* declare(const scene::ShaderDeclaration& declaration, const Library& library,
                          void* function);
  template <class T>
  miTag remember(TagKind kind, const T* thing, std::vector<const T*>& list);
  template <class T>
  const T* recall(TagKind kind, miTag tag, const std::vector<const T*>& list) const;

  /// A structure of C, and what it points to.
  struct Record {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size = 0;
  };
  Record make(miTag tag);
  /// The pixels of a texture's picture, made when first asked for; null: it has none.
  miImg_image* image_of(miTag tag);

  const scene::Scene& scene_;
  Diagnostics& diagnostics_;
  std::set<std::string> linked_;      ///< libraries that were looked for, by stem
  std::vector<std::string> missing_;  ///< those that were not found, by file name
  std::vector<std::string> absent_;   ///< these, and those that could not be loaded
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
  std::vector<Record> replaced_;                  ///< records that shaders may still read
  std::unordered_map<std::string, miTag> named_;  ///< elements of the world; empty: not made yet
  std::vector<miTag> lights_;
  std::vector<miUint> labels_;  ///< one for each instance, once labels_ready_
  std::atomic<bool> labels_ready_ = false;
  std::atomic<const miCamera*> camera_ = nullptr;
  std::atomic<const miOptions*> options_ = nullptr;
  std::recursive_mutex shader_lock_;
  miLock global_lock_;
  ShaderElements elements_;
  std::vector<std::unique_ptr<UserInstance>> late_exits_;
  std::set<std::string, std::less<>> said_;
};

}  // namespace oriel::sdk
