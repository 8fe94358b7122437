// SPDX-License-Identifier: Apache-2.0
#include "done_line.h"

#include <fmt/format.h>

#include <algorithm>

#include "image/texture_statistics.h"
#include "progress_line.h"
#include "scene_file.h"

namespace oriel::app {

void print_done_line(const RenderSession& session, StopReason reason,
                     const std::vector<std::string>& files) {
  constexpr const char* kReasons[] = {"samples",     "noise",     "time",
                                      "interrupted", "maps only", "part"};
  const Progress p = session.progress();
  nlohmann::json line = {{"event", "done"},
                         {"stopped_by", kReasons[static_cast<int>(reason)]},
                         {"samples", p.mean_samples},
                         {"elapsed", p.elapsed},
                         {"rays", session.rays().rays()},
                         {"rays_before", session.rays_before()},
                         {"learned_bytes", session.learned_bytes()},
                         {"files", files}};
  if (p.noise) line["noise"] = *p.noise;
  if (const TextureStatistics t = texture_statistics(); t.files > 0)
    line["textures"] = {{"files", t.files},
                        {"tile_requests", t.tile_requests},
                        {"tile_misses", t.tile_misses},
                        {"bytes_read", t.bytes_read},
                        {"bytes_held", t.bytes_held}};
  print_json(line);
}

void print_summary(const RenderSession& session, StopReason reason,
                   const std::vector<std::string>& files) {
  if (files.empty()) return;
  const Progress p = session.progress();
  fmt::print(stderr, "{}{}: {:.4g} samples{}, {}\n",
             reason == StopReason::Cancelled ? "interrupted, the picture so far: " : "",
             fmt::join(files, ", "), p.mean_samples,
             p.noise ? fmt::format(", noise {:.4f}", *p.noise) : "", duration_text(p.elapsed));
}

bool is_complete(const Diagnostics& diagnostics) {
  return std::none_of(diagnostics.all().begin(), diagnostics.all().end(), [](const Diagnostic& d) {
    return d.severity == Severity::Error && d.code != "OR-SDK-020";
  });
}

}  // namespace oriel::app
