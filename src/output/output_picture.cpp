// SPDX-License-Identifier: Apache-2.0
#include "output/output_picture.h"

#include <algorithm>

#include "output/layer_table.h"

namespace oriel {
namespace {

/// First number of user buffers in the C interface, as in mental ray (miRC_IMAGE_USER).
constexpr int kFirstUserNumber = 12;

}  // namespace

Image film_user_buffer(const RenderSession& session, std::size_t slot) {
  const UserBuffer::Kind kind = session.world().user_buffers[slot].kind;
  const int channels = kind == UserBuffer::Kind::Scalar   ? 1
                       : kind == UserBuffer::Kind::Vector ? 3
                                                          : 4;
  return collect_pixels(session, channels, [&](int x, int y, float* to) {
    const Rgba value = session.film().user_buffer(x, y, slot);
    std::copy_n(&value.r, channels, to);
  });
}

std::optional<std::size_t> OutputPicture::slot_of(int number) const {
  const auto& buffers = session_.world().user_buffers;
  const auto find = [&](int wanted) -> std::optional<std::size_t> {
    for (std::size_t slot = 0; slot < session_.film().user_buffers(); ++slot)
      if (buffers[slot].number == wanted) return slot;
    return std::nullopt;
  };
  if (number >= kFirstUserNumber)
    if (const auto slot = find(number - kFirstUserNumber)) return slot;
  return number > 2 ? find(number) : std::nullopt;
}

Image& OutputPicture::user_buffer(std::size_t slot) {
  const auto made = user_buffers_.find(slot);
  if (made != user_buffers_.end()) return made->second;
  return user_buffers_.emplace(slot, film_user_buffer(session_, slot)).first->second;
}

Image* OutputPicture::geometry(int number) {
  if (const auto made = others_.find(number); made != others_.end()) return &made->second;
  Image image = collect_pixels(session_, number == 1 ? 1 : 3, [&](int x, int y, float* to) {
    const Film::Pixel pixel = session_.film().pixel(x, y);
    if (number == 1)
      *to = pixel.depth;
    else
      std::copy_n(&pixel.normal.x, 3, to);
  });
  return &others_.emplace(number, std::move(image)).first->second;
}

Image* OutputPicture::buffer(int number) {
  if (number == 0) return &shown_;
  if (number == 1 || number == 2) return geometry(number);
  const auto slot = slot_of(number);
  return slot ? &user_buffer(*slot) : nullptr;
}

void run_output_shader(const ShaderNode& node, OutputPicture& picture) {
  ShadingPoint point;
  point.ray_kind = RayKind::Output;
  point.world = &picture.world();
  node.with_params(point, [&](const Call& call) { node.spec().output(call, picture); });
}

}  // namespace oriel
