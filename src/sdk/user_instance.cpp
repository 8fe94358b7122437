// SPDX-License-Identifier: Apache-2.0
// C parameter block of a call, and initialisation and exit of its shader.
#include <algorithm>
#include <cstring>
#include <map>

#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "sdk/shader_turn.h"

namespace oriel::sdk {
namespace {

/// Tag of a value that refers to an element.
miTag tag_of_value(Host& host, ParamType type, const void* own) {
  const auto read = [&]<class T>(T ref) {
    std::memcpy(&ref, own, sizeof ref);
    return ref;
  };
  switch (type) {
    case ParamType::String:
      return host.tag_of_text(read(std::string_view()));
    case ParamType::Shader:
      return host.tag_of(read(ShaderRef()).node);
    case ParamType::ColorTexture:
    case ParamType::ScalarTexture:
    case ParamType::VectorTexture:
      return host.tag_of(read(ColorTextureRef()).texture);
    case ParamType::LightProfile:
      return host.tag_of(read(LightProfileRef()).profile);
    case ParamType::Material:
    case ParamType::Geometry:
    case ParamType::Data: {
      const std::string* const name = read(ElementRef()).name;
      return name ? host.tag_of_name(*name) : miNULLTAG;
    }
    case ParamType::Light: {
      const int index = read(LightRef()).index;
      return index < 0 ? miNULLTAG
                       : make_tag(TagKind::LightInstance, static_cast<std::size_t>(index));
    }
    default:
      return miNULLTAG;
  }
}

void store_value(Host& host, ParamType type, const void* own, std::byte* c) {
  switch (type) {
    case ParamType::Boolean:
    case ParamType::Integer:
    case ParamType::Scalar:
    case ParamType::Color:
    case ParamType::Vector:
    case ParamType::Transform:
      return to_c(type, own, c);
    case ParamType::Spectrum:
      std::memset(c, 0, sizeof(miSpectrum_para));
      return;
    default: {
      const miTag tag = tag_of_value(host, type, own);
      std::memcpy(c, &tag, sizeof tag);
    }
  }
}

/// End of an array with `count` elements in a block that ends at `end`.
std::size_t end_of_array(const CMember& m, int count, std::size_t end) {
  if (m.c_stride == 0) return end;
  return begin_of_array(m, end) + static_cast<std::size_t>(count) * m.c_stride;
}

ArrayView<std::byte> array_at(const std::byte* own) {
  ArrayView<std::byte> view;
  std::memcpy(&view, own, sizeof view);
  return view;
}

}  // namespace

void* ThreadPointers::get() const {
  const std::lock_guard lock(mutex_);
  const auto found = of_.find(thread_generation());
  return found == of_.end() ? nullptr : found->second;
}

void ThreadPointers::set(void* pointer) {
  const std::lock_guard lock(mutex_);
  of_[thread_generation()] = pointer;
}

std::vector<void*> ThreadPointers::all() const {
  std::vector<void*> list;
  const std::lock_guard lock(mutex_);
  for (const auto& [thread, pointer] : of_) list.push_back(pointer);
  return list;
}

void ThreadPointers::take(ThreadPointers& other) { of_ = std::move(other.of_); }

UserInstance::~UserInstance() {
  // Worlds are destroyed before their hosts; those of geometry shaders long before.
  if (host && *host && initialised) (*host)->exit_later(*this);
  if (host && *host && world) (*host)->leave(*world);
  if (lock.p) mi_delete_lock(&lock);
}

void UserInstance::make_ready(const ShaderNode& of) {
  const ShaderTurnScope turn(spec->host->shader_turn(), spec->host->stopped);
  if (!turn.entered()) return;
  // Init functions may query the parameters before they return.
  if (function || ready.load(std::memory_order_relaxed)) return;
  Host& owner = *spec->host;
  const auto* own = &of.constants<std::byte>();

  std::size_t size = spec->c_params_size;
  for (const CMember& m : spec->members)
    if (m.type == ParamType::Array) {
      const int count = array_at(own + m.offset).size;
      if (count > 0) size = end_of_array(m, count, size);
    }
  size = (size + 15) / 16 * 16;
  constexpr std::size_t kHead = (offsetof(miFunction, parameters) + 15) / 16 * 16;
  // Header, parameters, and as many bytes for tags of connections; the header ends where the
  // parameters begin.
  block = std::make_unique<std::byte[]>(kHead + 2 * size + 16);
  std::byte* start = block.get();
  start += (16 - reinterpret_cast<std::uintptr_t>(start) % 16) % 16;
  std::byte* values = start + kHead;
  parameters = values;
  function = reinterpret_cast<miFunction*>(values - offsetof(miFunction, parameters));
  function->type = miFUNCTION_C;
  function->function_decl = owner.tag_of(*spec);
  function->parameter_size = static_cast<int>(spec->c_params_size);
  function->result_size = static_cast<int>(spec->c_result_size);

  // C offset of each value of the renderer, for connections.
  std::map<std::size_t, std::pair<std::size_t, ParamType>> places;
  const auto put = [&](const CMember& m, std::size_t from, std::size_t to) {
    store_value(owner, m.type, own + from, values + to);
    places[from] = {to, m.type};
  };
  std::size_t end = spec->c_params_size;
  for (const CMember& m : spec->members) {
    if (m.type != ParamType::Array) {
      put(m, m.offset, m.c_offset);
      continue;
    }
    const ArrayView<std::byte> view = array_at(own + m.offset);
    int head[2] = {0, view.size};
    if (view.size > 0 && m.c_stride > 0) {
      const auto count = static_cast<std::size_t>(view.size);
      const std::size_t begin = begin_of_array(m, end);
      end = begin + count * m.c_stride;
      head[0] = static_cast<int>((begin - m.c_offset - 8) / m.c_stride);
      const auto elements = static_cast<std::size_t>(view.data - own);
      for (std::size_t i = 0; i < count; ++i)
        for (const CMember& e : m.members)
          put(e, elements + i * m.stride + e.offset, begin + i * m.c_stride + e.c_offset);
    }
    std::memcpy(values + m.c_offset, head, sizeof head);
  }
  for (const Connection& c : of.connections()) {
    const auto place = places.find(c.offset);
    if (place == places.end()) continue;
    const auto [offset, type] = place->second;
    connections.push_back({offset, type, &c});
    const miTag tag = owner.tag_of(c.source);
    std::memcpy(values + size + offset, &tag, sizeof tag);
  }
  function->ghost_offs = connections.empty() ? 0 : static_cast<int>(size);

  initialise(owner);
  ready.store(true, std::memory_order_release);
}

/// Calls NAME_init once without parameters, then once per call if the shader requests it.
void UserInstance::initialise(Host& owner) {
  mi_init_lock(&lock);
  auto* shader = const_cast<UserSpec*>(spec);
  if (shader->crashed) return;
  if (!shader->init) {
    shader->initialised = true;  // set before the call, so that the exit function runs in any case
    return;
  }
  set_current_host(&owner);
  using Init = miBoolean (*)(miState*, void*, miBoolean*);
  const auto init = reinterpret_cast<Init>(shader->init);
  ShadingPoint nowhere;
  nowhere.world = owner.world();
  StateFrame frame(owner, nowhere, nullptr);
  frame.state.type = miRAY_NONE;
  frame.state.shader = function;
  frame.context.shader = this;
  Running running{spec, "_init", &spec->library_name};
  const bool done = run_guarded(running, [&] {
    if (!shader->initialised) {
      shader->initialised = true;
      miBoolean each = miFALSE;
      init(&frame.state, nullptr, &each);
      shader->each_instance = each != miFALSE;
    }
    if (shader->each_instance) {
      miBoolean again = miFALSE;
      init(&frame.state, parameters, &again);
      initialised = true;
    }
  });
  install_crash_handlers();
  if (!done) owner.stop_crashed(running);
}

}  // namespace oriel::sdk
