// SPDX-License-Identifier: Apache-2.0
// Photometric files of either format: metadata and errors.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_access.h"
#include "photometry/light_profile.h"

namespace oriel::photometry {

/// Error of a profile: the problem, its line, and a hint.
struct ProfileError : std::runtime_error {
  ProfileError(int at, const std::string& what, std::string advice)
      : std::runtime_error(what), line(at), hint(std::move(advice)) {}
  int line;  ///< from 1; 0 = the whole file
  std::string hint;
};

/// Metadata of a file. Texts are shortened and free of control characters.
struct ProfileReport {
  std::string format;   ///< "IES" or "EULUMDAT"
  std::string version;  ///< "LM-63-2002"; empty for EULUMDAT
  char type = 'C';      ///< type of photometry: C, B or A
  std::string symmetry;
  int lamps = 1;
  /// Flux of all lamps in lm; unset in absolute photometry.
  std::optional<float> lamp_lumens;
  float watts = 0;
  std::string luminaire, lamp, manufacturer;
  std::vector<std::string> notes;  ///< deviations from the content of the file
};

struct ProfileData {
  CandelaTable table;
  ProfileReport report;
};

enum class ProfileFormat : std::uint8_t { ByContent, Ies, Eulumdat };
/// Orientation of azimuths around the luminaire; the scene may override that of the format.
enum class Turn : std::uint8_t { AsFormat, Clockwise, CounterClockwise };

/// Reads a file of at most kMaxProfileBytes.
///
/// Errors:  ProfileError.
/// Checked: IesFile.*, EulumdatFile.*, ProfileFile.*
ProfileData read_profile(const std::string& path, ProfileFormat format = ProfileFormat::ByContent,
                         Turn turn = Turn::AsFormat);
/// Reads an opened file, with its TILT file in the same folder. If opening failed, the error has
/// the reason.
ProfileData read_profile(OpenFile& file, ProfileFormat format, Turn turn);

inline constexpr std::size_t kMaxProfileBytes = std::size_t{16} << 20;
/// Maximum number of angles in one direction, and of intensities in total.
inline constexpr int kMaxAngles = 10000, kMaxIntensities = 2'000'000;

// Functions for the parsers of both formats.

/// A line trimmed to a readable length, without control characters and surrounding blanks.
std::string clean_text(std::string_view text);
/// A finite number that spans the whole text; optionally with a decimal comma.
std::optional<double> parse_number(std::string_view text, bool decimal_commas = false);
/// Returns `value` if it is an integer in least ... most; throws with `hint` otherwise.
int whole_number(double value, int line, const char* what, int least, int most, const char* hint);
/// Reads `count` numbers from a reader with number() and line(); `lines` gets the line of each.
template <class Reader>
std::vector<float> read_numbers(Reader& in, int count, const char* what, std::vector<int>& lines) {
  std::vector<float> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(static_cast<float>(std::clamp(in.number(what), -1e30, 1e30)));
    lines.push_back(in.line());
  }
  return values;
}
/// Validates and scales intensities. `lines`: line number of each.
void scale_candela(std::vector<float>& candela, const std::vector<int>& lines, double factor);
/// Throws unless the angles are ascending and within least ... most.
void expect_ascending(const std::vector<float>& angles, const std::vector<int>& lines,
                      const char* kind, float least, float most);

/// Planes of the full circle, expanded from those that a symmetric file stores.
struct Planes {
  std::vector<float> azimuth, candela;
};
/// Adds the mirror image of each plane at 2 * about - azimuth, maps all to 0 ... 360 and closes the
/// circle.
Planes mirror_planes(const Planes& planes, std::size_t cones, float about);
/// All planes sorted from 0, with the first one repeated at 360.
Planes close_circle(const Planes& planes, std::size_t cones);

}  // namespace oriel::photometry
