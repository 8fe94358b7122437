// SPDX-License-Identifier: Apache-2.0
#include "checkpoint_labels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <limits>
#include <string_view>
#include <vector>

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

bool is_file(const std::string& name) { return name.starts_with(kFilePrefix); }

std::string shown_name(const std::string& name) {
  return shown_label(is_file(name) ? name.substr(kFilePrefix.size()) : name);
}

std::string shown_value(const std::string& text) {
  return text.empty() ? "not given" : "'" + shown_label(text) + "'";
}

/// A label that only one of the renders has.
std::string lone_label(const std::string& name, const std::string& text, const char* when,
                       const char* when_not) {
  if (is_file(name))
    return fmt::format("the file '{}' was read {} and not {}", shown_name(name), when, when_not);
  return fmt::format("{} was {} {} and is unknown {}", shown_name(name), shown_value(text), when,
                     when_not);
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
          {"--samples", a.samples ? fmt::format("{}", *a.samples) : ""},
          {"--even-samples", a.even_samples ? "on" : "off"},
          {"--noise", a.noise ? fmt::format("{}", *a.noise) : ""},
          {"--size", a.size},
          {"--crop", a.crop},
          {"--gi", a.gi},
          {"--no-guiding", a.no_guiding ? "on" : "off"},
          {"layers", a.layers},
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
  labels["--even-samples"] = budget.distribution == Distribution::Even ? "on" : "off";
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
  std::vector<std::string> differences;
  for (const auto& [name, text] : there) {
    const auto found = here.find(name);
    if (found == here.end())
      differences.push_back(lone_label(name, text, "then", "now"));
    else if (found->second != text)
      differences.push_back(is_file(name)
                                ? fmt::format("the file '{}' has changed", shown_name(name))
                                : fmt::format("{} was {} and is {}", shown_name(name),
                                              shown_value(text), shown_value(found->second)));
  }
  for (const auto& [name, text] : here)
    if (!some && !there.contains(name))
      differences.push_back(lone_label(name, text, "now", "then"));
  constexpr std::size_t kMaxDifferences = 3;
  if (differences.size() > kMaxDifferences) {
    differences.resize(kMaxDifferences);
    differences.emplace_back("...");
  }
  return fmt::format("{}", fmt::join(differences, ", "));
}

}  // namespace oriel::app
