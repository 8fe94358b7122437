// SPDX-License-Identifier: Apache-2.0
// A small quick picture of a scene, for reports.
#pragma once

#include <string>

#include "scene/scene.h"
#include "sdk/library.h"

namespace oriel::app {

/// The bytes of a PNG file; empty where there is no picture, and `why` says why.
///
/// Model:   the last frame that was read, path traced with few samples for a few seconds, through
///          its own exposures.
std::string thumbnail(scene::Scene& scene, const sdk::TrustedFolders& trusted, std::string& why);

}  // namespace oriel::app
