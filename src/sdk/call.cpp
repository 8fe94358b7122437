// SPDX-License-Identifier: Apache-2.0
#include "sdk/call.h"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <utility>
#include <vector>

#include "sampling/sampler.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "sdk/shader_state.h"
#include "sdk/tags.h"
#include "sdk/triangle.h"

namespace oriel::sdk {
namespace {

/// Where a crash in a user's shader jumps to, and whose it is.
struct Guard {
  sigjmp_buf back;
  const UserSpec* running = nullptr;
};
thread_local Guard* guard = nullptr;

std::mutex crash_mutex;
std::string crashed;  // under crash_mutex

/// Results of connected shaders: a stack of blocks that do not move.
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

miState& nobody() {
  thread_local miState state = {};
  return state;
}

using ShaderFunction = miBoolean (*)(void*, miState*, void*, void*);

bool call_guarded(UserInstance& shader, miState& state, void* result, void* argument) {
  const auto function = reinterpret_cast<ShaderFunction>(shader.spec->function);
  if (guard) {
    const UserSpec* outer = std::exchange(guard->running, shader.spec);
    const bool answer = function(result, &state, shader.parameters, argument) != miFALSE;
    guard->running = outer;
    return answer;
  }
  Guard own;
  own.running = shader.spec;
  miState* const parent = StateFrame::current_parent();
  if (sigsetjmp(own.back, 0) != 0) {
    guard = nullptr;
    StateFrame::current_parent() = parent;
    return false;
  }
  guard = &own;
  const bool answer = function(result, &state, shader.parameters, argument) != miFALSE;
  guard = nullptr;
  return answer;
}

}  // namespace

void* allocate_for_call(std::size_t bytes) { return arena.allocate(bytes); }

miState*& StateFrame::current_parent() {
  thread_local miState* state = nullptr;
  return state;
}

StateFrame::StateFrame(Host& host, ShadingPoint& point, miState* parent) : state{} {
  context.host = &host;
  context.world = host.world();
  context.point = &point;
  state.version = 2;
  state.camera_inst = make_tag(TagKind::CameraInstance, 0);
  state.camera = host.camera();
  state.options = host.options();
  state.global_lock = host.global_lock();
  state.raster_x = point.raster.x;
  state.raster_y = point.raster.y;
  state.type = static_cast<miRay_type>(point.ray_kind);
  if (state.type != miRAY_EYE) state.parent = parent ? parent : &nobody();
  if (parent) {
    state.user = parent->user;
    state.user_size = parent->user_size;
  }
  state.inv_normal = point.back_side;
  state.face = 'a';
  state.cache = &context;
  if (point.tracer) {
    const Tracer::Levels levels = point.tracer->levels();
    state.reflection_level = levels.reflections;
    state.refraction_level = levels.refractions;
    state.importance = levels.importance;
  } else {
    state.importance = 1;
  }
  if (context.world) state.time = context.world->shutter.scene_time(point.time);
  state.motion = as_c(motion_of(point));
  state.org = as_c(point.ray_origin);
  state.dir = as_c(point.ray_direction);
  state.dist = point.environment ? 0 : point.ray_length;
  state.ior = state.ior_in = 1;
  state.material = point.environment ? 0 : host.tag_of(point.material);
  state.volume = state.camera->volume;
  state.environment = state.camera->environment;
  if (point.instance >= 0) {
    state.instance = make_tag(TagKind::Instance, static_cast<std::size_t>(point.instance));
    state.label = host.hit_label(static_cast<std::size_t>(point.instance));
  }
  if (point.light >= 0)
    state.light_instance = make_tag(TagKind::LightInstance, static_cast<std::size_t>(point.light));
  if (const std::optional<HitTriangle> hit = hit_triangle(point)) {
    const Vec3 weights = hit->weights(point.position);
    for (int i = 0; i < 3; ++i) state.bary[i] = weights[i];
  }
  if (!point.environment) state.pri = reinterpret_cast<miRc_intersection*>(&point);
  state.point = as_c(point.position);
  state.normal = as_c(point.normal);
  state.normal_geom = as_c(point.geometric_normal);
  state.dot_nd = dot(point.normal, point.ray_direction);
  state.shadow_tol = point.ray_offset;
  // The same numbers: shaders may move the coordinates for those that run after them.
  static_assert(sizeof(Vec3) == sizeof(miVector));
  state.tex_list = reinterpret_cast<miVector*>(point.tex);
  for (int i = 0; i < point.texture_spaces; ++i) {
    const auto in_object = [&](const Vec3& v) {
      return as_c(point.to_object ? transform_vector(v, *point.to_object) : v);
    };
    bump_x_[i] = in_object(point.bump_u[i]);
    bump_y_[i] = in_object(point.bump_v[i]);
  }
  state.bump_x_list = bump_x_;
  state.bump_y_list = bump_y_;
  derivs_[0] = as_c(point.dpdu);
  derivs_[1] = as_c(point.dpdv);
  derivs_[2] = derivs_[3] = derivs_[4] = miVector{0, 0, 0};
  state.derivs = derivs_;
  if (point.texture_spaces > 0) state.tex = as_c(point.tex[0]);
}

bool run(UserInstance& shader, miState& state, void* result, miShader_type type, void* argument) {
  if (!shader.ready.load(std::memory_order_acquire)) shader.make_ready(*shader.node);
  Context& c = context(&state);
  set_current_host(c.host);
  const miFunction* const outer_function = std::exchange(state.shader, shader.function);
  const UserInstance* const outer = std::exchange(c.shader, &shader);
  const Evaluated* const evaluated = std::exchange(c.evaluated, nullptr);
  const miShader_type outer_type = std::exchange(c.call_type, type);
  const Arena::Mark mark = arena.mark();
  const ShaderStateScope scope(state);
  const bool answer = call_guarded(shader, state, result, argument);
  arena.release(mark);
  c.call_type = outer_type;
  c.evaluated = evaluated;
  c.shader = outer;
  state.shader = outer_function;
  return answer;
}

void leave_crashed_shader() {
  if (!guard) return;
  Guard& own = *guard;
  {
    const std::lock_guard lock(crash_mutex);
    if (crashed.empty() && own.running) crashed = own.running->own_name;
  }
  if (own.running) own.running->host->stopped = true;
  siglongjmp(own.back, 1);
}

const std::string& crashed_shader() { return crashed; }

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
  // Keyed by the place: the same in every rendering, another at each point.
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
  // Kinds that shaders make up for each other mean nothing to the renderer's own.
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
