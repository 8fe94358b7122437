// SPDX-License-Identifier: Apache-2.0
// oriel explain: lists the surfaces and lights that contribute to the colour of a pixel.
#include <fmt/format.h>

#include <cstdio>

#include "base/parallel.h"
#include "command.h"
#include "explain_text.h"
#include "interrupt.h"
#include "output/camera_output.h"
#include "progress_line.h"
#include "render_plan.h"
#include "scene_code.h"
#include "sdk/host.h"
#include "shaders/registry.h"
#include "sun_scene.h"

namespace oriel::app {
namespace {

/// More than most scenes set, because only one pixel is rendered.
constexpr std::uint32_t kSamples = 256;

struct ExplainArguments {
  RenderArguments render;
  std::string pixel;
};

struct Pixel {
  int x, y;
};

Pixel parse_pixel(const std::string& text) {
  Pixel pixel{};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%6d,%6d%c", &pixel.x, &pixel.y, &rest) != 2)
    throw UsageError(fmt::format("--pixel {}: expected X,Y, counted from the upper left", text));
  return pixel;
}

void expect_inside(const Pixel& p, const Camera& camera) {
  if (p.x < 0 || p.y < 0 || p.x >= camera.width || p.y >= camera.height)
    throw UserError(fmt::format("--pixel {},{}: the picture has {} x {} pixels", p.x, p.y,
                                camera.width, camera.height));
}

int run_explain(ExplainArguments& a) {
  RenderArguments& r = a.render;
  const Pixel pixel = parse_pixel(a.pixel);
  r.even_samples = true;
  RenderPlan plan = render_plan(r);
  if (!r.samples) plan.session.budget.samples = kSamples;
  const ThreadLimit limit(r.threads);
  flush_denormals();
  catch_interrupts();
  Diagnostics diagnostics;
  DiagnosticPrinter printer(diagnostics, r.json, false);
  scene::Scene scene;
  mi::Reader reader(r.scene.path, read_options(r.scene, builtin_shaders()), diagnostics);
  const bool read = reader.opened() && reader.next_frame(scene);
  printer.print_new();
  if (!read) return kExitFailed;
  for (const std::string& edit : r.scene.edits) apply_edit(scene, edit, builtin_shaders());
  const scene::RenderCommand& command = scene.renders.back();
  if (plan.sun) turn_sun(scene, command.root, *plan.sun, r.north.value_or(0));

  SceneCode code(r.scene, diagnostics);
  code.compile(scene);
  sdk::Host host(scene, builtin_shaders(), code.trusted_folders(), diagnostics, &interrupted());
  PrepareReport prepared;
  const auto world = prepare(scene, command, host.registry(), plan.prepare, diagnostics, prepared);
  printer.print_new();
  if (!world) return kExitFailed;
  if (plan.gi) world->options.indirect = *plan.gi;
  expect_inside(pixel, world->camera);
  NodeList outputs;
  if (const scene::Camera* camera = find_camera(scene, command, r.camera))
    outputs = camera_output_shaders(*camera, scene, host.registry(), *world, diagnostics);
  const UnitLuminance unit = unit_luminance(*world, outputs, diagnostics);

  plan.session.diagnostics = &diagnostics;
  ProgressLine line(ProgressLine::style_for(false, r.json || r.quiet));
  const Explanation facts =
      explain_pixel(*world, plan.session, pixel.x, pixel.y, outputs,
                    {[&](const Progress& p) { line.update(p); }, {}}, &interrupted());
  line.clear();
  host.end_frame();
  printer.print_new();
  if (interrupted()) return kExitFailed;
  const ExplainReport report{facts, *world, plan_indirect(world->options), unit};
  if (r.json)
    print_json(explain_json(report));
  else
    fmt::print("{}", explain_text(report));
  return kExitDone;
}

}  // namespace

Command add_explain_command(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("explain",
                             "Explain the colour of a pixel: the surface, the light on it, "
                             "shadows, and the sources of noise");
  auto a = std::make_shared<ExplainArguments>();
  RenderArguments& r = a->render;
  add_scene_arguments(*app, r.scene);
  app->add_option("--pixel", a->pixel, "Pixel, counted from the upper left (0,0)")
      ->required()
      ->type_name("X,Y");
  app->add_option("--samples", r.samples, fmt::format("Number of samples (default {})", kSamples));
  app->add_option("--gi", r.gi, "Method of indirect light, as in oriel render");
  app->add_option("--size", r.size, "Size of the picture, as in oriel render")->type_name("WxH");
  app->add_option("--sun", r.sun, "Position of the sun, as in oriel render")
      ->type_name("LAT,LON,TIME");
  app->add_option("--north", r.north, "Direction of north, as in oriel render");
  app->add_option("--camera", r.camera, "Camera instance to use");
  app->add_option("--seed", r.seed, "Random seed (default 0)");
  app->add_option("--threads", r.threads, "Number of threads, 0 = all (default 0)")
      ->check(CLI::Range(0, 4096));
  app->add_flag("--json", r.json, "Print one line of JSON");
  app->add_flag("-q,--quiet", r.quiet, "No progress");
  return {app, [a] { return run_explain(*a); }};
}

}  // namespace oriel::app
