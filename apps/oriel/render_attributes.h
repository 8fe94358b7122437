// SPDX-License-Identifier: Apache-2.0
// Attributes of EXR files that say how a picture was rendered.
#pragma once

#include <map>
#include <string>

#include "image/exr.h"

namespace oriel {
class RenderSession;
}

namespace oriel::app {

struct RenderArguments;

/// Without --timestamps the same command gives the same attributes.
std::map<std::string, ExrValue> render_attributes(const RenderArguments& a,
                                                  const RenderSession& session);

}  // namespace oriel::app
