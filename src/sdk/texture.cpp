// SPDX-License-Identifier: Apache-2.0
// Texture lookups by tag: images, texture shaders, and shaders.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/fraction.h"
#include "runtime/texture_node.h"
#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/host.h"

namespace oriel::sdk {
namespace {

ParamType first_result(const ShaderSpec& spec) {
  return spec.result == ParamType::Struct ? spec.results[0].type : spec.result;
}

/// Runs a shader with the coordinate in state->tex, and converts its result.
bool run_texture(const ShaderNode& node, miState* state, const miVector& coord, ParamType type,
                 void* value) {
  const miVector tex = std::exchange(state->tex, coord);
  Context& c = context(state);
  const Vec3 first = std::exchange(c.point->tex[0], vec(coord));
  const UserInstance* user = user_instance(node);
  Result result(user ? user->spec->c_result_size : node.spec().result_size);
  const bool answer = run_node(node, *state, result.bytes, miSHADER_TEXTURE);
  c.point->tex[0] = first;
  state->tex = tex;
  alignas(16) std::byte own[sizeof(Mat4)] = {};
  from_c(first_result(node.spec()), result.bytes, own);
  convert_value(first_result(node.spec()), own, type, value);
  return answer;
}

/// The colour of a texture element at a coordinate.
bool look_up(const TextureNode& texture, miState* state, const miVector& coord, miColor& color) {
  if (texture.missing()) return false;
  if (!texture.procedure().empty()) {
    bool answer = true;
    for (const ShaderNode* node : texture.procedure())
      answer = run_texture(*node, state, coord, ParamType::Color, &color);
    return answer;
  }
  ShadingPoint point = point_of(state);
  // Coordinates repeat.
  const Vec2 uv(fraction(coord.x), fraction(coord.y));
  point.tex[0] = vec(coord);
  color = as_c(texture.lookup(uv, point, {}));
  return true;
}

/// The value of a texture, converted to a type of the renderer.
bool value_of(miTag tag, miState* state, const miVector* coord, ParamType type, void* value) {
  const Host& host = *context(state).host;
  if (const TextureNode* texture = host.texture(tag)) {
    miColor color;
    if (!look_up(*texture, state, *coord, color)) return false;
    convert_value(ParamType::Color, &color, type, value);
    return true;
  }
  const ShaderNode* node = host.node(tag);
  return node && run_texture(*node, state, *coord, type, value);
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_lookup_color_texture(miColor* result, miState* state, miTag tag,
                                  const miVector* coord) {
  return value_of(tag, state, coord, ParamType::Color, result) ? miTRUE : miFALSE;
}

miBoolean mi_lookup_scalar_texture(miScalar* result, miState* state, miTag tag,
                                   const miVector* coord) {
  return value_of(tag, state, coord, ParamType::Scalar, result) ? miTRUE : miFALSE;
}

miBoolean mi_lookup_vector_texture(miVector* result, miState* state, miTag tag,
                                   const miVector* coord) {
  return value_of(tag, state, coord, ParamType::Vector, result) ? miTRUE : miFALSE;
}

miBoolean mi_lookup_filter_color_texture(miColor* result, miState* state, miTag tag,
                                         const miTexfilter* filter, miMatrix ST) {
  const TextureNode* texture = context(state).host->texture(tag);
  // (x, y, 1) * ST is the texture coordinate of a screen point relative to the centre of the disc.
  const miVector centre = {ST[8], ST[9], 0};
  if (!texture) return mi_lookup_color_texture(result, state, tag, &centre);
  if (texture->missing()) return miFALSE;
  const float radius = filter && filter->circle_radius > 0 ? filter->circle_radius : 0.5f;
  TextureFootprint footprint;
  footprint.dx = Vec2(ST[0], ST[1]) * (2 * radius);
  footprint.dy = Vec2(ST[4], ST[5]) * (2 * radius);
  ShadingPoint point = point_of(state);
  const Vec2 uv(fraction(centre.x), fraction(centre.y));
  *result = as_c(texture->lookup(uv, footprint, point, {}));
  return miTRUE;
}

void mi_texture_info(miTag tag, int* xres, int* yres, void** paras) {
  Host* host = current_host();
  const TextureNode* texture = host ? host->texture(tag) : nullptr;
  if (xres) *xres = texture ? texture->width() : 0;
  if (yres) *yres = texture ? texture->height() : 0;
  if (!paras) return;
  auto* function = host && host->node(tag) ? static_cast<miFunction*>(host->access(tag)) : nullptr;
  *paras = function ? function->parameters : nullptr;
}

miBoolean mi_texture_interpolate(miState* state, miUint space, miScalar* result) {
  const ShadingPoint& point = *context(state).point;
  if (space >= point.texture_spaces) return miFALSE;
  std::copy_n(&point.tex[space].x, 3, result);
  return miTRUE;
}

}  // extern "C"
