// SPDX-License-Identifier: Apache-2.0
// Attributes of EXR files that describe camera and exposure of a picture.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "image/exr.h"
#include "runtime/world.h"

namespace oriel {

/// Horizontal field of view of perspective cameras, degrees.
inline constexpr const char* kFieldOfViewKey = "oriel.fieldOfView";
/// Name of the exposure shader of a picture. Its numeric parameters follow as
/// "oriel.exposure.PARAMETER".
inline constexpr const char* kExposureKey = "oriel.exposure";

/// Attributes of the camera and of the first exposure among its lens shaders and `outputs`.
///
/// Model:   worldToCamera and worldToNDC as OpenEXR defines them: camera space is left-handed (x
///          right, y up, z forward); NDC is (0, 0) at the upper left and (1, 1) at the lower right
///          corner of the display window. A moving camera counts in the middle of the shutter
///          interval. expTime, aperture and isoSpeed only for photographic exposures with film
///          speed.
/// Source:  OpenEXR, "Standard Attributes".
/// Checked: PictureMetadata.*
std::map<std::string, ExrValue> picture_metadata(const World& world, const NodeList& outputs);

/// Value of the attribute capDate, in UTC: the environment variable SOURCE_DATE_EPOCH (seconds
/// since 1970), otherwise the current time if `now`; otherwise unset.
std::optional<std::string> capture_date(bool now);

}  // namespace oriel
