// SPDX-License-Identifier: Apache-2.0
#include "photometry/ies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "base/input_files.h"

namespace oriel::photometry {
namespace {

constexpr const char* kDamagedIes =
    "the file is damaged or truncated: obtain it again from the manufacturer";

/// Reads the text of a file by lines, then by numbers.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {
    if (rest_.substr(0, 3) == "\xef\xbb\xbf") rest_.remove_prefix(3);
  }
  int line() const { return line_; }
  bool at_end() const { return rest_.empty(); }

  /// The next line; line ends are \n, \r\n or \r.
  std::string_view next_line() {
    ++line_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view text = rest_.substr(0, end);
    const bool both = end + 1 < rest_.size() && rest_[end] == '\r' && rest_[end + 1] == '\n';
    rest_.remove_prefix(std::min(rest_.size(), end + (both ? 2 : 1)));
    return text;
  }

  double number(const char* what) {
    const std::string_view word = next_word();
    if (word.empty())
      throw ProfileError(line_, fmt::format("the file ends before {}", what), kDamagedIes);
    const auto value = parse_number(word);
    if (!value)
      throw ProfileError(line_,
                         fmt::format("found \"{}\" where {} is expected", clean_text(word), what),
                         "write a number there");
    return *value;
  }
  int whole(const char* what, int least, int most) {
    const double value = number(what);
    return whole_number(value, line_, what, least, most,
                        "correct the header, the numbers after the TILT line");
  }

 private:
  std::string_view next_word() {
    while (!rest_.empty()) {
      const std::size_t line_end = rest_.find_first_of("\r\n");
      const std::string_view here = rest_.substr(0, line_end);
      const std::size_t first = here.find_first_not_of(kSeparators);
      if (first != std::string_view::npos) {
        if (!in_line_) ++line_;
        in_line_ = true;
        rest_.remove_prefix(first);
        const std::size_t end = std::min(rest_.find_first_of(kWordEnds), rest_.size());
        const std::string_view word = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return word;
      }
      if (!in_line_) ++line_;
      in_line_ = false;
      if (line_end == std::string_view::npos) {
        rest_ = {};
        break;
      }
      const bool both = rest_.substr(line_end, 2) == "\r\n";
      rest_.remove_prefix(line_end + (both ? 2 : 1));
    }
    return {};
  }

  static constexpr std::string_view kSeparators = " \t,;\f\v\x1a";
  static constexpr std::string_view kWordEnds = " \t,;\f\v\x1a\r\n";
  std::string_view rest_;
  int line_ = 0;
  bool in_line_ = false;  // next_word stopped inside of line_
};

std::string upper(std::string_view text) {
  std::string up(text);
  std::transform(up.begin(), up.end(), up.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return up;
}

struct Version {
  std::string name;
  bool old;  ///< before 2002, when the number after the ballast factor was also a factor
};
Version version_of(std::string_view first_line) {
  const std::string tag = upper(clean_text(first_line));
  if (tag.find("2019") != std::string::npos) return {"LM-63-2019", false};
  if (tag.find("2002") != std::string::npos) return {"LM-63-2002", false};
  if (tag.find("1995") != std::string::npos) return {"LM-63-1995", true};
  if (tag.substr(0, 7) == "IESNA91") return {"LM-63-1991", true};
  if (tag.substr(0, 3) == "IES") return {"LM-63 (" + clean_text(first_line) + ")", false};
  return {"LM-63-1986", true};
}

/// Returns the text after TILT=, and adds the preceding keywords to the report.
std::string read_head(Reader& in, ProfileReport& report, bool& old) {
  bool first = true;
  while (!in.at_end()) {
    const std::string_view line = in.next_line();
    const std::string text = clean_text(line);
    if (first) {
      const Version version = version_of(line);
      report.version = version.name;
      old = version.old;
      first = false;
    }
    if (upper(text.substr(0, 4)) == "TILT") {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos)
        throw ProfileError(in.line(), "the TILT line has no \"=\"", "write TILT=NONE");
      return clean_text(std::string_view(text).substr(equals + 1));
    }
    const std::size_t close = text.find(']');
    if (text.empty() || text[0] != '[' || close == std::string::npos) continue;
    const std::string key = upper(text.substr(1, close - 1));
    const std::string value = clean_text(std::string_view(text).substr(close + 1));
    if (key == "LUMINAIRE") report.luminaire = value;
    if (key == "LAMP") report.lamp = value;
    if (key == "MANUFAC") report.manufacturer = value;
  }
  throw ProfileError(0, "the file has no TILT line, so it is not an IES file",
                     "use `format eulumdat` if it is an EULUMDAT file");
}

/// Reads a TILT table (geometry, count, angles, factors); returns the factor at 0 degrees.
double tilt_factor(Reader& in) {
  in.whole("the lamp-to-luminaire geometry of TILT", 1, 3);
  const int count = in.whole("the number of TILT angles", 1, kMaxAngles);
  std::vector<int> lines;
  const std::vector<float> angles = read_numbers(in, count, "a TILT angle", lines);
  const std::vector<float> factors = read_numbers(in, count, "a TILT factor", lines);
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (!(factors[i] >= 0 && factors[i] <= 100))
      throw ProfileError(lines[factors.size() + i], fmt::format("a TILT factor is {}", factors[i]),
                         "TILT factors are near 1: correct the file");
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < angles.size(); ++i)
    if (std::abs(angles[i]) < std::abs(angles[nearest])) nearest = i;
  return double{factors[nearest]};
}

double read_tilt(const std::string& tilt, Reader& in, const std::string& folder,
                 ProfileReport& report) {
  const std::string kind = upper(tilt);
  if (kind.empty() || kind == "NONE") return 1;
  if (kind == "INCLUDE") return tilt_factor(in);
  // Only the base name: a profile must not refer to files elsewhere.
  const std::string name = tilt.substr(tilt.find_last_of("/\\:") + 1);
  FileAccess files;  // a link must not lead elsewhere
  files.set_untrusted(true);
  files.permit(folder);
  OpenFile file;
  if (!folder.empty())
    file = files.open((std::filesystem::path(folder) / name).string(), FileUse::Asset);
  if (!file) {
    report.notes.push_back(
        fmt::format("the TILT file \"{}\" is not in the folder of the profile; its factors "
                    "are assumed to be 1",
                    name));
    return 1;
  }
  note_input_file((std::filesystem::path(folder) / name).string(), InputKind::Frame);
  const std::string text = file.read(std::size_t{1} << 16);
  Reader factors(text);
  try {
    return tilt_factor(factors);
  } catch (const ProfileError& e) {
    report.notes.push_back(
        fmt::format("the TILT file \"{}\" cannot be used ({}); its factors are "
                    "assumed to be 1",
                    name, e.what()));
    return 1;
  }
}

struct Header {
  int lamps = 1, vertical = 0, horizontal = 0;
  double lumens = -1, multiplier = 1, ballast = 1, other = 1, watts = 0;
  char type = 'C';
};

double factor_of(Reader& in, const char* what) {
  const double value = in.number(what);
  if (!(value > 0 && value <= 1e9))
    throw ProfileError(in.line(), fmt::format("{} is {}", what, value),
                       "it must be above 0 and is usually 1");
  return value;
}

Header read_header(Reader& in, bool old) {
  Header h;
  h.lamps = in.whole("the number of lamps", 0, 1'000'000);
  h.lumens = in.number("the lumens of a lamp");
  h.multiplier = factor_of(in, "the candela multiplier");
  h.vertical = in.whole("the number of vertical angles", 2, kMaxAngles);
  h.horizontal = in.whole("the number of horizontal angles", 1, kMaxAngles);
  if (std::int64_t{h.vertical} * h.horizontal > kMaxIntensities)
    throw ProfileError(
        in.line(), fmt::format("the file declares {} x {} intensities", h.vertical, h.horizontal),
        fmt::format("the maximum is {}", kMaxIntensities));
  h.type = "CBA"[in.whole("the photometric type", 1, 3) - 1];
  in.whole("the units of length", 1, 2);
  for (const char* what :
       {"the luminaire's width", "the luminaire's length", "the luminaire's height"})
    in.number(what);
  h.ballast = factor_of(in, "the ballast factor");
  // Before 2002 a factor, usually 1; later reserved or the file type.
  const double other = in.number("the number after the ballast factor");
  if (old && other > 0 && other <= 10) h.other = other;
  h.watts = in.number("the watts");
  return h;
}

constexpr float kSame = 0.05f;  // degrees; angles in files are rounded
bool is(float angle, float value) { return std::abs(angle - value) < kSame; }

/// Type C: planes around the vertical axis. Throws if they match no symmetry.
Planes planes_of_type_c(const Planes& stored, std::size_t cones, int line, std::string& symmetry) {
  const std::vector<float>& h = stored.azimuth;
  const float first = h.front(), last = h.back();
  if (h.size() == 1) {
    symmetry = "rotational";
    Planes circle = stored;
    circle.azimuth[0] = 0;
    return close_circle(circle, cones);
  }
  if (is(first, 0) && is(last, 90)) {
    symmetry = "four equal quadrants";
    return mirror_planes(mirror_planes(stored, cones, 0), cones, 90);
  }
  if (is(first, 0) && is(last, 180)) {
    symmetry = "two equal halves, on both sides of 0 - 180";
    return mirror_planes(stored, cones, 0);
  }
  if (is(first, 90) && is(last, 270)) {
    symmetry = "two equal halves, on both sides of 90 - 270";
    return mirror_planes(stored, cones, 90);
  }
  // Some files omit 360, which equals 0.
  const float step = h[1] - h[0];
  if (is(first, 0) && (is(last, 360) || (last > 180 && last + step > 360 - kSame))) {
    symmetry = "none";
    return close_circle(stored, cones);
  }
  throw ProfileError(line, fmt::format("the horizontal angles are from {} to {}", first, last),
                     "type C requires 0 to 0, 90, 180 or 360, or 90 to 270");
}

/// Angles of types A and B, with the mirrored side if only one is stored.
struct Side {
  std::vector<float> angles;
  std::vector<std::size_t> source;  ///< index of the stored angle
};
Side both_sides(const std::vector<float>& stored) {
  Side s;
  if (is(stored.front(), 0) && stored.size() > 1)
    for (std::size_t i = stored.size() - 1; i > 0; --i) {
      s.angles.push_back(-stored[i]);
      s.source.push_back(i);
    }
  for (std::size_t i = 0; i < stored.size(); ++i) {
    s.angles.push_back(stored[i]);
    s.source.push_back(i);
  }
  return s;
}

/// The angle towards the shared axis becomes the polar angle from the opposite end, 90 - angle.
CandelaTable table_around_axis(const PolarFrame& frame, const Side& around, const Side& along,
                               const std::vector<float>& stored, std::size_t stride_around,
                               std::size_t stride_along) {
  CandelaTable table{frame, {}, around.angles, {}};
  for (std::size_t i = along.angles.size(); i-- > 0;) table.polar.push_back(90 - along.angles[i]);
  for (const std::size_t a : around.source)
    for (std::size_t i = along.source.size(); i-- > 0;)
      table.candela.push_back(stored[a * stride_around + along.source[i] * stride_along]);
  return table;
}

}  // namespace

ProfileData parse_ies(std::string_view text, const std::string& folder) {
  ProfileData data;
  ProfileReport& report = data.report;
  report.format = "IES";
  Reader in(text);
  bool old = false;
  const std::string tilt = read_head(in, report, old);
  const double tilt_factor_at_0 = read_tilt(tilt, in, folder, report);
  const Header h = read_header(in, old);
  report.type = h.type;
  report.lamps = h.lamps;
  report.watts = static_cast<float>(h.watts);
  if (h.lumens >= 0 && h.lamps > 0)
    report.lamp_lumens = static_cast<float>(h.lumens) * static_cast<float>(h.lamps);

  std::vector<int> v_lines, h_lines, lines;
  const std::vector<float> v = read_numbers(in, h.vertical, "a vertical angle", v_lines);
  const std::vector<float> u = read_numbers(in, h.horizontal, "a horizontal angle", h_lines);
  const bool c = h.type == 'C';
  const float most = h.type == 'A' ? 180 : 90;
  expect_ascending(v, v_lines, "vertical", c ? 0 : -90, c ? 180 : 90);
  expect_ascending(u, h_lines, "horizontal", c ? 0 : -most, c ? 360 : most);
  std::vector<float> candela = read_numbers(in, h.vertical * h.horizontal, "an intensity", lines);
  scale_candela(candela, lines, h.multiplier * h.ballast * h.other * tilt_factor_at_0);

  const std::size_t cones = v.size();
  if (c) {
    Planes planes =
        planes_of_type_c({u, std::move(candela)}, cones, h_lines.front(), report.symmetry);
    data.table = {{}, v, std::move(planes.azimuth), std::move(planes.candela)};
    return data;
  }
  const Side across = both_sides(u), up = both_sides(v);
  if (across.angles.size() < 2)
    throw ProfileError(h_lines.front(), "there is only one horizontal angle",
                       "types A and B require at least two in each direction");
  const bool mirrored_h = across.angles.size() > u.size(), mirrored_v = up.angles.size() > v.size();
  report.symmetry = mirrored_h && mirrored_v ? "left-right and up-down"
                    : mirrored_h             ? "left-right"
                    : mirrored_v             ? "up-down"
                                             : "none";
  const Vec3 down(0, 0, -1), front(1, 0, 0), right(0, -1, 0);
  data.table = h.type == 'B'
                   ? table_around_axis({right, down, front}, up, across, candela, 1, cones)
                   : table_around_axis({-down, front, right}, across, up, candela, cones, 1);
  return data;
}

}  // namespace oriel::photometry
