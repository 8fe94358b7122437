// SPDX-License-Identifier: Apache-2.0
// What pixels see first, as layers: Cryptomattes of objects, materials and assets, labels,
// coverage.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "image/pixel_buffer.h"
#include "render/session.h"
#include "scene/scene.h"

namespace oriel {

/// Of the instances of the world, as the scene has them. An object is an instance's name; the
/// asset, which all instances of it share, that of its object element.
MatteNames matte_names(const scene::Scene& scene, const World& world, int depth);

/// CryptoObject00, 01..., CryptoMaterial00..., CryptoAsset00..., as many as depth asks for (two
/// ranks each); channels r, g, b, a. None where the session keeps no mattes.
///
/// Model:   what Mattes keeps, by name: names that are the same are one. Where nothing is seen the
///          id is 0, so that all ranks of a pixel sum to 1 where there are no more names than
///          ranks.
/// Checked: Mattes.* in mattes_test.cpp
std::vector<Layer> cryptomatte_layers(const RenderSession& session);
std::map<std::string, std::string> cryptomatte_metadata(const RenderSession& session);

/// The label of the instance that covers most of film pixel (x, y), and its share; 0 where that is
/// nothing. Only of sessions with mattes.
void write_label(const RenderSession& session, int x, int y, float* to);
void write_coverage(const RenderSession& session, int x, int y, float* to);

}  // namespace oriel
