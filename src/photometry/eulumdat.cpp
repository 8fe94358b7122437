// SPDX-License-Identifier: Apache-2.0
#include "photometry/eulumdat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace oriel::photometry {
namespace {

constexpr const char* kDamaged =
    "the file is damaged or truncated: obtain it again from the manufacturer";

/// Reads one field per line.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    if (rest_.substr(0, 3) == "\xef\xbb\xbf") rest_.remove_prefix(3);
  }
  int line() const { return line_; }

  std::string text(const char* what) {
    if (rest_.empty())
      throw ProfileError(line_, fmt::format("the file ends before {}", what), kDamaged);
    ++line_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string field = clean_text(rest_.substr(0, end));
    const bool both = rest_.substr(end, 2) == "\r\n";
    rest_.remove_prefix(std::min(rest_.size(), end + (both ? 2 : 1)));
    return field;
  }
  void skip(int count, const char* what) {
    for (int i = 0; i < count; ++i) text(what);
  }
  double number(const char* what) {
    const std::string field = text(what);
    const auto value = parse_number(field, true);
    if (!value)
      throw ProfileError(line_, fmt::format("found \"{}\" where {} is expected", field, what),
                         "each line contains one value: check for a missing or extra line");
    return *value;
  }
  /// An empty line returns `missing`.
  double number_or(const char* what, double missing) {
    const std::string field = text(what);
    return field.empty() ? missing : parse_number(field, true).value_or(missing);
  }
  int whole(const char* what, int least, int most) {
    const double value = number(what);
    return whole_number(value, line_, what, least, most,
                        "this may not be an EULUMDAT file; use `format ies` for IES files");
  }

 private:
  std::string_view rest_;
  int line_ = 0;
};

constexpr const char* kSymmetries[] = {
    "none", "rotational", "two equal halves, on both sides of C0 - C180",
    "two equal halves, on both sides of C90 - C270", "four equal quadrants"};

/// Number of planes (of Mc) that a file of that symmetry stores.
int stored_planes(int symmetry, int planes) {
  switch (symmetry) {
    case 1:
      return 1;
    case 2:
    case 3:
      return planes / 2 + 1;
    case 4:
      return planes / 4 + 1;
    default:
      return planes;
  }
}

Planes whole_circle(const Planes& stored, std::size_t cones, int symmetry) {
  switch (symmetry) {
    case 2:
      return mirror_planes(stored, cones, 0);
    case 3:
      return mirror_planes(stored, cones, 90);
    case 4:
      return mirror_planes(mirror_planes(stored, cones, 0), cones, 90);
    default:
      return close_circle(stored, cones);
  }
}

/// Reads the lamp sets; returns the flux of the first one in lm.
double read_lamps(Lines& in, ProfileReport& report) {
  const int sets = in.whole("the number of sets of lamps", 1, 20);
  double flux = 0;
  for (int s = 0; s < sets; ++s) {
    const double lamps = in.number_or("the number of lamps", 1);
    const std::string lamp = in.text("the type of lamps");
    const double lumens = in.number("the flux of the lamps");
    if (s == 0 && !(lumens > 0 && lumens <= 1e9))
      throw ProfileError(in.line(), fmt::format("the flux of the lamps is {} lm", lumens),
                         "intensities are stored per 1000 lm, so the flux must be above 0");
    in.skip(2, "colour and colour rendering");
    const double watts = in.number_or("the watts", 0);
    if (s > 0) continue;
    flux = lumens;
    report.lamps = static_cast<int>(std::clamp(std::abs(lamps), 0.0, 1e6));
    report.lamp = lamp;
    report.watts = static_cast<float>(watts);
    if (lamps >= 0) report.lamp_lumens = static_cast<float>(lumens);
    // A negative number of lamps means absolute photometry: the luminaire as a whole was measured.
  }
  if (sets > 1)
    report.notes.push_back(fmt::format("it lists {} sets of lamps; the first one is used", sets));
  return flux;
}

}  // namespace

ProfileData parse_eulumdat(std::string_view text) {
  ProfileData data;
  ProfileReport& report = data.report;
  report.format = "EULUMDAT";
  Lines in(text);
  report.manufacturer = in.text("the company");
  in.number("the type of luminaire (Ityp)");
  int symmetry = in.whole("the symmetry (Isym)", 0, 4);
  const int planes = in.whole("the number of C planes (Mc)", 0, kMaxAngles);
  in.text("the distance of C planes");
  const int cones = in.whole("the number of angles of a plane (Ng)", 2, kMaxAngles);
  in.text("the distance of angles");
  in.text("the report number");
  report.luminaire = in.text("the luminaire's name");
  in.skip(3, "the luminaire's number, file and date");
  in.skip(9, "the luminaire's sizes");
  in.skip(2, "the downward flux and output ratio");
  const double conversion = in.number_or("the conversion factor", 1);
  if (!(conversion > 0 && conversion <= 1e9))
    throw ProfileError(in.line(), fmt::format("the conversion factor is {}", conversion),
                       "it must be above 0 and is usually 1");
  in.text("the tilt of the measurement");
  const double flux = read_lamps(in, report);
  in.skip(10, "the direct ratios");

  if (planes <= 1) symmetry = 1;
  if ((symmetry == 2 || symmetry == 3) ? planes % 2 != 0 : symmetry == 4 && planes % 4 != 0)
    throw ProfileError(
        4, fmt::format("{} C planes are inconsistent with symmetry {}", planes, symmetry),
        "Isym 2 and 3 require an even number, Isym 4 a multiple of 4");
  std::vector<int> c_lines, g_lines, lines;
  std::vector<float> c = read_numbers(in, planes, "a C angle", c_lines);
  const std::vector<float> gamma = read_numbers(in, cones, "an angle gamma", g_lines);
  expect_ascending(gamma, g_lines, "gamma", 0, 180);
  if (symmetry != 1) expect_ascending(c, c_lines, "C", 0, 360);
  const int stored = stored_planes(symmetry, planes);
  if (std::int64_t{stored} * cones > kMaxIntensities)
    throw ProfileError(4, fmt::format("the file declares {} x {} intensities", stored, cones),
                       fmt::format("the maximum is {}", kMaxIntensities));
  // Isym 3 stores planes from C90 on.
  std::size_t first = 0;
  if (symmetry == 3)
    while (first + 1 < c.size() && c[first] < 90 - 0.05f) ++first;
  const auto count = static_cast<std::size_t>(stored);
  if (symmetry == 1) {
    c.assign(1, 0.0f);
  } else if (first + count > c.size()) {
    throw ProfileError(c_lines.front(), "the C angles are inconsistent with the symmetry",
                       "list all Mc angles of the circle, starting at 0");
  } else {
    c = std::vector<float>(c.begin() + static_cast<std::ptrdiff_t>(first),
                           c.begin() + static_cast<std::ptrdiff_t>(first + count));
  }
  std::vector<float> candela = read_numbers(in, stored * cones, "an intensity", lines);
  scale_candela(candela, lines, flux / 1000 * conversion);

  report.symmetry = kSymmetries[symmetry];
  Planes circle = whole_circle({std::move(c), std::move(candela)}, gamma.size(), symmetry);
  // C0 is across the luminaire, at -y; C90 is along it, at +x.
  data.table = {{Vec3(0, 0, -1), Vec3(0, -1, 0), Vec3(1, 0, 0)},
                gamma,
                std::move(circle.azimuth),
                std::move(circle.candela)};
  return data;
}

}  // namespace oriel::photometry
