// SPDX-License-Identifier: Apache-2.0
// What an interactive session shows; nothing of it belongs to the scene.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "render/budget.h"
#include "runtime/camera.h"
#include "runtime/window.h"
#include "scene/light_group.h"

namespace oriel::interactive {

/// A camera placed by points of world space.
struct Look {
  Vec3 from{0}, to{0}, up{0};
  bool operator==(const Look&) const = default;
};

/// Matrix from world space to the camera: the camera looks along -z from `from` to `to`. Unset if
/// the points do not define it.
/// Checked: RenderLoopTest.LooksArePlacedLikeInstances
std::optional<Mat4> camera_matrix(const Look& look);

/// The look of a camera with a target at that distance. `up` is the vertical axis, z or y, of which
/// the camera is upright; else that of the camera.
/// Checked: ViewSettings.*
Look look_of(const Camera& camera, float distance);

struct ViewSettings {
  std::optional<Look> look = {};                ///< instead of the placement of the scene's camera
  std::string camera;                           ///< instance; empty: that of the render statement
  std::optional<std::array<int, 2>> size = {};  ///< pixels; unset: from the camera
  int scale = 1;                                ///< divides the size
  /// Pixels of the full-size picture from the upper left: x0, y0, x1, y1, ends excluded.
  std::optional<std::array<int, 4>> region = {};
  std::vector<std::string> layers = {"beauty"};
  BudgetRequest budget = {};
  std::vector<scene::LightGroup> light_groups = {};
  /// One light group for each light instance and the environment if neither the scene nor
  /// light_groups have any.
  bool group_lights = false;
  bool dragging = false;  ///< pictures stay reduced
};

/// Size of the picture that is divided by `divider`.
std::array<int, 2> reduced_size(int width, int height, int divider);

/// The part of a reduced picture that shows the region, as a window from the lower left.
Window reduced_window(const std::optional<std::array<int, 4>>& region, int divider, int width,
                      int height);

}  // namespace oriel::interactive
