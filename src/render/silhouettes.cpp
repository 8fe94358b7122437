// SPDX-License-Identifier: Apache-2.0
#include "render/silhouettes.h"

#include "base/parallel.h"
#include "runtime/environment_ray.h"
#include "transport/path/path.h"

namespace oriel {
namespace {

bool sees_black(const World& world, Vec2 raster) {
  if (world.environment.empty()) return true;
  const Camera::Ray eye = world.camera.ray(raster);
  return is_black(rgb(
      environment_radiance(world.environment, world,
                           {.origin = eye.origin, .direction = eye.direction, .raster = raster})));
}

/// Whether the environment is black in one of a few camera directions. Most environments are not,
/// and then no further rays are needed. The directions cover the whole picture, so that the result
/// is the same for each part of it.
bool may_see_black(const World& world) {
  constexpr int kSide = 16;
  const Vec2 cell(static_cast<float>(world.camera.width) / kSide,
                  static_cast<float>(world.camera.height) / kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (sees_black(world,
                     cell * Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)))
        return true;
  return false;
}

/// What rays through the centres of pixels meet: those of the window and of a margin of one pixel.
class Centres {
 public:
  Centres(const World& world, const Window& window)
      : world_(world), window_(window), width_(static_cast<std::size_t>(window.width()) + 2) {
    const auto height = static_cast<std::size_t>(window.height()) + 2;
    met_.resize(width_ * height);
    parallel_for(height, [&](std::size_t y) {
      for (std::size_t x = 0; x < width_; ++x)
        met_[y * width_ + x] = meets_object(world_, world_.camera.ray(raster(x, y))) ? 1 : 0;
    });
  }

  /// Inputs:  x, y: pixel of the window, from its top left.
  bool are_before_black(std::size_t x, std::size_t y) const {
    int objects = 0;
    for (std::size_t j = y; j < y + 3; ++j)
      for (std::size_t i = x; i < x + 3; ++i) objects += met_[j * width_ + i];
    if (objects == 0 || objects == 9) return false;
    for (std::size_t j = y; j < y + 3; ++j)
      for (std::size_t i = x; i < x + 3; ++i)
        if (!met_[j * width_ + i] && sees_black(world_, raster(i, j))) return true;
    return false;
  }

 private:
  Vec2 raster(std::size_t x, std::size_t y) const {
    return window_.pixel_centre(static_cast<int>(x) - 1, static_cast<int>(y) - 1);
  }

  const World& world_;
  const Window& window_;
  std::size_t width_;
  std::vector<unsigned char> met_;
};

}  // namespace

Silhouettes::Silhouettes(const World& world, const Window& window)
    : width_(static_cast<std::size_t>(window.width())) {
  if (!may_see_black(world)) return;
  const Centres centres(world, window);
  const auto height = static_cast<std::size_t>(window.height());
  pixels_.resize(width_ * height);
  parallel_for(height, [&](std::size_t y) {
    for (std::size_t x = 0; x < width_; ++x)
      pixels_[y * width_ + x] = centres.are_before_black(x, y) ? 1 : 0;
  });
}

}  // namespace oriel
