// SPDX-License-Identifier: Apache-2.0
// The picture behind the C interface.
#pragma once

#include <memory>

#include "interactive/picture.h"
#include "oriel/oriel.h"

struct OrielPicture {
  std::shared_ptr<const oriel::interactive::Picture> picture;
};
