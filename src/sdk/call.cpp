// SPDX-License-Identifier: Apache-2.0
#include "sdk/call.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "sampling/sampler.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "sdk/shader_state.h"
#include "sdk/shader_turn.h"
#include "sdk/tags.h"
#include "sdk/triangle.h"

namespace oriel::sdk {
namespace {

/// Results of connected shaders: a stack of blocks with stable addresses.
class Arena {
 public:
  struct Mark {
    std::size_t block, used;
  };
  Mark mark() const { return {block_, used_}; }
  void release(const Mark& mark) { block_ = mark.block, used_ = mark.used; }
  void* allocate(std::size_t bytes) {
    bytes = (bytes + 15) / 16 * 16;
    if (blocks_.empty() || used_ + bytes > kBlock) {
      if (!blocks_.empty()) ++block_;
      if (block_ >= blocks_.size())
        blocks_.push_back(std::make_unique<std::byte[]>(std::max(bytes, kBlock)));
      used_ = 0;
    }
    void* at = blocks_[block_].get() + used_;
    used_ += bytes;
    return at;
  }

 private:
  static constexpr std::size_t kBlock = 64 << 10;
  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::size_t block_ = 0, used_ = 0;
};
thread_local Arena arena;

using ShaderFunction = miBoolean (*)(void*, miState*, void*, void*);

CallKind kind_of_call(miShader_type type) {
  if (type == miSHADER_OUTPUT) return CallKind::Picture;
  return type == miSHADER_GEOMETRY ? CallKind::Setup : CallKind::Sample;
}

bool call_guarded(UserInstance& shader, miState& state, void* result, void* argument) {
  const auto function = reinterpret_cast<ShaderFunction>(shader.spec->function);
  Running running{shader.spec, "", &shader.spec->library_name};
  running.kind = kind_of_call(context(&state).call_type);
  if (CrashGuard* const guard = CrashGuard::current()) {
    const Running outer = std::exchange(guard->running, running);
    const bool answer = function(result, &state, shader.parameters, argument) != miFALSE;
    guard->running = outer;
    return answer;
  }
  bool answer = false;
  if (!run_guarded(running, [&] {
        answer = function(result, &state, shader.parameters, argument) != miFALSE;
      })) {
    // No guard surrounds this call, so the thread had not entered before.
    shader.spec->host->shader_turn().restore(0);
    shader.spec->host->stop_crashed(running);
    return false;
  }
  if (!shader.called.exchange(true, std::memory_order_relaxed)) install_crash_handlers();
  return answer;
}

/// Number of NaN or infinite results in this thread, to report only the first shader that returned
/// one.
thread_local unsigned broken_results = 0;

bool is_number(ParamType type, const std::byte* value) {
  if (type != ParamType::Color && type != ParamType::Scalar && type != ParamType::Vector)
    return true;
  float numbers[4] = {};
  std::memcpy(numbers, value, c_size(type));
  return std::all_of(std::begin(numbers), std::end(numbers),
                     [](float x) { return std::isfinite(x); });
}

bool has_result(miShader_type type) {
  return type != miSHADER_OUTPUT && type != miSHADER_GEOMETRY && type != miSHADER_STATE;
}

std::size_t size_of_result(const UserSpec& spec) {
  std::size_t size = 0;
  for (const CMember& m : spec.result_members) size = std::max(size, m.c_offset + c_size(m.type));
  return size;
}

bool is_number(const UserSpec& spec, const std::byte* result) {
  return std::all_of(spec.result_members.begin(), spec.result_members.end(),
                     [&](const CMember& m) { return is_number(m.type, result + m.c_offset); });
}

/// The result before a call, if it is not a number: shaders that have no result, like bumps, get
/// and leave memory without a value.
std::vector<std::byte> unset_result(const UserSpec& spec, const void* result, miShader_type type) {
  const auto* bytes = static_cast<const std::byte*>(result);
  if (!bytes || !has_result(type) || is_number(spec, bytes)) return {};
  return {bytes, bytes + size_of_result(spec)};
}

/// Reports the first shader whose result contains NaN or infinity; such pixels are black.
void check_result(const UserSpec& spec, const void* result, const std::vector<std::byte>& unset,
                  miShader_type type, unsigned before) {
  const auto* bytes = static_cast<const std::byte*>(result);
  if (!bytes || !has_result(type) || broken_results != before || is_number(spec, bytes)) return;
  if (!unset.empty() && std::equal(unset.begin(), unset.end(), bytes)) return;
  ++broken_results;
  if (spec.broken.exchange(true)) return;
  spec.host->diagnostics().warning(
      "OR-SDK-007", {},
      fmt::format("shader \"{}\" of {} returned an infinite result or NaN", spec.own_name,
                  spec.library_name),
      "such samples are black; check the shader for divisions by zero and roots of negative "
      "numbers");
}

}  // namespace

void* allocate_for_call(std::size_t bytes) { return arena.allocate(bytes); }

bool run(UserInstance& shader, miState& state, void* result, miShader_type type, void* argument) {
  Context& c = context(&state);
  set_current_host(c.host);  // required by the init functions
  leave_overdue_shader();
  if (!shader.ready.load(std::memory_order_acquire)) shader.make_ready(*shader.node);
  if (!shader.function || shader.spec->crashed.load(std::memory_order_relaxed)) return false;
  // Shaders read parent->shader without a null check.
  if (state.parent && !state.parent->shader) state.parent->shader = shader.function;
  const miFunction* const outer_function = std::exchange(state.shader, shader.function);
  const UserInstance* const outer = std::exchange(c.shader, &shader);
  const Evaluated* const evaluated = std::exchange(c.evaluated, nullptr);
  const miShader_type outer_type = std::exchange(c.call_type, type);
  const Arena::Mark mark = arena.mark();
  const ShaderStateScope scope(state);
  const unsigned broken = broken_results;
  const std::vector<std::byte> unset = unset_result(*shader.spec, result, type);
  const bool answer = call_guarded(shader, state, result, argument);
  if (answer) check_result(*shader.spec, result, unset, type, broken);
  arena.release(mark);
  c.call_type = outer_type;
  c.evaluated = evaluated;
  c.shader = outer;
  state.shader = outer_function;
  return answer;
}

void to_c(ParamType type, const void* own, void* c) {
  if (type == ParamType::Boolean) {
    const miBoolean value = *static_cast<const bool*>(own) ? miTRUE : miFALSE;
    std::memcpy(c, &value, sizeof value);
  } else {
    std::memcpy(c, own, c_size(type));
  }
}

void from_c(ParamType type, const void* c, void* own) {
  if (type == ParamType::Boolean) {
    miBoolean value;
    std::memcpy(&value, c, sizeof value);
    const bool is = value != miFALSE;
    std::memcpy(own, &is, sizeof is);
  } else {
    std::memcpy(own, c, c_size(type));
  }
}

void result_from_c(const UserSpec& spec, const std::byte* c, void* own) {
  for (const CMember& m : spec.result_members)
    from_c(m.type, c + m.c_offset, static_cast<std::byte*>(own) + m.offset);
}

Vec2 next(const miState* state) {
  Context& c = context(state);
  if (c.tracer()) return c.tracer()->next();
  if (c.lens) return c.lens->next();
  if (c.photon) return c.photon->next();
  if (c.emission) return c.emission->next();
  // Keyed by position: reproducible, and different at each point.
  std::uint32_t bits[3];
  std::memcpy(bits, &c.point->position.x, sizeof bits);
  std::uint64_t key = sampling::mix_bits((std::uint64_t{bits[0]} << 32) | bits[1]);
  key = sampling::mix_bits(key + bits[2] + 0x9e3779b97f4a7c15ull * ++c.draws);
  constexpr float kUnit = 0x1p-24f;
  return Vec2(static_cast<float>(key >> 40) * kUnit,
              static_cast<float>((key >> 8) & 0xffffffu) * kUnit);
}

ShadingPoint point_of(const miState* state) {
  const Context& c = context(state);
  ShadingPoint point = *c.point;
  point.position = vec(state->point);
  point.normal = vec(state->normal);
  point.geometric_normal = vec(state->normal_geom);
  point.ray_origin = vec(state->org);
  point.ray_direction = vec(state->dir);
  point.ray_length = static_cast<float>(state->dist);
  if (!state->pri) point.ray_offset = 0;
  // Built-in shaders do not know ray types that shaders define themselves.
  if (state->type >= miRAY_EYE && state->type < miRAY_NO_TYPES)
    point.ray_kind = static_cast<RayKind>(state->type);
  if (point.texture_spaces == 0) point.tex[0] = vec(state->tex);
  take_over_tex(*state, point);
  return point;
}

void take_over_tex(const miState& state, ShadingPoint& point) {
  const Vec3 tex = vec(state.tex);
  const Vec3 given = point.texture_spaces > 0 ? point.tex[0] : Vec3(0);
  if (tex != given) point.tex_vector = tex;
}

bool is_own_instance(const miState* state) {
  const ShadingPoint& point = *context(state).point;
  return point.instance >= 0 && point.to_object && point.to_world &&
         state->instance == make_tag(TagKind::Instance, static_cast<std::size_t>(point.instance));
}

void take_over(const ShadingPoint& point, const ShadingPoint& before, miState* state) {
  if (point.normal != before.normal) state->normal = as_c(point.normal);
  if (point.position != before.position) state->point = as_c(point.position);
  std::copy(std::begin(point.tex), std::end(point.tex), context(state).point->tex);
}

}  // namespace oriel::sdk
