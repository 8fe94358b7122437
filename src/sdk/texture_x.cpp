// SPDX-License-Identifier: Apache-2.0
// Texture lookups with an elliptical pixel filter.
#include "oriel/sdk/shader/texture_x.h"

#include "runtime/texture_node.h"
#include "sdk/context.h"
#include "sdk/host.h"

using namespace oriel;
using namespace oriel::sdk;

namespace {

/// The filtered colour of an image; false if an unfiltered lookup has to be used.
bool filtered_color(miColor& color, miState* state, miTag tag, const miVector* coord,
                    const miTexfilter* filter) {
  const TextureNode* texture = context(state).host->texture(tag);
  if (!filter || !texture || !texture->procedure().empty()) return false;
  miVector p[3], t[3];
  miMatrix st;
  if (!mi_texture_filter_project(p, t, state, 1, 0) || !mi_texture_filter_transform(st, p, t))
    return false;
  st[8] = coord->x;
  st[9] = coord->y;
  return mi_lookup_filter_color_texture(&color, state, tag, filter, st) != miFALSE;
}

}  // namespace

extern "C" {

miBoolean mi_lookup_color_texture_x(miColor* result, miState* state, miTag tag,
                                    const miVector* coord, const miTexfilter* filter) {
  if (filtered_color(*result, state, tag, coord, filter)) return miTRUE;
  return mi_lookup_color_texture(result, state, tag, coord);
}

miBoolean mi_lookup_scalar_texture_x(miScalar* result, miState* state, miTag tag,
                                     const miVector* coord, const miTexfilter* filter) {
  miColor color;
  if (!filtered_color(color, state, tag, coord, filter))
    return mi_lookup_scalar_texture(result, state, tag, coord);
  convert_value(ParamType::Color, &color, ParamType::Scalar, result);
  return miTRUE;
}

miBoolean mi_lookup_vector_texture_x(miVector* result, miState* state, miTag tag,
                                     const miVector* coord, const miTexfilter* filter) {
  miColor color;
  if (!filtered_color(color, state, tag, coord, filter))
    return mi_lookup_vector_texture(result, state, tag, coord);
  convert_value(ParamType::Color, &color, ParamType::Vector, result);
  return miTRUE;
}

}  // extern "C"
