// SPDX-License-Identifier: Apache-2.0
// The finished picture in the hands of output shaders that work on all of it at once.
#pragma once

#include <map>

#include "image/pixel_buffer.h"
#include "render/session.h"

namespace oriel {

/// Buffers by the numbers of the C interface: 0 the picture, RGBA as it is shown, which alone may
/// be changed; 1 depth, one channel, 0 where there is nothing; 2 world normals, three.
class OutputPicture {
 public:
  OutputPicture(const RenderSession& session, Image& shown) : session_(session), shown_(shown) {}

  /// Null when the picture has no such buffer.
  Image* buffer(int number);

 private:
  const RenderSession& session_;
  Image& shown_;
  std::map<int, Image> others_;
};

/// Runs the output shaders of the list that work on whole pictures over one, in order.
void run_output_shaders(const NodeList& shaders, const RenderSession& session, Image& shown);

}  // namespace oriel
