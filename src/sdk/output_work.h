// SPDX-License-Identifier: Apache-2.0
// Open buffers of an output shader.
#pragma once

#include <map>
#include <memory>

#include "output/output_picture.h"
#include "sdk/picture.h"

namespace oriel::sdk {

struct OutputWork {
  OutputPicture* picture = nullptr;
  std::map<int, std::unique_ptr<Picture>> open = {};

  /// Stores the changes of the shader.
  void close(int number) {
    const auto found = open.find(number);
    if (found == open.end()) return;
    if (picture->is_writable(number)) *picture->buffer(number) = to_image(*found->second);
    open.erase(found);
  }
};

}  // namespace oriel::sdk
