// SPDX-License-Identifier: Apache-2.0
// Options block as typed values with the documented defaults.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/elements.h"
#include "scene/light_group.h"
#include "scene/statement_table.h"

namespace oriel::scene {

// Conventions
//   A sampling level n is 4^n samples per pixel; a negative level is one sample per block of
//   pixels. Radii are in scene units, or in pixels if a flag is set; 0: chosen from the scene.
//   Where sources disagree about a default, the C interface takes precedence over host
//   applications.

/// Pixel filters, in the order of the keyword table.
enum class FilterKind : std::uint8_t {
  Box,
  Triangle,
  Gauss,
  Mitchell,
  Lanczos,
  ClipMitchell,
  ClipLanczos
};
/// Default full width in pixels: 1, 2, 3, 4, 4.
float default_filter_width(FilterKind kind);

struct PixelFilter {
  FilterKind kind = FilterKind::Box;
  float width = 1, height = 1;  ///< full extent, pixels
  bool operator==(const PixelFilter&) const = default;
};

/// Maximum number of reflections, refractions, and both in total.
struct TraceDepth {
  int reflection = 1, refraction = 1, sum = 1;
  bool operator==(const TraceDepth&) const = default;
};

enum class ShadowMode : std::uint8_t { Off, Simple, Sort, Segments };
enum class Face : std::uint8_t { Front, Back, Both };
enum class ColorClip : std::uint8_t { Rgb, Alpha, Raw };
enum class Space : std::uint8_t { Object, Camera, Mixed, World };
/// `lightmap`, `shadowmap`: off, on, or compute only the map. OpenGL and Detail: kinds of shadow
/// maps.
enum class MapMode : std::uint8_t { Off, On, Only, OpenGl, Detail };
/// Method for indirect light. Scene: chosen by the photon and final gathering statements.
enum class IndirectMethod : std::uint8_t {
  Scene,
  Path,
  PathCache,
  FinalGather,
  Photons,
  FinalGatherPhotons
};

/// `caustic ...`, `globillum ...` or `photonvol ...`.
struct PhotonOptions {
  bool on = false;
  std::optional<int> object_flags;  ///< bits 1 cast, 2 receive; 4 and 8 clear them
  int accuracy = 64;                ///< photons per estimate
  float radius = 0;
  enum class Filter : std::uint8_t { Box, Cone, Gauss } filter = Filter::Box;
  float filter_constant = 1.1f;
  Rgba scale{1, 1, 1, 1};
  float merge = 0;  ///< photons within this distance are merged
  bool operator==(const PhotonOptions&) const = default;
};

struct FinalGatherOptions {
  bool on = false, only = false, fast_lookup = false;
  enum class Mode : std::uint8_t { Automatic, Multiframe, Radius, StrictRadius };
  Mode mode = Mode::Automatic;  ///< "automatic", "multiframe", "3.4", "strict 3.4"
  /// Defaults of host applications are 100, 250, 500 and 1000. 400 rays avoid splotches in a room
  /// lit by a window (FinalGather.LeavesNoSplotches*).
  int rays = 400;
  int points = 10;  ///< interpolated points
  bool radius_in_pixels = false;
  float max_radius = 0, min_radius = 0;
  /// `diffuse`: diffuse bounces after the first surface that a ray hits.
  struct Depth {
    int reflection = 1, refraction = 1, diffuse = 0, sum = 2;
    bool operator==(const Depth&) const = default;
  };
  /// Unset: if the scene enables final gathering, Depth{}; if the method was chosen by name, the
  /// trace depth of the image and unlimited diffuse bounces, as for the other methods.
  std::optional<Depth> depth;
  float presample_density = 1;
  int filter = 0;                             ///< median over rays; 0 = none
  float falloff_start = 0, falloff_stop = 0;  ///< range of the rays; both 0 = unlimited
  float normal_tolerance = 0;                 ///< degrees; 0 = default of the method
  Rgba scale{1, 1, 1, 1}, secondary_scale{1, 1, 1, 1};
  std::vector<std::string> files;
  enum class Rebuild : std::uint8_t { Off, On, Freeze } rebuild = Rebuild::On;
  bool operator==(const FinalGatherOptions&) const = default;
};

struct MotionOptions {
  bool on = false;  ///< set explicitly, or by a shutter time
  int steps = 1;
  float delay = 0, shutter = 0;  ///< the shutter is open in [delay, shutter], fractions of a frame
  bool operator==(const MotionOptions&) const = default;
};

/// `frame buffer N "type"`: a numbered buffer for shaders.
struct UserFrameBuffer {
  int index = 0;
  std::string type;         ///< without the sign
  bool interpolate = true;  ///< false for a leading minus
  bool operator==(const UserFrameBuffer&) const = default;
};

/// A statement that was read but has no effect on the image.
struct WithoutEffect {
  std::string keyword;
  Support support = Support::Uninterpreted;
  SourceLocation where;
  bool operator==(const WithoutEffect&) const = default;
};

/// The settings of an options block. The default-constructed value is that of an empty block.
struct RenderOptions {
  int samples_min = -2, samples_max = 0;
  Rgba contrast{0.1f, 0.1f, 0.1f, 0.1f}, time_contrast{0.2f, 0.2f, 0.2f, 0.2f};
  bool contrast_all_buffers = false;
  bool unified_sampling = true;  ///< off: string options "samples ..." have no effect
  PixelFilter filter;
  float jitter = 0;        ///< 0: none, 1: the whole cell
  bool samplelock = true;  ///< same pattern in every frame
  int task_size = 0;

  bool trace = true;  ///< off: no secondary rays
  TraceDepth trace_depth;
  ShadowMode shadow = ShadowMode::Simple;
  MapMode shadowmap = MapMode::Off;
  Face face = Face::Both;
  Space space = Space::Object;
  float max_displace = 0;
  MotionOptions motion;

  bool lens = true, volume = true, geometry = true, output = true, displace = true, merge = true,
       hair = true, pass = true, autovolume = false, photon_autovolume = false,
       displace_presample = true;
  MapMode lightmap = MapMode::On;

  PhotonOptions caustic, globillum, photonvol{false, std::nullopt, 30};
  TraceDepth photon_depth{5, 5, 5};
  std::string photonmap_file;
  bool photonmap_rebuild = true, photonmap_only = false;
  FinalGatherOptions finalgather;
  IndirectMethod indirect = IndirectMethod::Scene;
  bool guiding = true;  ///< paths may learn directions; see DirectionGuide

  float gamma = 1;
  bool desaturate = false, dither = false, premultiply = true;
  ColorClip colorclip = ColorClip::Raw;
  Rgb luminance_weight{0.212671f, 0.715160f, 0.072169f};  ///< Rec. 709, as documented
  std::vector<UserFrameBuffer> frame_buffers;
  std::vector<LightGroup>
      light_groups;  ///< `"light group NAME" "PATTERN,..."`; layers of EXR files

  static constexpr int kDefaultMatteRanks = -1;
  int matte_ranks = 0;  ///< names per pixel in Cryptomatte layers; 0: no such layers

  std::vector<WithoutEffect> without_effect;  ///< one entry per keyword, with its last location
  std::vector<std::string> unknown_strings;   ///< unknown string options, each once

  /// Method of indirect light, and whether there are caustics.
  struct IndirectChoice {
    IndirectMethod method;
    bool caustics;
  };
  /// Paths alone, for which glass passes light straight: for quick pictures and for sensors, which
  /// have no photons. Returns what was chosen.
  IndirectChoice choose_paths_alone() {
    const IndirectChoice chosen{indirect, caustic.on};
    choose({IndirectMethod::Path, false});
    return chosen;
  }
  void choose(const IndirectChoice& choice) {
    indirect = choice.method;
    caustic.on = choice.caustics;
  }
  /// Whether a method was chosen that traces paths in place of gather points and global photons.
  bool traces_paths() const {
    return indirect == IndirectMethod::Path || indirect == IndirectMethod::PathCache;
  }

  bool operator==(const RenderOptions&) const = default;
};

/// Interprets the statements in order; later ones override earlier ones.
///
/// Errors:  OR-SC-101 invalid values (the statement is skipped), OR-SC-102 unknown statement,
///          OR-SC-103 a known string option with invalid values, OR-SC-104 an invalid light group.
/// Source:  reference of the language, section Options; the table is in option_table.cpp.
/// Checked: render_options_test.cpp
RenderOptions interpret_options(const Options& options, Diagnostics& diagnostics);

}  // namespace oriel::scene
