// SPDX-License-Identifier: Apache-2.0
// mi_fb_put and mi_fb_get.
#include "sdk/frame_buffers.h"

#include <cstring>

#include "output/camera_output.h"
#include "sdk/call.h"
#include "sdk/host.h"

namespace oriel::sdk {
namespace {

/// Finds a buffer and its index by number; null if there is none.
const UserBuffer* find(const World& world, int number, std::size_t& slot) {
  for (slot = 0; slot < world.user_buffers.size(); ++slot)
    if (world.user_buffers[slot].number == number) return &world.user_buffers[slot];
  return nullptr;
}

}  // namespace

const scene::Camera* scene_camera(const Host& host) {
  const auto& renders = host.scene().renders;
  return renders.empty() ? nullptr : find_camera(host.scene(), renders.back());
}

int buffer_index(const Host& host, const std::string& name) {
  if (!host.world()) return -1;
  for (const UserBuffer& buffer : host.world()->user_buffers)
    if (buffer.name == name) return buffer.number;
  return -1;
}

}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_fb_put(miState* state, int fb, const void* data) {
  const Context& c = context(state);
  std::size_t slot = 0;
  const UserBuffer* buffer = find(*c.world, fb, slot);
  if (!buffer) return miFALSE;
  Rgba value(0, 0, 0, 1);
  switch (buffer->kind) {
    case UserBuffer::Kind::Color:
      std::memcpy(&value.r, data, sizeof(miColor));
      break;
    case UserBuffer::Kind::Vector: {
      miVector v;
      std::memcpy(&v, data, sizeof v);
      value = Rgba(v.x, v.y, v.z, 1);
      break;
    }
    case UserBuffer::Kind::Scalar: {
      miScalar s;
      std::memcpy(&s, data, sizeof s);
      value = Rgba(s, s, s, 1);
      break;
    }
  }
  if (c.sample && slot < c.sample->buffers.size()) {
    c.sample->buffers[slot] = value;
    return miTRUE;
  }
  return c.tracer() && c.tracer()->write_buffer(slot, value) ? miTRUE : miFALSE;
}

miBoolean mi_fb_get(miState* state, int fb, void* data) {
  const Context& c = context(state);
  std::size_t slot = 0;
  const UserBuffer* buffer = find(*c.world, fb, slot);
  if (!buffer) return miFALSE;
  std::optional<Rgba> value;
  if (c.sample && slot < c.sample->buffers.size())
    value = c.sample->buffers[slot];
  else if (c.tracer())
    value = c.tracer()->read_buffer(slot);
  if (!value) return miFALSE;
  const std::size_t bytes = buffer->kind == UserBuffer::Kind::Color    ? sizeof(miColor)
                            : buffer->kind == UserBuffer::Kind::Vector ? sizeof(miVector)
                                                                       : sizeof(miScalar);
  std::memcpy(data, &value->r, bytes);
  return miTRUE;
}

}  // extern "C"
