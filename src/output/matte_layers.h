// SPDX-License-Identifier: Apache-2.0
// Matte layers: Cryptomattes of objects, materials and assets; labels and coverage.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "image/pixel_buffer.h"
#include "render/session.h"
#include "scene/scene.h"

namespace oriel {

/// Names of the instances of the world.
///
/// Model:   the asset, shared by all instances of an object element, is the name of that element.
///          The object name is the name of the instance without the suffix `_inst` or `_inst_N`
///          that exporters add. The pieces of a mesh that was split by material thus share a name.
///          If two instances of one element would share a name, all instances keep their full
///          names.
/// Checked: Mattes.ObjectNames*
MatteNames matte_names(const scene::Scene& scene, const World& world, int depth);

/// CryptoObject00, 01..., CryptoMaterial00..., CryptoAsset00..., as many as depth requires (two
/// ranks each); channels r, g, b, a. Empty if the session stores no mattes.
///
/// Model:   the shares of Mattes, merged by name. The background has id 0, so all ranks of a pixel
///          sum to 1 if there are no more names than ranks.
/// Checked: Mattes.* in mattes_test.cpp
std::vector<Layer> cryptomatte_layers(const RenderSession& session);
std::map<std::string, std::string> cryptomatte_metadata(const RenderSession& session);

/// Writes the label and the coverage of the instance that covers most of film pixel (x, y); 0 for
/// background. Requires a session with mattes.
void write_label(const RenderSession& session, int x, int y, float* to);
void write_coverage(const RenderSession& session, int x, int y, float* to);

}  // namespace oriel
