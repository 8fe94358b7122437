// SPDX-License-Identifier: Apache-2.0
// The settings of the session of one frame, by its files and options.
#pragma once

#include <vector>

namespace oriel {
class Diagnostics;
struct World;
struct OutputRoots;
struct PictureFile;
struct SessionSettings;
namespace scene {
struct RenderCommand;
class Scene;
}  // namespace scene
}  // namespace oriel

namespace oriel::app {

struct RenderArguments;
struct RenderPlan;

/// A frame whose world and files are known.
struct FrameToRender {
  const RenderArguments& arguments;
  const RenderPlan& plan;
  const scene::Scene& scene;
  const World& world;
  const std::vector<PictureFile>& files;
  const OutputRoots& roots;
  Diagnostics& diagnostics;
};

/// The settings of the session. Reports requests that the frame cannot fulfil.
/// Outputs: unit_is_known: whether cd/m2 of a pixel unit are known.
SessionSettings frame_settings(const FrameToRender& frame, bool& unit_is_known);

/// Whether the pixels stay within their budget; else an error is reported (OR-RN-082).
bool fits_budget(const FrameToRender& frame, const scene::RenderCommand& command,
                 const SessionSettings& settings);

/// Whether a file has layers in lux or cd/m2.
bool has_photometric_layers(const std::vector<PictureFile>& files);

}  // namespace oriel::app
