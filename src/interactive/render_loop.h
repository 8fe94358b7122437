// SPDX-License-Identifier: Apache-2.0
// Renders an edited scene: reduced pictures first, then the final one, again after each change.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "interactive/picture.h"
#include "interactive/prepared_scene.h"
#include "interactive/view_settings.h"
#include "render/session.h"

namespace oriel::interactive {

enum class LoopState : std::uint8_t { Loading, Preparing, Rendering, Converged, Failed };

/// Where a loop is.
struct LoopStatus {
  LoopState state = LoopState::Loading;
  std::uint32_t epoch = 0;
  int divider = 1;  ///< of the running picture
  Progress progress;
  std::size_t messages = 0;       ///< of the scene, also those of shaders while they render
  std::optional<double> latency;  ///< seconds from the last change to its first picture
};

/// Settings that do not change.
struct LoopSettings {
  std::uint32_t seed = 0;
  float clamp = 0;
  int first_divider =
      8;  ///< of the first picture after a change, unless it is slow; a power of two
  int least_long_side = 128;  ///< pixels of that picture; half of it if it is slow
};

/// Renders a scene on the calling thread.
///
/// Model:   each change starts an epoch. Its pictures are of 1/8, 1/4 and 1/2 of the size with one
///          sample, path traced, then of full size; where the last of these pictures show that the
///          first would take longer than kFirstPictureSeconds, it is reduced further. If caches or
///          what paths learn have to be computed, a draft of full size without them comes before;
///          they stay for changes of the film alone, such as other layers. The full-size
///          session is that of `oriel render`
///          with the same seed and budget, so its result has the same bytes; it is continued after
///          interruptions without a change. Its passes start with the tiles near the pointer.
/// Checked: EditTable.*, RenderLoopTest.* in tests/interactive
class RenderLoop {
 public:
  using Show = std::function<void(std::shared_ptr<const Picture>)>;
  using Notify = std::function<void()>;

  /// `show` gets each new picture, `changed` is called when status() changes; both from any thread
  /// that renders.
  RenderLoop(SceneSource source, const LoopSettings& settings, Show show, Notify changed = {});

  /// Reads the scene, again if it was read; without edits.
  bool read();
  /// Replaces the edits. Errors: EditError; the scene is then unchanged.
  void set_edits(const std::vector<std::string>& edits);
  void set_view(const ViewSettings& view);
  const ViewSettings& view() const { return view_; }

  /// Renders until the picture is finished or `cancel` becomes true.
  /// Returns: whether there is nothing left to do before the next change.
  bool run(const std::atomic<bool>& cancel);

  /// Whether run() computes the caches of indirect light of the full-size session. Meanwhile other
  /// threads may read scene(), but neither session() nor diagnostics(). From any thread.
  bool computes_caches() const { return computes_caches_; }
  /// Sets what run() calls when the caches are complete or cancelled, after computes_caches() has
  /// become false and before anything else changes.
  void on_caches_end(Notify end) { caches_end_ = std::move(end); }

  PreparedScene& scene() { return scene_; }
  /// The full-size session; null before it starts.
  const RenderSession* session() const { return session_ ? &*session_ : nullptr; }
  /// Brings geometry, shaders and camera of the world up to date without rendering. False: it
  /// cannot be rendered.
  bool prepare();
  /// The same with the light sampler, which measurements of light need.
  bool prepare_completely();
  /// From any thread.
  LoopStatus status() const;
  /// The pixel of the full-size picture, from the upper left, near which the picture refines first;
  /// unset: everywhere alike. Changes nothing of the finished picture. From any thread.
  void set_pointer(const std::optional<std::array<int, 2>>& pixel);
  /// The epoch of the next picture.
  std::uint32_t next_epoch() const;
  const Diagnostics& diagnostics() const { return diagnostics_; }
  /// Size of the full picture without the resolution scale.
  std::array<int, 2> full_size() const;
  /// Pixels of the rendered picture for a pixel of the full-size picture.
  std::array<int, 2> scaled_pixel(int x, int y) const;
  SessionSettings session_settings(int divider) const;

 private:
  using Clock = std::chrono::steady_clock;
  std::array<int, 2> scaled_size() const;
  /// As in PrepareOptions: 0 0 = from the camera, whose aspect is then not rounded.
  std::array<int, 2> requested_size() const;
  void change(const EditEffects& effects);
  void set_state(LoopState state);
  void set_progress(const Progress& progress, int divider);
  /// While no shader runs.
  void count_messages();
  int start_divider() const;
  bool run_preview(const std::atomic<bool>& cancel);
  bool run_draft(const std::atomic<bool>& cancel);
  bool run_final(const std::atomic<bool>& cancel);
  void make_session();
  void end_caches();
  /// Callback of passes, see Progressive.
  void render_tiles(const std::vector<int>& tiles, const std::function<void(int)>& render_tile);
  void copy_picture(const RenderSession& session, int divider, bool preview, bool final = false);
  /// Whether a copy has its denoised layer denoised.
  bool denoises(const RenderSession& session, bool preview, bool final) const;
  bool is_copy_due() const;

  Diagnostics diagnostics_;
  PreparedScene scene_;
  LoopSettings settings_;
  Show show_;
  Notify changed_, caches_end_;
  std::atomic<bool> computes_caches_ = false;
  ViewSettings view_;
  EditEffects pending_;
  std::optional<RenderSession> session_;
  RenderSession::Preparation preparation_;  ///< of a former session, for the same world
  double draft_samples_ = 0;                ///< per pixel of the full-size draft; 0 = there is none
  int next_divider_ = 1;
  bool finished_ = false;
  bool prepared_ = false;
  bool first_picture_ = true;
  std::uint64_t pictures_ = 0;
  Clock::time_point changed_at_ = Clock::now();
  std::atomic<double> last_copy_ = 0;  ///< seconds after changed_at_
  double copy_seconds_ = 0;
  double denoise_seconds_ = 0;        ///< of the last copy that was denoised
  double reduced_pixel_seconds_ = 0;  ///< time for a pixel of a reduced picture; 0 = unknown
  mutable std::mutex mutex_;
  LoopStatus status_;                               // guarded by mutex_
  std::optional<std::array<int, 2>> pointer_ = {};  // likewise
};

}  // namespace oriel::interactive
