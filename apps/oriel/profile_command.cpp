// SPDX-License-Identifier: Apache-2.0
// oriel profile: what a photometric file holds, in figures and as a polar plot.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/durable_file.h"
#include "base/math.h"
#include "command.h"
#include "photometry/profile_file.h"
#include "profile_plot.h"

namespace oriel::app {
namespace {

using photometry::LightProfile, photometry::ProfileData;

struct ProfileArguments {
  std::string file, plot;
  bool json = false;
};

ProfileData read(const std::string& file) {
  try {
    return photometry::read_profile(file);
  } catch (const photometry::ProfileError& e) {
    const std::string line = e.line > 0 ? fmt::format(":{}", e.line) : std::string();
    throw UserError(fmt::format("{}{}: {} ({})", file, line, e.what(), e.hint));
  }
}

/// Angles of a direction as a type C file has them, degrees.
struct Angles {
  float vertical, horizontal;
};
Angles angles_of(const Vec3& d) {
  const float across = math::hypot(d.x, d.y);
  const float horizontal = across > 1e-6f ? math::atan2(d.y, d.x) * 180 / kPi : 0;
  return {math::atan2(across, -d.z) * 180 / kPi,
          horizontal < -1e-4f ? horizontal + 360 : horizontal};
}

struct Widths {
  float along, across;  ///< in the planes of 0 - 180 and 90 - 270, degrees
};
/// Around nadir, or zenith where the light goes up.
Widths widths(const LightProfile& profile, float share) {
  const Vec3 axis(
      0, 0, profile.evaluate(Vec3(0, 0, -1)) >= profile.evaluate(Vec3(0, 0, 1)) ? -1.0f : 1.0f);
  return {beam_width_deg(profile, axis, Vec3(1, 0, 0), share),
          beam_width_deg(profile, axis, Vec3(0, 1, 0), share)};
}

void print_table(const ProfileData& data, const LightProfile& profile) {
  const auto& r = data.report;
  const auto row = [](const char* name, const std::string& value) {
    if (!value.empty()) fmt::print("{:<18}{}\n", name, value);
  };
  row("format", r.version.empty() ? r.format : r.format + " " + r.version);
  row("luminaire", r.luminaire);
  row("maker", r.manufacturer);
  row("lamps", fmt::format("{}{}", r.lamps, r.lamp.empty() ? "" : ", " + r.lamp));
  row("power", fmt::format("{:g} W", r.watts));
  row("photometry", fmt::format("type {}, {} x {} angles", r.type, data.table.azimuth.size(),
                                data.table.polar.size()));
  row("symmetry", r.symmetry);
  row("flux of the lamps", r.lamp_lumens ? fmt::format("{:g} lm", *r.lamp_lumens)
                                         : std::string("not stated (absolute photometry)"));
  const std::string share =
      r.lamp_lumens && *r.lamp_lumens > 0
          ? fmt::format(", {:.1f} % of the lamps'", 100 * profile.flux() / *r.lamp_lumens)
          : std::string();
  row("flux measured", fmt::format("{:.1f} lm{}", profile.flux(), share));
  const Angles peak = angles_of(profile.peak_direction());
  row("peak", fmt::format("{:g} cd at {:.1f} degrees from nadir, {:.1f} around", profile.peak(),
                          peak.vertical, peak.horizontal));
  const Widths beam = widths(profile, 0.5f), field = widths(profile, 0.1f);
  const auto both = [](const Widths& w) {
    return fmt::format("{:.1f} degrees in 0 - 180, {:.1f} in 90 - 270", w.along, w.across);
  };
  row("beam (50 %)", both(beam));
  row("field (10 %)", both(field));
  for (const std::string& note : r.notes) row("note", note);
}

nlohmann::json as_json(const ProfileData& data, const LightProfile& profile) {
  const auto& r = data.report;
  const Angles peak = angles_of(profile.peak_direction());
  const Widths beam = widths(profile, 0.5f), field = widths(profile, 0.1f);
  nlohmann::json line = {{"format", r.format},
                         {"version", r.version},
                         {"type", std::string(1, r.type)},
                         {"symmetry", r.symmetry},
                         {"luminaire", r.luminaire},
                         {"manufacturer", r.manufacturer},
                         {"lamp", r.lamp},
                         {"lamps", r.lamps},
                         {"watts", r.watts},
                         {"lamp_lumens", nullptr},
                         {"flux", profile.flux()},
                         {"peak", profile.peak()},
                         {"peak_vertical", peak.vertical},
                         {"peak_horizontal", peak.horizontal},
                         {"beam", {beam.along, beam.across}},
                         {"field", {field.along, field.across}},
                         {"notes", r.notes}};
  if (r.lamp_lumens) line["lamp_lumens"] = *r.lamp_lumens;
  return line;
}

int run_profile(const ProfileArguments& a) {
  const ProfileData data = read(a.file);
  const LightProfile profile(data.table);
  if (!a.plot.empty()) {
    if (a.plot.size() < 4 || a.plot.substr(a.plot.size() - 4) != ".svg")
      throw UsageError(fmt::format("-o {}: plots are .svg files", a.plot));
    const std::string title = data.report.luminaire.empty() ? a.file : data.report.luminaire;
    write_durably(a.plot, polar_plot(profile, title));
  }
  if (a.json)
    fmt::print(
        "{}\n",
        as_json(data, profile).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    print_table(data, profile);
  return kExitDone;
}

}  // namespace

Command add_profile_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "profile", "Print and plot the content of a photometric file (IES, EULUMDAT)");
  auto a = std::make_shared<ProfileArguments>();
  app->add_option("file", a->file, "Photometric file")->required()->type_name("FILE");
  app->add_option("-o,--output", a->plot, "Polar plot (.svg)")->type_name("FILE");
  app->add_flag("--json", a->json, "Print one line of JSON");
  return {app, [a] { return run_profile(*a); }};
}

}  // namespace oriel::app
