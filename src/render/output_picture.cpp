// SPDX-License-Identifier: Apache-2.0
#include "render/output_picture.h"

#include <algorithm>

namespace oriel {

Image* OutputPicture::buffer(int number) {
  if (number == 0) return &shown_;
  if (number != 1 && number != 2) return nullptr;
  if (const auto made = others_.find(number); made != others_.end()) return &made->second;
  Image image(shown_.width, shown_.height, number == 1 ? 1 : 3);
  const Window& w = session_.window();
  for (int y = 0; y < w.height(); ++y)
    for (int x = 0; x < w.width(); ++x) {
      const Film::Pixel pixel = session_.film().pixel(x, y);
      // The film covers the window, pictures all of the frame; both from the top.
      float* to = image.at(w.x0 + x, image.height - w.y1 + y);
      if (number == 1)
        *to = pixel.depth;
      else
        std::copy_n(&pixel.normal.x, 3, to);
    }
  return &others_.emplace(number, std::move(image)).first->second;
}

void run_output_shaders(const NodeList& shaders, const RenderSession& session, Image& shown) {
  OutputPicture picture(session, shown);
  for (const ShaderNode* node : shaders) {
    if (!node->spec().output) continue;
    ShadingPoint point;
    point.ray_kind = RayKind::Output;
    point.world = &session.world();
    node->with_params(point, [&](const Call& call) { node->spec().output(call, picture); });
  }
}

}  // namespace oriel
