// SPDX-License-Identifier: Apache-2.0
#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "process_streams.h"
#include "scene_file.h"

namespace oriel::app {
namespace {

constexpr int kBarWidth = 24;
/// Without a terminal: minimum time between lines, in seconds and as a share of the elapsed time.
/// One hour gives about 80 lines.
constexpr double kSecondsBetweenLines = 5;
constexpr double kShareBetweenLines = 0.05;

nlohmann::json to_json(const Progress& p) {
  nlohmann::json json = {{"event", "progress"}, {"stage", p.stage ? p.stage : "picture"},
                         {"pass", p.pass},      {"samples", p.mean_samples},
                         {"active", p.active},  {"elapsed", p.elapsed},
                         {"done", p.done}};
  if (p.noise) json["noise"] = *p.noise;
  if (p.remaining) json["remaining"] = *p.remaining;
  return json;
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 10) return fmt::format("{:.1f} s", seconds);
  const auto whole = std::llround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string progress_text(const Progress& p) {
  std::string text = fmt::format("{:3.0f} %  ", 100 * p.done);
  text += p.stage ? p.stage : fmt::format("{:.4g} samples", p.mean_samples);
  if (p.noise) text += fmt::format("  noise {:.4f}", *p.noise);
  text += "  " + duration_text(p.elapsed);
  if (p.remaining) text += fmt::format(", about {} left", duration_text(*p.remaining));
  return text;
}

ProgressLine::Style ProgressLine::style_for(bool json, bool quiet) {
  if (json) return Style::Json;
  if (quiet) return Style::Quiet;
  return isatty(STDERR_FILENO) ? Style::Bar : Style::Lines;
}

void ProgressLine::update(const Progress& p) {
  if (style_ == Style::Quiet) return;
  if (style_ == Style::Json) return print_json(to_json(p));
  if (style_ == Style::Lines) {
    if (p.elapsed < last_line_) last_line_ = 0;  // the picture began
    if (p.elapsed - last_line_ < std::max(kSecondsBetweenLines, kShareBetweenLines * last_line_))
      return;
    last_line_ = p.elapsed;
    fmt::print(stderr, "{}\n", progress_text(p));
    return;
  }
  const int filled = static_cast<int>(std::lround(kBarWidth * p.done));
  clear_line();
  fmt::print(stderr, "[{}{}] {}", std::string(static_cast<std::size_t>(filled), '#'),
             std::string(static_cast<std::size_t>(kBarWidth - filled), '.'), progress_text(p));
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressLine::clear() {
  if (drawn_) clear_line();
  drawn_ = false;
}

}  // namespace oriel::app
