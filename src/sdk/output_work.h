// SPDX-License-Identifier: Apache-2.0
// The buffers that an output shader has open.
#pragma once

#include <map>
#include <memory>

#include "output/output_picture.h"
#include "sdk/picture.h"

namespace oriel::sdk {

struct OutputWork {
  OutputPicture* picture = nullptr;
  std::map<int, std::unique_ptr<Picture>> open = {};

  /// Takes over what the shader changed.
  void close(int number) {
    const auto found = open.find(number);
    if (found == open.end()) return;
    if (picture->is_writable(number)) *picture->buffer(number) = to_image(*found->second);
    open.erase(found);
  }
};

}  // namespace oriel::sdk
