// SPDX-License-Identifier: Apache-2.0
// Parameter evaluation (mi_eval) and shaders called by shaders.
#include <algorithm>
#include <cstring>

#include "oriel/sdk/mia_material_api.h"
#include "sdk/call.h"
#include "sdk/host.h"
#include "sdk/material_api.h"

namespace oriel::sdk {
namespace {

const CConnection* connection_of(const UserInstance& shader, const void* parameter) {
  const auto offset = static_cast<std::size_t>(static_cast<const std::byte*>(parameter) -
                                               static_cast<const std::byte*>(shader.parameters));
  for (const CConnection& c : shader.connections)
    if (c.c_offset == offset) return &c;
  return nullptr;
}

/// Evaluates the connected shader and converts its value to the C type of the parameter.
void evaluate(const Connection& source, ParamType type, miState* state, std::byte* value) {
  ShadingPoint point = point_of(state);
  const ShadingPoint before = point;
  Result result(source.source->spec().result_size);
  if (UserInstance* user = user_instance(*source.source)) {
    // Same state: a bump shader changes the normal for the calling shader.
    Result c(*user->spec);
    run(*user, *state, c.bytes, miSHADER_TEXTURE);
    result_from_c(*user->spec, c.bytes, result.bytes);
  } else {
    const CallerScope caller(Caller::at_point(state, point));
    source.source->value(point, result.bytes);
    // Changes of the point apply to the caller, except for vector parameters, where the result is
    // the value.
    if (type != ParamType::Vector) take_over(point, before, state);
  }
  alignas(16) std::byte own[sizeof(Mat4)] = {};
  convert_value(source.source_type, result.bytes + source.source_offset, type, own);
  to_c(type, own, value);
}

void* value_of(miState* state, void* parameter, bool again) {
  Context& c = context(state);
  if (!c.shader || c.shader->connections.empty()) return parameter;
  const CConnection* connection = connection_of(*c.shader, parameter);
  if (!connection) return parameter;
  if (!again)
    for (const Evaluated* e = c.evaluated; e; e = e->next)
      if (e->parameter == parameter) return e->value;
  // The value is stored after the entry; both keep their address while the shader runs.
  auto* entry = static_cast<Evaluated*>(allocate_for_call(sizeof(Evaluated)));
  auto* value = static_cast<std::byte*>(
      allocate_for_call(std::max<std::size_t>(c_size(connection->type), sizeof(miColor))));
  evaluate(*connection->source, connection->type, state, value);
  *entry = {parameter, value, c.evaluated};
  c.evaluated = entry;
  return value;
}

/// The first shader in the slot of a material for a kind of call.
const ShaderNode* shader_of(const Material& material, miShader_type type) {
  const auto first = [](const NodeList& list) { return list.empty() ? nullptr : list.front(); };
  switch (type) {
    case miSHADER_SHADOW:
      return first(material.shadow);
    case miSHADER_ENVIRONMENT:
      return first(material.environment);
    case miSHADER_DISPLACE:
      return first(material.displace);
    case miSHADER_PHOTON:
      return first(material.photon);
    case miSHADER_VOLUME:
      return first(material.volume);
    case miSHADER_PHOTONVOL:
    case miSHADER_CONTOUR:
    case miSHADER_LIGHTMAP:
      return nullptr;  // materials have no such shaders in Oriel
    default:
      return first(material.surface);
  }
}

}  // namespace

bool run_node(const ShaderNode& node, miState& state, void* result, miShader_type type,
              void* argument) {
  if (UserInstance* user = user_instance(node)) return run(*user, state, result, type, argument);
  ShadingPoint point = point_of(&state);
  const ShadingPoint before = point;
  const CallerScope caller(Caller::at_point(&state, point));
  if (node.spec().material.fill) return shade_material(node, point, state, result);
  if (!node.spec().value) return false;
  Result own(node.spec().result_size);
  node.value(point, own.bytes);
  take_over(point, before, &state);
  const ShaderSpec& spec = node.spec();
  if (spec.result != ParamType::Struct) {
    to_c(spec.result, own.bytes, result);
    return true;
  }
  auto* c = static_cast<std::byte*>(result);
  for (const ParamSpec& member : spec.results) {
    to_c(member.type, own.bytes + member.offset, c);
    c += c_size(member.type);
  }
  return true;
}

}  // namespace oriel::sdk

using namespace oriel::sdk;

extern "C" {

void* mi_phen_eval(miState* state, void* parameter) { return value_of(state, parameter, false); }
void* mi_phen_call(miState* state, void* parameter) { return value_of(state, parameter, true); }

void mi_flush_cache(miState* state) { context(state).evaluated = nullptr; }

miBoolean mi_call_shader_x(miColor* result, miShader_type type, miState* state, miTag tag,
                           void* argument) {
  Host& host = *context(state).host;
  const oriel::ShaderNode* node = host.node(tag);
  if (const oriel::Material* material = host.material(tag)) node = shader_of(*material, type);
  return node && run_node(*node, *state, result, type, argument) ? miTRUE : miFALSE;
}

miBoolean mi_call_shader(miColor* result, miShader_type type, miState* state, miTag tag) {
  return mi_call_shader_x(result, type, state, tag, nullptr);
}

// Bound calls are immutable, so a clone is the call itself.
miTag mi_phen_clone(miState*, miTag tag) { return tag; }
void mi_phen_unclone(miState*, miTag) {}

miBoolean mi_call_material(miColor* result, miState* state) {
  return mi_call_shader_x(result, miSHADER_MATERIAL, state, state->material, nullptr);
}
miBoolean mi_call_shadow_material(miColor* result, miState* state) {
  return mi_call_shader_x(result, miSHADER_SHADOW, state, state->material, nullptr);
}
miBoolean mi_call_environment_material(miColor* result, miState* state) {
  return mi_call_shader_x(result, miSHADER_ENVIRONMENT, state, state->material, nullptr);
}
miBoolean mi_call_photon_material(miColor* result, miState* state) {
  return mi_call_shader_x(result, miSHADER_PHOTON, state, state->material, nullptr);
}
miBoolean mi_call_volume_material(miColor* result, miState* state) {
  return mi_call_shader_x(result, miSHADER_VOLUME, state, state->material, nullptr);
}
miBoolean mi_call_photonvol_material(miColor* result, miState* state) {
  return mi_call_shader_x(result, miSHADER_PHOTONVOL, state, state->material, nullptr);
}

}  // extern "C"
