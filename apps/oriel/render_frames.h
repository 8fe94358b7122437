// SPDX-License-Identifier: Apache-2.0
// A scene to pictures, frame by frame: what both command lines that render share.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "checkpoints.h"
#include "frames.h"
#include "mi/reader.h"
#include "output/camera_output.h"
#include "output/output.h"
#include "prepare/prepare.h"
#include "render/session.h"
#include "scene_file.h"
#include "sky/solar_position.h"

namespace oriel::app {

class PartSet;
class Ranks;

struct RenderArguments {
  SceneArguments scene;
  std::vector<std::string> outputs;
  std::optional<std::uint32_t> samples;
  std::optional<float> noise;
  std::optional<double> time;
  std::string gi, size, crop, camera, layers, sun;
  std::vector<std::string> light_groups;
  std::optional<double> north;
  std::optional<float> unit_luminance;
  std::uint32_t seed = 0;
  std::string cryptomatte;  ///< ranks; empty: as the scene's options say
  int threads = 0;
  std::optional<float> texture_cache;  ///< megabytes
  bool isolate_readers = false;
  std::string frames;
  bool skip_existing = false;
  bool live = false;  ///< passes are written to the files themselves
  bool denoise = false, linear = false, json = false, quiet = false;
  std::string denoiser;  ///< see denoiser_of()
  bool keep_outliers = false, no_guiding = false, even_samples = false;
  float clamp = 0;  ///< SessionSettings::clamp
  std::string exr;  ///< precision and compression of EXR files
  bool timestamps = false;
  std::string checkpoint, resume;  ///< see checkpoint_request()
  bool stop_at_usr1 = false;       ///< SIGUSR1 ends the render after its checkpoint
  std::string part;                ///< K/N
  std::string maps, maps_only;     ///< folders
  int bits = 0;                    ///< per channel of PNG and TIFF files; 0 = their default
};

/// What the arguments mean, checked before anything is read.
struct RenderPlan {
  PrepareOptions prepare;
  SessionSettings session;
  std::optional<LayerSet> layers;
  std::optional<scene::IndirectMethod> gi;
  bool guiding = true;  ///< false: overrides the scene
  std::optional<sky::SolarPosition> sun;
  std::optional<int> matte_ranks;
  std::optional<ExrPrecision> precision;
  std::optional<ExrCompression> compression;
  FrameList frames;
  CheckpointRequest checkpoint;
  std::optional<PicturePart> part;  ///< that is rendered alone
  Ranks* ranks = nullptr;           ///< of the job that renders together; must outlive the plan
  const PartSet* merge = nullptr;   ///< its parts make the pictures; must outlive the plan
  /// Where scenes read maps and write files; unset: in the scene's folder.
  std::optional<OutputRoots> roots;
};

/// Renders those frames that the plan asks for, in order.
///
/// Inputs:  edit: what is done to the scene before each of them.
/// Returns: the exit code. If a signal ended the render: kExitResume if the same command continues
///          it, kExitFailed otherwise.
/// Errors:  UserError when nothing is rendered at all.
/// Checked: tests/cli
int render_frames(mi::Reader& reader, const RenderArguments& arguments, const RenderPlan& plan,
                  const std::function<void(scene::Scene&)>& edit, Diagnostics& diagnostics,
                  DiagnosticPrinter& printer);

}  // namespace oriel::app
