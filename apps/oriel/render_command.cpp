// SPDX-License-Identifier: Apache-2.0
// oriel render: a scene to pictures, as the command line asks.
#include <fmt/format.h>

#include "base/parallel.h"
#include "command.h"
#include "image/texture.h"
#include "render_frames.h"
#include "render_plan.h"
#include "shaders/registry.h"
#include "sun_scene.h"

namespace oriel::app {
namespace {

int run_render(const RenderArguments& a) {
  const RenderPlan plan = render_plan(a);
  const ThreadLimit limit(a.threads);
  if (a.texture_cache) TextureSystem::set_cache_megabytes(*a.texture_cache);
  flush_denormals();
  Diagnostics diagnostics;
  DiagnosticPrinter printer(diagnostics, a.json, !a.quiet);
  mi::Reader reader(a.scene.path, read_options(a.scene, builtin_shaders()), diagnostics);
  if (!reader.opened()) {
    printer.print_new();
    return kExitFailed;
  }
  const auto edit = [&](scene::Scene& scene) {
    for (const std::string& text : a.scene.edits) apply_edit(scene, text, builtin_shaders());
    if (plan.sun) turn_sun(scene, scene.renders.back().root, *plan.sun, a.north.value_or(0));
  };
  return render_frames(reader, a, plan, edit, diagnostics, printer);
}

std::vector<std::string> layer_names_beside_outputs() {
  std::vector<std::string> names;
  for (const LayerSpec& row : layer_table())
    if (row.group != LayerGroup::Always && row.group != LayerGroup::Outputs)
      names.push_back(row.name);
  return names;
}

}  // namespace

Command add_render_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("render", "Renders a scene");
  auto a = std::make_shared<RenderArguments>();
  add_scene_arguments(*app, a->scene);
  app->add_option("-o,--output", a->outputs,
                  "File to write in place of the camera's outputs, type by suffix; repeat for "
                  "more. In a file with several render statements # stands for digits of the "
                  "frame's number: out.####.exr; without, the second frame is out.0002.exr")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app->add_option("--samples", a->samples, "Samples of every pixel");
  app->add_option("--noise", a->noise,
                  "Stop when the estimated noise of the picture is below this, e.g. 0.02");
  app->add_option("--time", a->time, "Seconds to render for");
  app->add_option("--frames", a->frames,
                  "Render statements to render, counted from 1: 1..20, or 3,7,12..15, or 8..")
      ->type_name("A..B");
  app->add_flag("--skip-existing", a->skip_existing,
                "Leaves out frames whose files are all there, finished or not");
  app->add_option("--gi", a->gi, "Indirect light: path, fg, photons, fg+photons or scene");
  app->add_option("--size", a->size, "Size of the picture")->type_name("WxH");
  app->add_option("--crop", a->crop, "Only this window: XL,YL,XH,YH from the lower left");
  app->add_option("--sun", a->sun,
                  "Turns sun and sky to where they stand, as 48.14,11.58,2026-06-21T12:00+02:00")
      ->type_name("LAT,LON,TIME");
  app->add_option("--north", a->north,
                  "For --sun: degrees of north clockwise from above, from +Y, or -Z with y up");
  app->add_option("--camera", a->camera, "Camera instance to use");
  app->add_option(
      "--layers", a->layers,
      fmt::format("Layers of EXR files, comma between: beauty, {}, outputs (of materials) or all",
                  fmt::join(layer_names_beside_outputs(), ", ")));
  app->add_option("--light-group", a->light_groups,
                  "Lights of such names (* and ? stand for others, comma between; instances, "
                  "instgroups, glowing objects, or environment) become layer light.NAME of EXR "
                  "files: all their light, bounces included. The rest is light.rest, and the "
                  "layers sum to the beauty; light.indirect is there where maps from files, "
                  "interpolated reflections or users' shaders do not know. Repeat for more; the "
                  "first that matches "
                  "has the light. In scenes: option \"light group NAME\" \"PATTERN,...\"")
      ->allow_extra_args(false)
      ->type_name("NAME=PATTERN,...");
  app->add_option("--unit-luminance", a->unit_luminance,
                  "cd/m2 of one unit of a pixel; else as the scene's exposure or sky says, or 1");
  app->add_flag("--cryptomatte{6}", a->cryptomatte,
                "Mattes of objects, materials and assets by Cryptomatte layers of EXR files; "
                "--cryptomatte=N for N names a pixel in place of 6. In scenes: option "
                "\"cryptomatte\" on");
  app->add_flag("--linear", a->linear,
                "Leaves lens and output shaders out of all files: linear light. Without, files "
                "hold what these make of it, and EXR files have linear light as layer \"linear\"");
  app->add_flag("--keep-outliers", a->keep_outliers,
                "Show pixels that single rare samples make far too bright. By default pictures for "
                "display spread their light over the neighbourhood; EXR files always keep them");
  app->add_option(
         "--clamp", a->clamp,
         "Maximum brightness of a sample, in pixel units (default: none). Removes noise and "
         "light")
      ->check(CLI::PositiveNumber);
  app->add_flag("--denoise", a->denoise,
                "Takes the noise out of finished pictures; EXR gets it as a layer of its own");
  app->add_option("--seed", a->seed, "Another pattern of noise");
  app->add_option("--texture-cache", a->texture_cache,
                  "Texture cache size in MB (default 1024, minimum 16)")
      ->type_name("MB");
  app->add_option("--threads", a->threads, "Threads to use, 0 = all")->check(CLI::Range(0, 4096));
  app->add_flag("--json", a->json, "Lines of JSON on stdout");
  app->add_flag("-q,--quiet", a->quiet, "Only warnings and errors");
  return {app, [a] { return run_render(*a); }};
}

}  // namespace oriel::app
