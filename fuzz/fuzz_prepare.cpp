// SPDX-License-Identifier: Apache-2.0
// Any text to the world that would be rendered, and a few of its pixels.
#include <cstdint>
#include <string_view>

#include "fuzzers.h"
#include "mi/reader.h"
#include "prepare/prepare.h"
#include "render/session.h"
#include "shaders/registry.h"

int oriel::fuzz::fuzz_prepare(const std::uint8_t* data, std::size_t size) {
  using namespace oriel;
  Diagnostics diagnostics;
  mi::ReadOptions options;
  options.packages = builtin_packages();
  options.knows_shader = [](std::string_view n) { return builtin_shaders().find(n) != nullptr; };
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  scene::Scene scene = mi::read_text(text, options, diagnostics);
  if (scene.renders.empty()) return 0;
  PrepareOptions prepare_options;
  prepare_options.width = prepare_options.height = 2;
  PrepareReport report;
  const auto world =
      prepare(scene, scene.renders.back(), builtin_shaders(), prepare_options, diagnostics, report);
  if (!world) return 0;
  world->options.indirect = scene::IndirectMethod::Path;
  SessionSettings settings;
  settings.budget.samples = 1;
  settings.diagnostics = &diagnostics;
  RenderSession(*world, settings).run();
  return 0;
}
