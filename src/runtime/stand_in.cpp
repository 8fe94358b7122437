// SPDX-License-Identifier: Apache-2.0
#include "runtime/stand_in.h"

#include "runtime/closure.h"

namespace oriel {
namespace {

/// Magenta: nothing in a daylight scene looks like it.
const Rgb kMissingColor(0.8f, 0.0f, 0.5f);

}  // namespace

const ShaderSpec kStandIn = {
    .name = "oriel_stand_in",
    .library = "oriel",
    .doc = "Takes the place of a shader that is not available.",
    .value =
        [](const Call&, void* result) {
          *static_cast<Rgba*>(result) = Rgba(kMissingColor.x, kMissingColor.y, kMissingColor.z, 1);
        },
    .material =
        [](const Call& call, Closure& closure) {
          closure.add(LobeKind::Diffuse, Channel::Diffuse, kMissingColor, Frame(call.point.normal));
          closure.albedo = kMissingColor;
        },
};

}  // namespace oriel
