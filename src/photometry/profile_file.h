// SPDX-License-Identifier: Apache-2.0
// Photometric files of either format: what they say beside their table, and how they fail.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "photometry/light_profile.h"

namespace oriel::photometry {

/// A profile that cannot be used: what is wrong, on which line, and what to do.
struct ProfileError : std::runtime_error {
  ProfileError(int at, const std::string& what, std::string advice)
      : std::runtime_error(what), line(at), hint(std::move(advice)) {}
  int line;  ///< from 1; 0 = the file as a whole
  std::string hint;
};

/// What a file says of its luminaire. Texts are cleaned of control characters and short.
struct ProfileReport {
  std::string format;   ///< "IES" or "EULUMDAT"
  std::string version;  ///< "LM-63-2002"; empty for EULUMDAT
  char type = 'C';      ///< photometry: C, B or A
  std::string symmetry;
  int lamps = 1;
  /// Of all lamps, lm; unset in absolute photometry.
  std::optional<float> lamp_lumens;
  float watts = 0;
  std::string luminaire, lamp, manufacturer;
  std::vector<std::string> notes;  ///< what was taken otherwise than it stands
};

struct ProfileData {
  CandelaTable table;
  ProfileReport report;
};

enum class ProfileFormat : std::uint8_t { ByContent, Ies, Eulumdat };
/// How angles run around the luminaire; the file's format says it unless the scene does.
enum class Turn : std::uint8_t { AsFormat, Clockwise, CounterClockwise };

/// Reads a file of at most kMostProfileBytes.
///
/// Errors:  ProfileError.
/// Checked: IesFile.*, EulumdatFile.*, ProfileFile.*
ProfileData read_profile(const std::string& path, ProfileFormat format = ProfileFormat::ByContent,
                         Turn turn = Turn::AsFormat);

inline constexpr std::size_t kMostProfileBytes = std::size_t{16} << 20;
/// Angles in one direction, and intensities in all.
inline constexpr int kMostAngles = 10000, kMostIntensities = 2'000'000;

// For the readers of the formats.

/// A line cut to a readable length, without control characters and blanks around it.
std::string clean_text(std::string_view text);
/// A finite number that fills the whole text; commas count as points when asked.
std::optional<double> parse_number(std::string_view text, bool decimal_commas = false);
/// `value` if it is a whole number of least ... most; `hint`: what to do where it is not.
int whole_number(double value, int line, const char* what, int least, int most, const char* hint);
/// `count` numbers of a reader with number() and line(); `lines`: where each one stands.
template <class Reader>
std::vector<float> read_numbers(Reader& in, int count, const char* what, std::vector<int>& lines) {
  std::vector<float> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(static_cast<float>(std::clamp(in.number(what), -1e30, 1e30)));
    lines.push_back(in.line());
  }
  return values;
}
/// Checks intensities and multiplies them. `lines`: where each one stands.
void scale_candela(std::vector<float>& candela, const std::vector<int>& lines, double factor);
/// Errors unless the angles ascend within least ... most.
void expect_ascending(const std::vector<float>& angles, const std::vector<int>& lines,
                      const char* kind, float least, float most);

/// Planes of the whole circle, from those that a symmetric file stores.
struct Planes {
  std::vector<float> azimuth, candela;
};
/// Adds each plane's image at 2 * about - azimuth, turns all into 0 ... 360 and closes the circle.
Planes mirror_planes(const Planes& planes, std::size_t cones, float about);
/// All planes sorted from 0, with the first one again at 360.
Planes close_circle(const Planes& planes, std::size_t cones);

}  // namespace oriel::photometry
