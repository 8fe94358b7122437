// SPDX-License-Identifier: Apache-2.0
// Libraries, specs, tags. The C structures behind tags are in records.cpp.
#include "sdk/host.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/hang.h"
#include "sdk/picture.h"
#include "sdk/shader_turn.h"
#include "shaders/registry.h"

namespace oriel::sdk {
namespace {

/// Version of a shader reported by its library; 0 if there is none. `crashed` is set if the
/// function crashed.
int version_of(const Library& library, const UserSpec& spec, std::optional<Running>& crashed) {
  void* const function = library.find(spec.own_name + "_version");
  if (!function) return 0;
  int version = 0;
  Running running{&spec, "_version", &spec.library_name};
  if (!run_guarded(running, [&] { version = reinterpret_cast<int (*)()>(function)(); }) &&
      running.left != Left::Stopped)
    crashed = running;
  install_crash_handlers();
  return version;
}

}  // namespace

Host::Host(const scene::Scene& scene, const Registry& builtin, const TrustedFolders& folders,
           Diagnostics& diagnostics, std::atomic<bool>* stop)
    : stopped(stop ? *stop : own_stop_),
      scene_(scene),
      diagnostics_(diagnostics),
      shader_turn_(std::make_unique<ShaderTurn>()) {
  mi_init_lock(&global_lock_);
  set_current_host(this);  // for library functions that run before the first shader
  SourceLocation first_missing;
  for (const scene::Statement& command : scene.commands) {
    if (command.keyword != "link") continue;
    for (const scene::Value& value : command.values) link(value.text, command.where, folders);
    if (!missing_.empty() && !first_missing.line) first_missing = command.where;
  }
  report_missing(first_missing, folders);
  std::vector<const ShaderSpec*> all = builtin.all();
  for (const scene::ShaderDeclaration& declaration : scene.declarations) {
    if (builtin.find(declaration.name)) continue;
    for (const auto& library : libraries_)
      if (void* function = library->find(declaration.name)) {
        if (const UserSpec* spec = declare(declaration, *library, function)) all.push_back(spec);
        break;
      }
  }
  registry_ = std::make_unique<Registry>(std::move(all));
  for (const scene::DataDeclaration& data : scene.data_declarations) {
    scene::ShaderDeclaration layout;
    layout.name = data.name;
    layout.parameters = data.parameters;
    specs_.push_back(std::make_unique<UserSpec>(layout, *this, diagnostics_));
    specs_.back()->index = specs_.size() - 1;
    specs_.back()->is_data = true;
  }
}

void Host::link(const std::string& written, SourceLocation where, const TrustedFolders& folders) {
  const std::string stem = library_stem(written);
  const auto& own = builtin_packages();
  if (std::find(own.begin(), own.end(), stem) != own.end()) return;
  if (!linked_.insert(stem).second) return;
  const std::size_t messages = diagnostics_.all().size();
  if (!hang_watch_) hang_watch_ = std::make_unique<HangWatch>(stopped);
  auto library = Library::open(written, where, folders, diagnostics_);
  install_crash_handlers();
  if (!library && diagnostics_.all().size() == messages) missing_.push_back(stem + ".so");
  if (!library) absent_.push_back(stem + ".so");
  if (!library) return;
  if (!call_module(*library, "module_init")) return;
  libraries_.push_back(std::move(library));
}

bool Host::call_module(const Library& library, const char* function) {
  void* const found = library.find(function);
  if (!found) return true;
  Running running{nullptr, function, &library.file_name()};
  const bool done = run_guarded(running, [&] { reinterpret_cast<void (*)()>(found)(); });
  install_crash_handlers();
  if (!done && running.left != Left::Stopped)
    diagnostics_.error("OR-SDK-005", {}, describe(running),
                       "if module_init crashed, the shaders of the library are missing");
  return done;
}

void Host::stop_crashed(const Running& running) {
  stopped = true;
  if (running.left == Left::Stopped) return;
  // Other threads may have the same crash.
  if (running.spec && running.spec->crashed.exchange(true)) return;
  diagnostics_.error("OR-SDK-005", {}, describe(running),
                     "the partial picture is saved; to locate the crash, use a debugger: "
                     "gdb --args oriel render ...");
}

/// One message for all: exporters link every library they know.
void Host::report_missing(SourceLocation where, const TrustedFolders& folders) {
  if (missing_.empty()) return;
  diagnostics_.note(
      "OR-SDK-001", where,
      missing_.size() == 1 ? fmt::format("the shader library \"{}\" was not found", missing_[0])
                           : fmt::format("{} shader libraries were not found: {}", missing_.size(),
                                         fmt::join(missing_, ", ")),
      folders.empty()
          ? "native code is loaded only from folders named by --shader-path FOLDER or "
            "the environment variable ORIEL_SHADER_PATH"
          : "they must be in a folder of --shader-path or ORIEL_SHADER_PATH; `oriel shader-build` "
            "builds them from sources");
}

const UserSpec* Host::declare(const scene::ShaderDeclaration& declaration, const Library& library,
                              void* function) {
  auto spec = std::make_unique<UserSpec>(declaration, *this, diagnostics_);
  if (std::max(spec->c_result_size, spec->result_size) > kMaxParamBytes) {
    diagnostics_.error("OR-SDK-011", declaration.where,
                       fmt::format("the result of shader \"{}\" has {} bytes, more than {}",
                                   declaration.name, spec->c_result_size, kMaxParamBytes),
                       "the shader is treated as unknown; split its result");
    return nullptr;
  }
  spec->index = specs_.size();
  spec->library_name = library.file_name();
  spec->function = function;
  spec->init = library.find(declaration.name + "_init");
  spec->exit = library.find(declaration.name + "_exit");
  std::optional<Running> crashed;
  const int built = version_of(library, *spec, crashed);
  if (crashed) {
    diagnostics_.error("OR-SDK-005", declaration.where, describe(*crashed),
                       "the shader is treated as unknown");
    return nullptr;
  }
  if (spec->version > 0 && built > 0 && built != spec->version)
    diagnostics_.error("OR-SDK-004", declaration.where,
                       fmt::format("shader \"{}\" is declared with version {}, its library has "
                                   "version {}",
                                   declaration.name, spec->version, built),
                       "its parameters may have changed: use the declaration of the library");
  specs_.push_back(std::move(spec));
  return specs_.back().get();
}

void Host::attach(const World& world) {
  if (world_ == &world) return;
  forget();
  world_ = &world;
}

void Host::leave(const World& world) {
  if (world_ == &world) forget();
}

/// Deletes all data of the current world.
void Host::forget() {
  const std::unique_lock lock(mutex_);
  nodes_.clear(), textures_.clear(), profiles_.clear(), user_data_.clear(), texts_.clear(),
      known_.clear();
  known_texts_.clear(), records_.clear(), pictures_.clear(), replaced_.clear(), lights_.clear(),
      labels_.clear();
  named_.clear();
  labels_ready_ = false;
  elements_.clear();
  camera_ = nullptr, options_ = nullptr;
  world_ = nullptr;
}

void Host::exit_later(UserInstance& instance) {
  if (!instance.spec->exit) return;
  auto late = std::make_unique<UserInstance>();
  late->spec = instance.spec;
  late->block = std::move(instance.block);
  late->function = instance.function;
  late->parameters = instance.parameters;
  late->user = instance.user;
  late->thread_pointers.take(instance.thread_pointers);
  late->lock = std::exchange(instance.lock, {});
  late_exits_.push_back(std::move(late));
}

void Host::end_frame() {
  const ShaderTurnScope turn(*shader_turn_, stopped);
  if (!turn.entered()) return;
  set_current_host(this);
  ShadingPoint nowhere;
  nowhere.world = world_;
  const auto call_exit = [&](const UserSpec& spec, miState& state, void* parameters) {
    using Exit = miBoolean (*)(miState*, void*);
    if (spec.crashed) return;
    Running running{&spec, "_exit", &spec.library_name};
    if (!run_guarded(running, [&] { reinterpret_cast<Exit>(spec.exit)(&state, parameters); }))
      stop_crashed(running);
  };
  for (std::size_t i = 0; world_ && i < world_->nodes.size(); ++i) {
    UserInstance* instance = user_instance(*world_->nodes[i]);
    if (!instance || !instance->initialised) continue;
    instance->initialised = false;
    if (!instance->spec->exit) continue;
    StateFrame frame(*this, nowhere, nullptr);
    frame.state.shader = instance->function;
    frame.context.shader = instance;
    call_exit(*instance->spec, frame.state, instance->parameters);
  }
  for (const auto& late : late_exits_) {
    StateFrame frame(*this, nowhere, nullptr);
    frame.state.shader = late->function;
    frame.context.shader = late.get();
    call_exit(*late->spec, frame.state, late->parameters);
  }
  late_exits_.clear();
  for (const auto& spec : specs_) {
    if (!spec->initialised) continue;
    spec->initialised = false;
    if (!spec->exit) continue;
    StateFrame frame(*this, nowhere, nullptr);
    call_exit(*spec, frame.state, nullptr);
  }
  forget();
}

Host::~Host() {
  set_current_host(this);
  for (const auto& library : libraries_) {
    call_module(*library, "module_exit");
    if (const std::string crash = library->close(); !crash.empty())
      diagnostics_.error("OR-SDK-005", {}, crash);
  }
  *self_ = nullptr;
  forget_host(this);
  mi_delete_lock(&global_lock_);
}

template <class T>
miTag Host::remember(TagKind kind, const T* thing, std::vector<const T*>& list) {
  if (!thing) return miNULLTAG;
  {
    const std::shared_lock lock(mutex_);
    if (const auto found = known_.find(thing); found != known_.end()) return found->second;
  }
  const std::unique_lock lock(mutex_);
  miTag& tag = known_[thing];
  if (tag == miNULLTAG && list.size() < kMaxIndex) {
    tag = make_tag(kind, list.size());
    list.push_back(thing);
  }
  return tag;
}

miTag Host::tag_of(const ShaderNode* node) { return remember(TagKind::Function, node, nodes_); }
miTag Host::tag_of(const TextureNode* texture) {
  return remember(TagKind::Texture, texture, textures_);
}
miTag Host::tag_of(const photometry::LightProfile* profile) {
  return remember(TagKind::Profile, profile, profiles_);
}

miTag Host::tag_of(const scene::UserData* data) {
  return remember(TagKind::UserData, data, user_data_);
}

miTag Host::tag_of_text(std::string_view text) {
  if (text.empty()) return miNULLTAG;
  const std::unique_lock lock(mutex_);
  miTag& tag = known_texts_[std::string(text)];
  if (tag == miNULLTAG) {
    tag = make_tag(TagKind::Text, texts_.size());
    texts_.emplace_back(text);
  }
  return tag;
}

miTag Host::tag_of(const Material* material) const {
  if (!material || !world_ || world_->materials.empty()) return miNULLTAG;
  const std::ptrdiff_t index = material - world_->materials.data();
  if (index < 0 || index >= static_cast<std::ptrdiff_t>(world_->materials.size())) return miNULLTAG;
  return make_tag(TagKind::Material, static_cast<std::size_t>(index));
}

miTag Host::tag_of(const UserSpec& declaration) const {
  return make_tag(TagKind::Declaration, declaration.index);
}

template <class T>
const T* Host::recall(TagKind kind, miTag tag, const std::vector<const T*>& list) const {
  if (kind_of(tag) != kind) return nullptr;
  const std::shared_lock lock(mutex_);
  return index_of(tag) < list.size() ? list[index_of(tag)] : nullptr;
}

const ShaderNode* Host::node(miTag tag) const { return recall(TagKind::Function, tag, nodes_); }
const TextureNode* Host::texture(miTag tag) const {
  return recall(TagKind::Texture, tag, textures_);
}
const photometry::LightProfile* Host::profile(miTag tag) const {
  return recall(TagKind::Profile, tag, profiles_);
}

const scene::UserData* Host::user_data(miTag tag) const {
  return recall(TagKind::UserData, tag, user_data_);
}

void Host::declare(const scene::ShaderDeclaration& declaration) {
  for (const auto& library : libraries_)
    if (void* function = library->find(declaration.name)) {
      if (const UserSpec* spec = declare(declaration, *library, function)) registry_->add(spec);
      return;
    }
}

const UserSpec* Host::declaration_named(const std::string& name) const {
  const auto found = std::find_if(specs_.begin(), specs_.end(), [&](const auto& spec) {
    return !spec->is_data && spec->own_name == name;
  });
  return found == specs_.end() ? nullptr : found->get();
}

const UserSpec* Host::data_layout(const std::string& name) const {
  const auto found = std::find_if(specs_.rbegin(), specs_.rend(), [&](const auto& spec) {
    return spec->is_data && spec->own_name == name;
  });
  return found == specs_.rend() ? nullptr : found->get();
}

const Material* Host::material(miTag tag) const {
  if (kind_of(tag) != TagKind::Material || !world_) return nullptr;
  return index_of(tag) < world_->materials.size() ? &world_->materials[index_of(tag)] : nullptr;
}

const UserSpec* Host::declaration(miTag tag) const {
  if (kind_of(tag) != TagKind::Declaration || index_of(tag) >= specs_.size()) return nullptr;
  return specs_[index_of(tag)].get();
}

int Host::light(miTag tag) const {
  const TagKind kind = kind_of(tag);
  if (!world_ || (kind != TagKind::LightInstance && kind != TagKind::Light)) return -1;
  return index_of(tag) < world_->lights.size() ? static_cast<int>(index_of(tag)) : -1;
}

const InstanceData* Host::instance(miTag tag) const {
  const TagKind kind = kind_of(tag);
  if (!world_ || (kind != TagKind::Instance && kind != TagKind::Object)) return nullptr;
  return index_of(tag) < world_->instances.size() ? &world_->instances[index_of(tag)] : nullptr;
}

std::string_view Host::text(miTag tag) const {
  if (kind_of(tag) != TagKind::Text) return {};
  const std::shared_lock lock(mutex_);
  return index_of(tag) < texts_.size() ? std::string_view(texts_[index_of(tag)])
                                       : std::string_view();
}

bool Host::is_first(std::string_view words) {
  {
    const std::shared_lock lock(mutex_);
    if (said_.find(words) != said_.end()) return false;
  }
  const std::unique_lock lock(mutex_);
  return said_.emplace(words).second;
}

void Host::warn_once(const char* code, const std::string& text) {
  if (is_first(text)) diagnostics_.warning(code, {}, text);
}

void Host::say(Severity severity, std::string text) {
  diagnostics_.report(severity, "OR-SDK-020", {}, std::move(text));
}

}  // namespace oriel::sdk
