// SPDX-License-Identifier: Apache-2.0
// The luminance that a pixel value of 1 stands for, from the statements of a scene.
#pragma once

namespace oriel::scene {
class Scene;
}

namespace oriel::models::gltf {

/// cd/m2 of one pixel unit.
///
/// Model:   `cm2_factor` of a mia_exposure_photographic of a camera; else `rgb_unit_conversion` of
///          a sun or sky, whose value 1 / pi is 1 cd/m2; else 1. Values that are not constant do
///          not count.
/// Source:  manual, photographic exposure; sun and sky.
/// Checked: GltfWrite.LightsHaveTheUnitOfTheScene
float unit_of(const scene::Scene& scene);

}  // namespace oriel::models::gltf
