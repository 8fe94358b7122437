// SPDX-License-Identifier: Apache-2.0
// A small quick picture of a scene for other ends than the picture itself.
#pragma once

#include <functional>

#include "render/session.h"
#include "scene/scene.h"
#include "sdk/host.h"

namespace oriel::app {

struct QuickLook {
  int width = 480;  ///< pixels at most; the height follows the camera's
  std::uint32_t samples = 64;
  double seconds = 15;  ///< at most, of the clock
};

/// What there is to look at; valid during the call.
struct QuickLookResult {
  RenderSession& session;
  World& world;
  const scene::Camera& camera;
  sdk::Host& host;
};

/// Path traces the last frame of a scene and hands it to `use`. False, and `use` is not called,
/// where the scene has no camera that could render it.
bool quick_look(scene::Scene& scene, const sdk::TrustedFolders& trusted, const QuickLook& look,
                const std::function<void(const QuickLookResult&)>& use);

}  // namespace oriel::app
