// SPDX-License-Identifier: Apache-2.0
#include "photometry/profile_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "base/input_files.h"
#include "photometry/eulumdat.h"
#include "photometry/ies.h"

namespace oriel::photometry {
namespace {

/// Upper bound on plausible intensities: the largest searchlights reach 1e9 cd.
constexpr double kMaxCandela = 1e12;
/// Planes with a smaller difference in degrees are identical.
constexpr float kSamePlane = 1e-3f;

std::string read_text(OpenFile& file) {
  if (file.fault() == OpenFile::Fault::NotRegular)
    throw ProfileError(0, file.reason(), "name a photometric file (.ies or .ldt)");
  if (file.is_refused()) throw ProfileError(0, file.reason(), file.hint());
  if (!file)
    throw ProfileError(0, "the file does not exist or is not readable",
                       "check the file name and folder");
  note_input_file(file.path(), InputKind::Frame);
  std::string text = file.read(kMaxProfileBytes + 1);
  if (text.size() > kMaxProfileBytes)
    throw ProfileError(0, fmt::format("it is larger than {} MB", kMaxProfileBytes >> 20),
                       "photometric files are much smaller; check the file");
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw ProfileError(0, "it is empty", "save or download it again");
  return text;
}

ProfileFormat format_of(std::string_view text) {
  const auto begins = [&](std::string_view with) { return text.substr(0, with.size()) == with; };
  if (begins("\xef\xbb\xbf")) text.remove_prefix(3);
  if (begins("IES") || text.find("TILT") != std::string_view::npos) return ProfileFormat::Ies;
  return ProfileFormat::Eulumdat;
}

}  // namespace

ProfileData read_profile(const std::string& path, ProfileFormat format, Turn turn) {
  OpenFile file = open_regular(path);
  return read_profile(file, format, turn);
}

ProfileData read_profile(OpenFile& file, ProfileFormat format, Turn turn) {
  const std::string text = read_text(file);
  if (format == ProfileFormat::ByContent) format = format_of(text);
  ProfileData data =
      format == ProfileFormat::Ies
          ? parse_ies(text, std::filesystem::path(file.path()).parent_path().string())
          : parse_eulumdat(text);
  // Seen from above, azimuths are clockwise in types A and B and counter-clockwise in type C.
  const Turn natural = data.report.type == 'C' ? Turn::CounterClockwise : Turn::Clockwise;
  if (turn != Turn::AsFormat && turn != natural) {
    // Reversing the orientation mirrors the luminaire along its length.
    PolarFrame& f = data.table.frame;
    for (Vec3* axis : {&f.pole, &f.zero, &f.side}) axis->y = -axis->y;
  }
  return data;
}

std::string clean_text(std::string_view text) {
  constexpr std::size_t kLongest = 120;
  std::string clean;
  for (const char c : text.substr(0, kLongest)) {
    const bool control = static_cast<unsigned char>(c) < 32 || c == 127;
    clean += control ? ' ' : c;
  }
  const std::size_t first = clean.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return clean.substr(first, clean.find_last_not_of(' ') - first + 1);
}

int whole_number(double value, int line, const char* what, int least, int most, const char* hint) {
  if (value != std::floor(value) || value < least || value > most)
    throw ProfileError(
        line, fmt::format("{} is {}, not a whole number of {} ... {}", what, value, least, most),
        hint);
  return static_cast<int>(value);
}

std::optional<double> parse_number(std::string_view text, bool decimal_commas) {
  constexpr std::size_t kLongest = 64;
  if (text.size() > kLongest) return std::nullopt;
  std::string digits(text);
  if (decimal_commas) std::replace(digits.begin(), digits.end(), ',', '.');
  const bool plus = digits.size() > 1 && digits[0] == '+' && digits[1] != '-';
  const char* first = digits.data() + (plus ? 1 : 0);
  const char* last = digits.data() + digits.size();
  double value = 0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

void scale_candela(std::vector<float>& candela, const std::vector<int>& lines, double factor) {
  for (std::size_t i = 0; i < candela.size(); ++i) {
    const double value = double{candela[i]} * factor;
    if (candela[i] < 0)
      throw ProfileError(lines[i], fmt::format("negative intensity ({} cd)", candela[i]),
                         "correct the file: intensities must not be negative");
    if (!(value <= kMaxCandela))
      throw ProfileError(lines[i], fmt::format("implausible intensity of {:.3g} cd", value),
                         "check the multiplier and factors");
    candela[i] = static_cast<float>(value);
  }
  if (std::all_of(candela.begin(), candela.end(), [](float c) { return c == 0; }))
    throw ProfileError(0, "all intensities are 0", "the luminaire emits no light; check the file");
}

void expect_ascending(const std::vector<float>& angles, const std::vector<int>& lines,
                      const char* kind, float least, float most) {
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (angles[i] < least - kSamePlane || angles[i] > most + kSamePlane)
      throw ProfileError(
          lines[i],
          fmt::format("{} angle {} is outside of {} ... {} degrees", kind, angles[i], least, most),
          "correct the angle or the preceding counts");
    if (i > 0 && !(angles[i] > angles[i - 1]))
      throw ProfileError(lines[i],
                         fmt::format("{} angle {} follows {}, but angles must be ascending", kind,
                                     angles[i], angles[i - 1]),
                         "list each angle once in ascending order; check the preceding counts");
  }
}

Planes mirror_planes(const Planes& planes, std::size_t cones, float about) {
  Planes both = planes;
  for (std::size_t p = 0; p < planes.azimuth.size(); ++p) {
    both.azimuth.push_back(2 * about - planes.azimuth[p]);
    const auto first = planes.candela.begin() + static_cast<std::ptrdiff_t>(p * cones);
    both.candela.insert(both.candela.end(), first, first + static_cast<std::ptrdiff_t>(cones));
  }
  return close_circle(both, cones);
}

Planes close_circle(const Planes& planes, std::size_t cones) {
  std::vector<float> azimuth = planes.azimuth;
  for (float& a : azimuth) {
    a -= 360 * std::floor(a / 360);
    if (a > 360 - kSamePlane) a = 0;
  }
  std::vector<std::size_t> order(azimuth.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return azimuth[a] < azimuth[b]; });
  Planes circle;
  const auto add = [&](float at, std::size_t plane) {
    circle.azimuth.push_back(at);
    const auto first = planes.candela.begin() + static_cast<std::ptrdiff_t>(plane * cones);
    circle.candela.insert(circle.candela.end(), first, first + static_cast<std::ptrdiff_t>(cones));
  };
  for (const std::size_t p : order)
    if (circle.azimuth.empty() || azimuth[p] - circle.azimuth.back() > kSamePlane)
      add(azimuth[p], p);
  add(circle.azimuth.front() + 360, order.front());
  return circle;
}

}  // namespace oriel::photometry
