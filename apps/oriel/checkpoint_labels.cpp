// SPDX-License-Identifier: Apache-2.0
#include "checkpoint_labels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <limits>
#include <string_view>

#include "render/indirect_plan.h"
#include "render_frames.h"

namespace oriel::app {
namespace {

/// Larger textures would delay the start of a render by their reading.
constexpr std::uint64_t kMaxComparedBytes = std::uint64_t{64} << 20;
constexpr std::string_view kFilePrefix = "file ";

/// The name of a file in labels: scenes may be moved with all their files.
std::string label_name(const std::string& path, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path file = fs::weakly_canonical(path, error);
  const fs::path root = fs::weakly_canonical(folder.empty() ? "." : folder, error);
  const fs::path relative = file.lexically_relative(root);
  const bool is_below = !error && !relative.empty() && *relative.begin() != "..";
  return std::string(kFilePrefix) + (is_below ? relative : file.filename()).string();
}

}  // namespace

std::string program_label() {
  const std::uint64_t build =
      file_checksum("/proc/self/exe", std::numeric_limits<std::uint64_t>::max());
  return fmt::format("Oriel {} (build {:08x})", ORIEL_VERSION,
                     static_cast<std::uint32_t>(build ^ (build >> 32)));
}

CheckpointLabels option_labels(const RenderArguments& a) {
  return {{"--set", fmt::format("{}", fmt::join(a.scene.edits, "; "))},
          {"--sun", a.sun},
          {"--north", a.north ? fmt::format("{}", *a.north) : ""},
          {"--camera", a.camera},
          {"--frames", a.frames},
          {"--light-group", fmt::format("{}", fmt::join(a.light_groups, "; "))},
          {"--clamp", fmt::format("{}", a.clamp)},
          {"--seed", fmt::format("{}", a.seed)}};
}

void add_session_labels(const RenderSession& session, CheckpointLabels& labels) {
  const World& world = session.world();
  const RenderBudget& budget = session.budget();
  const Film& film = session.film();
  const Window& w = session.window();
  const IndirectPlan plan = plan_indirect(world.options);
  labels["--samples"] = fmt::format("{}", budget.max_samples);
  labels["samples min"] = fmt::format("{}", budget.min_samples);
  labels["--noise"] =
      fmt::format("{}{}", budget.noise, budget.every_pixel ? " in every pixel" : "");
  labels["--size"] = fmt::format("{}x{}", world.camera.width, world.camera.height);
  labels["--crop"] = fmt::format("{},{},{},{}", w.x0, w.y0, w.x1 - 1, w.y1 - 1);
  labels["--gi"] = fmt::format("{}{}", plan.name(), plan.by_name ? "" : " of the scene");
  labels["layers"] = fmt::format("outputs {}, irradiance {}, surface values {}, mattes {}",
                                 film.keeps_outputs(), session.keeps_irradiance(),
                                 film.surface_values().to_string(), session.mattes() != nullptr);
  labels["light layers"] = fmt::format("{}", film.light_layers());
}

void add_file_labels(const std::string& folder, InputKind kind, CheckpointLabels& labels) {
  for (const std::string& path : input_files(kind)) {
    const std::uint64_t most =
        kind == InputKind::Scene ? std::numeric_limits<std::uint64_t>::max() : kMaxComparedBytes;
    std::string& text = labels[label_name(path, folder)];
    // Several files elsewhere may have the same name.
    text += fmt::format("{:016x}", file_checksum(path, most));
  }
}

std::string shown_label(const std::string& text) {
  constexpr std::size_t kMaxShown = 80;
  std::string shown = text.substr(0, kMaxShown);
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return shown.size() < text.size() ? shown + "..." : shown;
}

std::string label_difference(const CheckpointLabels& there, const CheckpointLabels& here,
                             bool some) {
  const auto file_of = [](const std::string& name) {
    return name.starts_with(kFilePrefix) ? shown_label(name.substr(kFilePrefix.size()))
                                         : std::string();
  };
  const auto quoted = [](const std::string& text) {
    return text.empty() ? std::string("not given") : "'" + shown_label(text) + "'";
  };
  for (const auto& [name, text] : there) {
    const auto found = here.find(name);
    if (found != here.end() && found->second == text) continue;
    if (const std::string file = file_of(name); !file.empty())
      return fmt::format("the file '{}' {}", file,
                         found == here.end() ? "is not read now" : "has changed");
    return fmt::format("{} was {} and is {}", shown_label(name), quoted(text),
                       found == here.end() ? "missing" : quoted(found->second));
  }
  if (some) return {};
  for (const auto& [name, text] : here)
    if (!there.contains(name)) {
      if (const std::string file = file_of(name); !file.empty())
        return fmt::format("the file '{}' was not read then", file);
      return fmt::format("{} was missing and is {}", name, quoted(text));
    }
  return {};
}

}  // namespace oriel::app
