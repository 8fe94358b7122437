// SPDX-License-Identifier: Apache-2.0
// Light samples at the point, and lists of lights.
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "oriel/sdk/mia_material_api.h"
#include "photometry/light_profile.h"
#include "runtime/profile_placement.h"
#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "sdk/maya_items.h"
#include "sdk/shader_state.h"

namespace oriel::sdk {
namespace {

/// A returned list stays valid until its thread has requested this many others.
constexpr std::size_t kListsKept = 64;

/// Returns a list of lights that stays valid while the shader runs.
void give(const std::vector<miTag>& tags, int* n, miTag** lights) {
  thread_local std::vector<std::vector<miTag>> lists(kListsKept);
  thread_local std::size_t next = 0;
  std::vector<miTag>& list = lists[next++ % kListsKept];
  list = tags;
  *n = static_cast<int>(list.size());
  *lights = list.data();
}

/// Stores the attributes of a light sample in the struct of the calling material, and in Maya's
/// state items.
void store_light_data(const Tracer::Arriving& arriving) {
  light_items() = {arriving.affects_diffuse > 0, arriving.affects_specular > 0};
  int size = 0;
  auto* data =
      static_cast<mia_material_api_lightdata*>(left_value(miA_MATERIAL_API_LIGHTDATA, &size));
  if (!data || size != sizeof *data || data->struct_size != sizeof *data) return;
  data->affect_diffuse = arriving.affects_diffuse;
  data->affect_specular = arriving.affects_specular;
  data->is_mr_sun = arriving.is_sun ? miTRUE : miFALSE;
  data->force_specular = arriving.force_specular ? miTRUE : miFALSE;
}

/// Takes one sample of the light; `samples` is 0 at the first call, and the loop ends at 1. The
/// renderer already calls the shader once per sample, so one light sample per call is sufficient.
bool sample(miColor* result, miVector* dir, float* dot_nl, miState* state, miTag tag, int* samples,
            const miVector* axis, float cos_spread) {
  Context& c = context(state);
  const int light = c.host->light(tag);
  *result = {0, 0, 0, 0};
  if (light < 0 || !c.tracer() || *samples > 0) return false;
  *samples = 1;
  ShadingPoint point = point_of(state);
  miState light_answer;
  const CallerScope caller(Caller::of_light(state, &light_answer));
  const auto arriving = c.tracer()->light(light, point);
  if (!arriving) return false;
  store_light_data(*arriving);
  const float cosine = dot(point.normal, arriving->wi);
  if (axis) {
    if (dot(vec(*axis), arriving->wi) < cos_spread) return false;
  } else if (cosine <= 0 && state->pri && point.normal != Vec3(0)) {
    return false;
  }
  *result = as_c(arriving->colour, 1);
  if (dir) *dir = as_c(arriving->wi);
  if (dot_nl) *dot_nl = cosine;
  return true;
}

float profile_value(const photometry::LightProfile& profile, const Vec3& direction, bool relative) {
  const float value = profile.evaluate(direction);
  return relative && profile.peak() > 0 ? value / profile.peak() : value;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_sample_light(miColor* result, miVector* dir, float* dot_nl, miState* state,
                          miTag light_inst, int* samples) {
  return sample(result, dir, dot_nl, state, light_inst, samples, nullptr, 0) ? miTRUE : miFALSE;
}

miBoolean oriel_light_sample(miColor* result, miVector* dir, miScalar* dot_nl, miState* state,
                             miTag light_inst, int* samples, const miVector* axis,
                             miScalar cos_spread) {
  return sample(result, dir, dot_nl, state, light_inst, samples, axis, cos_spread) ? miTRUE
                                                                                   : miFALSE;
}

miBoolean mi_trace_light(miColor* result, miVector* dir, float* dot_nl, miState* state,
                         miTag light_inst) {
  int samples = 0;
  return mi_sample_light(result, dir, dot_nl, state, light_inst, &samples);
}

void mi_light_info(miTag light_inst, miVector* org, miVector* dir, void** paras) {
  Host* host = current_host();
  const int index = host ? host->light(light_inst) : -1;
  if (index < 0) return;
  const auto* light = static_cast<const miLight*>(
      host->access(make_tag(TagKind::Light, static_cast<std::size_t>(index))));
  if (org) *org = light->origin;
  if (dir) *dir = light->direction;
  if (!paras) return;
  const auto* function = static_cast<miFunction*>(host->access(light->shader));
  *paras = function ? const_cast<char*>(function->parameters) : nullptr;
}

int mi_global_lights_info(miTag** lights) {
  int n = 0;
  Host* host = current_host();
  give(host ? host->lights() : std::vector<miTag>(), &n, lights);
  return n;
}

miBoolean mi_expand_lightlist(int* n, miTag** lights, miState* state) {
  // Groups are expanded to the lights they contain; an empty list means all lights of the scene.
  std::vector<miTag> list;
  for (int i = 0; i < *n; ++i)
    if (context(state).host->light((*lights)[i]) >= 0) list.push_back((*lights)[i]);
  give(list, n, lights);
  return miTRUE;
}

miBoolean mi_inclusive_lightlist(int* n, miTag** lights, miState* state) {
  return mi_expand_lightlist(n, lights, state);
}

miBoolean mi_exclusive_lightlist(int* n, miTag** lights, miState* state) {
  std::vector<miTag> list;
  for (const miTag tag : context(state).host->lights())
    if (std::find(*lights, *lights + *n, tag) == *lights + *n) list.push_back(tag);
  give(list, n, lights);
  return miTRUE;
}

miBoolean mi_instance_lightlist(int* n, miTag** lights, miState* state) {
  Host& host = *context(state).host;
  const InstanceData* instance = host.instance(state->instance);
  std::vector<miTag> list = host.lights();
  if (instance && instance->linked) {
    const auto linked = [&](miTag tag) {
      const int light = host.light(tag);
      const bool named = std::find(instance->lights.begin(), instance->lights.end(), light) !=
                         instance->lights.end();
      return named != instance->lights_exclusive;
    };
    list.erase(std::remove_if(list.begin(), list.end(), [&](miTag t) { return !linked(t); }),
               list.end());
  }
  give(list, n, lights);
  return miTRUE;
}

miScalar mi_lightprofile_value(const void* profile, miScalar phi, miScalar costheta,
                               const miVector* pos, miBoolean rel) {
  if (!profile) return 0;
  const float sine = std::sqrt(std::max(0.0f, 1 - costheta * costheta));
  // The axis of the profile is -z: theta is measured from nadir.
  const Vec3 direction =
      pos ? normalize(vec(*pos)) : Vec3(sine * math::cos(phi), sine * math::sin(phi), -costheta);
  return profile_value(*static_cast<const photometry::LightProfile*>(profile), direction,
                       rel != miFALSE);
}

miScalar mi_lightprofile_sample(miState* state, miTag tag, miBoolean rel) {
  Context& c = context(state);
  const photometry::LightProfile* profile = c.host->profile(tag);
  const int light = c.host->light(state->light_instance);
  if (!profile || light < 0) return 0;
  const Light& from = c.world->lights[static_cast<std::size_t>(light)];
  const ProfilePlacement placed = place_profile(profile, from.to_world, from.direction);
  return profile_value(*profile, placed.to_profile(vec(state->dir)), rel != miFALSE);
}

}  // extern "C"
