// SPDX-License-Identifier: Apache-2.0
// Implements the roles of a ShaderSpec by calls of a user shader.
#include <algorithm>
#include <optional>
#include <utility>

#include "color/luminance.h"
#include "oriel/sdk/mia_material_api.h"
#include "runtime/closure.h"
#include "runtime/light.h"
#include "sdk/call.h"
#include "sdk/geometry_work.h"
#include "sdk/host.h"
#include "sdk/maya_items.h"
#include "sdk/output_work.h"
#include "sdk/shader_state.h"
#include "sdk/tags.h"

namespace oriel::sdk {
namespace {

UserInstance& instance_of(const Call& call) {
  return *static_cast<UserInstance*>(const_cast<ShaderState*>(call.state));
}

std::unique_ptr<ShaderState> prepare_call(const Call& call, const World& world) {
  auto instance = std::make_unique<UserInstance>();
  instance->spec = static_cast<const UserSpec*>(&call.node->spec());
  instance->node = call.node;
  instance->host = instance->spec->host->self();
  instance->world = &world;
  instance->spec->host->attach(world);
  return instance;
}

miShader_type texture_type(const ShadingPoint& point) {
  if (point.environment) return miSHADER_ENVIRONMENT;
  return point.ray_kind == RayKind::Displace ? miSHADER_DISPLACE : miSHADER_TEXTURE;
}

void value(const Call& call, void* result) {
  UserInstance& shader = instance_of(call);
  StateFrame frame(*shader.spec->host, call.point);
  Result c(*shader.spec);
  run(shader, frame.state, c.bytes, texture_type(call.point));
  result_from_c(*shader.spec, c.bytes, result);
  call.point.normal = vec(frame.state.normal);
  take_over_tex(frame.state, call.point);
  // Displacement starts at the undisplaced point.
  if (call.point.ray_kind == RayKind::Displace) call.point.position = vec(frame.state.point);
}

/// The result is the visible radiance. Photons and shadow rays use other shaders.
void material(const Call& call, Closure& closure) {
  if (!call.point.tracer) return;
  UserInstance& shader = instance_of(call);
  StateFrame frame(*shader.spec->host, call.point);
  Result c(*shader.spec);
  c.color() = as_c(closure.emission, closure.alpha);
  std::optional<Answer>* const store = Caller::current().answer;
  const bool answer = run(shader, frame.state, c.bytes, miSHADER_MATERIAL);
  if (store && !*store) {
    store->emplace(Answer{call.point.position, frame.state});
    (*store)->state.shader = shader.function;
  }
  closure.emission = answer ? rgb(c.color()) : Rgb(0);
  closure.alpha = answer ? clamp01(c.color().a) : 0;
  closure.outputs = false;
  take_over_tex(frame.state, call.point);
}

Rgb shadow(const Call& call, const Rgb& light) {
  UserInstance& shader = instance_of(call);
  ShadingPoint& point = call.point;
  StateFrame frame(*shader.spec->host, point);
  miState& state = frame.state;
  state.type = miRAY_SHADOW;
  // Shadow rays of the renderer start at the shading point, those of shaders at the light.
  state.dir = as_c(-point.ray_direction);
  if (point.light >= 0)
    state.org = as_c(frame.context.world->lights[static_cast<std::size_t>(point.light)].position);
  state.dist = length(point.position - vec(state.org));
  Result c(*shader.spec);
  c.color() = as_c(light, 1);
  return run(shader, state, c.bytes, miSHADER_SHADOW) ? rgb(c.color()) : Rgb(0);
}

/// One call of a light shader.
///
/// Inputs:  data: in and out, exchanged with the lit material; may be null.
Rgb evaluate_light(UserInstance& shader, StateFrame& frame, bool black,
                   mia_material_api_lightdata* data) {
  if (data) leave_value(miA_MATERIAL_API_LIGHTDATA, data, sizeof *data, miSS_LIFETIME_SUBRAYS);
  frame.context.shadow_is_black = black;
  Result c(*shader.spec);
  const bool answer = run(shader, frame.state, c.bytes, miSHADER_LIGHT);
  if (data) {
    int size = 0;
    if (const void* left = left_value(miA_MATERIAL_API_LIGHTDATA, &size);
        left && size == sizeof *data)
      *data = *static_cast<const mia_material_api_lightdata*>(left);
    leave_value(miA_MATERIAL_API_LIGHTDATA, nullptr, 0, 0);
  }
  return answer ? rgb(c.color()) : Rgb(0);
}

/// Stores the state of the light shader for the shadow shaders of this sample.
void keep_light_state(const miState& state, const miState& asker, const miFunction* shader) {
  Caller& caller = Caller::current();
  if (!caller.light_answer) return;
  miState& kept = *caller.light_answer;
  kept = state;
  kept.shader = shader;
  // The remaining pointers would dangle after the light shader returns.
  kept.cache = asker.cache;
  kept.tex_list = asker.tex_list;
  kept.bump_x_list = asker.bump_x_list;
  kept.bump_y_list = asker.bump_y_list;
  kept.derivs = asker.derivs;
  kept.child = nullptr;
  caller.ray = &kept;
}

LightValue light(const Call& call, const LightCall& light) {
  UserInstance& shader = instance_of(call);
  ShadingPoint& point = call.point;
  Host& host = *shader.spec->host;
  // The state of the sampling shader; for a built-in one, a state of the shading point.
  miState* asker = Caller::current().light;
  std::optional<StateFrame> lit;
  if (!asker) asker = &lit.emplace(host, point).state;
  StateFrame frame(host, point, asker);
  miState& state = frame.state;
  const World& world = *frame.context.world;
  state.type = miRAY_LIGHT;
  state.parent = asker;
  state.org = as_c(light.position);
  state.dir = as_c(light.direction);
  state.dist = std::isinf(light.distance) ? 0 : light.distance;
  state.dot_nd = dot(point.normal, light.direction);
  state.light_instance = make_tag(TagKind::LightInstance,
                                  static_cast<std::size_t>(&light.light - world.lights.data()));
  // Materials without glossiness pass no data.
  const bool passes_data = point.glossiness >= 0;
  const mia_material_api_lightdata asked = {sizeof asked, point.glossiness, point.importance, 1, 1,
                                            miFALSE,      miFALSE};
  mia_material_api_lightdata data = asked, behind_data = asked;
  LightValue value;
  LightItems& items = light_items();
  items = {};
  value.colour = evaluate_light(shader, frame, false, passes_data ? &data : nullptr);
  const LightItems answered = items;
  if (light.light.placed_by_shader) value.origin = vec(state.org);
  // A material in C that samples its lights itself sets the struct for them.
  if (int size = 0; !passes_data) {
    const void* left = left_value(miA_MATERIAL_API_LIGHTDATA, &size);
    if (left && size == sizeof data) data = *static_cast<const mia_material_api_lightdata*>(left);
  }
  value.shadow = frame.context.shadow_asked;
  value.affects_diffuse = answered.diffuse ? data.affect_diffuse : 0;
  value.affects_specular = answered.specular ? data.affect_specular : 0;
  value.force_specular = data.force_specular != miFALSE;
  value.is_sun = data.is_mr_sun != miFALSE;
  if (value.shadow) {
    state.org = as_c(light.position);
    const Rgb behind = evaluate_light(shader, frame, true, passes_data ? &behind_data : nullptr);
    const float open = luminance(value.colour);
    value.shadow_factor = open > 0 ? clamp01(luminance(behind) / open) : 0;
  }
  keep_light_state(state, *asker, shader.function);
  return value;
}

/// A volume is an affine function of the incoming light, which two calls determine. Photons are
/// attenuated like light.
VolumeValue volume(const Call& call) {
  UserInstance& shader = instance_of(call);
  const auto pass = [&](float behind) {
    StateFrame frame(*shader.spec->host, call.point);
    if (is_photon(call.point.ray_kind)) frame.state.type = miRAY_LIGHT;
    Result c(*shader.spec);
    c.color() = {behind, behind, behind, 1};
    run(shader, frame.state, c.bytes, miSHADER_VOLUME);
    return rgb(c.color());
  };
  const Rgb added = pass(0);
  return {pass(1) - added, added};
}

Rgba lens(const Call& call, LensNext& next) {
  UserInstance& shader = instance_of(call);
  StateFrame frame(*shader.spec->host, call.point);
  frame.context.lens = &next;
  Result c(*shader.spec);
  if (!run(shader, frame.state, c.bytes, miSHADER_LENS)) return Rgba(0, 0, 0, 0);
  const miColor& color = c.color();
  return Rgba(color.r, color.g, color.b, color.a);
}

void photon(const Call& call, const Rgb& energy, PhotonNext& next) {
  UserInstance& shader = instance_of(call);
  StateFrame frame(*shader.spec->host, call.point);
  frame.context.photon = &next;
  Result c(*shader.spec);
  c.color() = as_c(energy, 1);
  run(shader, frame.state, c.bytes, miSHADER_PHOTON);
}

void emit(const Call& call, const Light& light, PhotonEmission& emission) {
  UserInstance& shader = instance_of(call);
  StateFrame frame(*shader.spec->host, call.point, nullptr);
  frame.context.emission = &emission;
  frame.state.type = static_cast<miRay_type>(call.point.ray_kind);
  frame.state.org = as_c(light.position);
  frame.state.dir = as_c(light.direction);
  frame.state.light_instance =
      make_tag(TagKind::LightInstance,
               static_cast<std::size_t>(&light - frame.context.world->lights.data()));
  Result c(*shader.spec);
  c.color() = as_c(emission.energy(), 1);
  run(shader, frame.state, c.bytes, miSHADER_PHOTON_EMITTER);
}

void around_sample(const Call& call, EyeSample& sample) {
  using Moment = EyeSample::Moment;
  constexpr std::pair<Moment, miShader_state_op> kOps[] = {
      {Moment::StateInit, miSHADERSTATE_STATE_INIT},
      {Moment::SampleInit, miSHADERSTATE_SAMPLE_INIT},
      {Moment::SampleExit, miSHADERSTATE_SAMPLE_EXIT},
      {Moment::StateExit, miSHADERSTATE_STATE_EXIT}};
  UserInstance& shader = instance_of(call);
  StateFrame frame(*shader.spec->host, call.point, nullptr);
  frame.context.sample = &sample;
  Result c(*shader.spec);
  c.color() = as_c(sample.colour);
  miShader_state_arg argument = {};
  for (const auto& [moment, op] : kOps)
    if (moment == sample.moment) argument.op = op;
  argument.shader_return = sample.answer ? miTRUE : miFALSE;
  run(shader, frame.state, c.bytes, miSHADER_STATE, &argument);
  if (sample.moment != Moment::SampleExit) return;
  const miColor& color = c.color();
  sample.colour = Rgba(color.r, color.g, color.b, color.a);
}

void output(const Call& call, OutputPicture& picture) {
  UserInstance& shader = instance_of(call);
  StateFrame frame(*shader.spec->host, call.point, nullptr);
  OutputWork work{&picture};
  frame.context.output = &work;
  Result c(*shader.spec);
  run(shader, frame.state, c.bytes, miSHADER_OUTPUT);
  // Also close buffers that the shader left open.
  while (!work.open.empty()) work.close(work.open.begin()->first);
}

std::string geometry(const Call& call, scene::Scene& scene) {
  UserInstance& shader = instance_of(call);
  Host& host = *shader.spec->host;
  StateFrame frame(host, call.point, nullptr);
  GeometryWork work;
  work.scene = &scene;
  work.prefix = std::string(shader.spec->name) + ":";
  GeometryWork* const outer = std::exchange(GeometryWork::current(), &work);
  Result c(*shader.spec);
  std::string made;
  if (run(shader, frame.state, c.bytes, miSHADER_GEOMETRY)) {
    // A shader may return one tag as its result instead of calling mi_geoshader_add_result.
    miTag& tag = reinterpret_cast<miTag&>(*c.bytes);
    if (work.results.empty()) mi_geoshader_add_result(&tag, tag);
    made = finish(work);
  }
  GeometryWork::current() = outer;
  return made;
}

bool always(const ShaderNode&) { return true; }
/// Emission and reflection of a material in C cannot be separated, so there are no lobes to select.
bool never(const ShaderNode&) { return false; }
int no_lobes(const ShaderNode&) { return 0; }

}  // namespace

void set_roles(UserSpec& spec) {
  const auto acts_as = [&](unsigned bit) { return spec.apply == 0 || (spec.apply & bit) != 0; };
  spec.binding.deferred = true;
  spec.binding.prepare_call = prepare_call;
  spec.value = value;
  spec.material.max_lobes = no_lobes;
  if (acts_as(kApplyMaterial)) spec.material.fill = material;
  if (acts_as(kApplyShadow)) {
    spec.material.shadow = shadow;
    spec.material.may_transmit = always;
  }
  spec.material.may_emit = never;
  if (acts_as(kApplyLight)) spec.light.evaluate = light;
  if (acts_as(kApplyVolume)) {
    spec.volume.evaluate = volume;
    spec.volume.dims_light = always;
    spec.volume.acts_on_endless_rays = true;
  }
  if (acts_as(kApplyLens)) spec.lens.trace = lens;
  if (acts_as(kApplyPhoton)) spec.photon.scatter = photon;
  if (acts_as(kApplyEmitter)) spec.photon.emit = emit;
  if (acts_as(kApplyState)) spec.around_sample = around_sample;
  if (acts_as(kApplyOutput)) spec.output = output;
  spec.geometry = geometry;
}

UserInstance* user_instance(const ShaderNode& node) {
  if (node.spec().binding.prepare_call != prepare_call) return nullptr;
  return static_cast<UserInstance*>(const_cast<ShaderState*>(node.state()));
}

}  // namespace oriel::sdk
