// SPDX-License-Identifier: Apache-2.0
// oriel render: a scene to pictures, as the command line asks.
#include "render_command.h"

#include <fmt/format.h>

#include "base/parallel.h"
#include "command.h"
#include "denoiser_option.h"
#include "image/reader_process.h"
#include "image/texture.h"
#include "ranks.h"
#include "render_frames.h"
#include "render_plan.h"
#include "shaders/registry.h"
#include "sun_scene.h"

namespace oriel::app {
namespace {

std::vector<std::string> layer_names_beside_outputs() {
  std::vector<std::string> names;
  for (const LayerSpec& row : layer_table())
    if (row.group != LayerGroup::Always && row.group != LayerGroup::Outputs)
      names.push_back(row.name);
  return names;
}

void add_picture_options(CLI::App& app, RenderArguments& a) {
  app.add_flag("--cryptomatte{6}", a.cryptomatte,
               "Cryptomatte layers of objects, materials and assets in EXR files; "
               "--cryptomatte=N stores N names per pixel (default 6). In scenes: option "
               "\"cryptomatte\" on");
  app.add_option("--exr", a.exr,
                 fmt::format("Colour in EXR files: half (default; float where a layer has values "
                             "beyond 65504) or float, and compression: {} (default zip; dwaa and "
                             "dwab are lossy for colour). Data layers are always float and exact",
                             fmt::join(kExrCompressionNames, ", ")))
      ->type_name("half|float,COMPRESSION");
  app.add_option("--bits", a.bits,
                 "Bits per channel of PNG and TIFF files: 8 or 16 (default: 8, TIFF 16)")
      ->check(CLI::IsMember({8, 16}));
  app.add_flag("--timestamps", a.timestamps,
               "Write date (capDate) and render time into EXR files, which then differ between "
               "runs. SOURCE_DATE_EPOCH sets the date without this option");
  app.add_flag("--linear", a.linear,
               "Skip lens and output shaders: all files contain linear light. By default files "
               "show their result, and EXR files contain linear light as layer \"linear\"");
  app.add_flag(
      "--keep-outliers", a.keep_outliers,
      "Do not filter outliers (pixels that are far too bright because of rare samples). By "
      "default, pictures for display spread their light over the neighbourhood; EXR files "
      "always contain them");
  app.add_option(
         "--clamp", a.clamp,
         "Maximum brightness of a sample, in pixel units (default: none). Reduces noise, and "
         "loses light")
      ->check(CLI::PositiveNumber);
  app.add_flag("--denoise", a.denoise,
               "Denoise the finished pictures; in EXR files as a separate layer");
  add_denoiser_option(app, a.denoiser);
}

void add_checkpoint_options(CLI::App& app, RenderArguments& a) {
  app.add_option("--checkpoint", a.checkpoint,
                 "Write the state of the render to FILE every SECONDS (default 300, or longer if "
                 "writing takes more than 1 % of the time), at SIGUSR1, and when the render is "
                 "interrupted or ends by --time. A finished render removes it")
      ->type_name("FILE[,every SECONDS]");
  app.add_option("--resume", a.resume,
                 "Continue the render of a checkpoint, with the same scene and options; the "
                 "picture is the same as without the interruption. FILE is also written, unless "
                 "--checkpoint names another one. If --checkpoint names FILE and it does not "
                 "exist, the render starts")
      ->type_name("FILE");
  app.add_flag("--stop-at-usr1", a.stop_at_usr1,
               "SIGUSR1 writes the checkpoint and ends the render with status 75 (default: the "
               "render continues)");
}

/// The processor time of all ranks.
void print_work(const std::vector<RankWork>& ranks, const RenderArguments& a) {
  double useful = 0, all = 0, start = 0;
  nlohmann::json memory = nlohmann::json::array();
  for (const RankWork& work : ranks) {
    useful += work.useful_seconds, all += work.seconds, start += work.start_seconds;
    memory.push_back(work.memory);
  }
  if (a.json)
    print_json({{"event", "ranks"},
                {"ranks", ranks.size()},
                {"cpu_seconds", all},
                {"useful_cpu_seconds", useful},
                {"start_cpu_seconds", start},
                {"memory", memory}});
  else if (!a.quiet)
    fmt::print(stderr, "{} ranks: {:.1f} s of processor time, {:.1f} % of it for samples\n",
               ranks.size(), all, all > 0 ? 100 * useful / all : 0.0);
}

int run_with_ranks(RenderArguments a, Ranks& ranks) try {
  if (!a.part.empty() || !a.maps_only.empty())
    throw UsageError("--part and --maps-only are for single processes, not for an MPI job");
  const ThreadLimit limit(a.threads);
  if (!ranks.leads()) {  // rank 0 writes all files and texts
    a.checkpoint.clear(), a.resume.clear();
    a.json = false, a.quiet = true;
  }
  RenderPlan plan = render_plan(a);
  plan.ranks = &ranks;
  // Of rank 0, which knows of the checkpoint.
  const int code = std::atoi(ranks.from_leader(std::to_string(render_scene(a, plan))).c_str());
  const std::vector<RankWork> work = ranks.finish();
  if (!work.empty()) print_work(work, a);
  return code;
} catch (const std::exception& e) {
  // Before the job ends, and with it this process.
  fmt::print(stderr, "oriel: rank {}: {}\n", ranks.rank(), e.what());
  return kExitFailed;
}

int run_render(const RenderArguments& a) {
  if (const std::unique_ptr<Ranks> ranks = Ranks::join()) return run_with_ranks(a, *ranks);
  return render_scene(a, render_plan(a));
}

/// How many samples pixels get.
void add_sample_options(CLI::App& app, RenderArguments& a) {
  app.add_option("--samples", a.samples,
                 "Samples per pixel (default: from the scene). From 32 samples and 256x256 pixels "
                 "on, the mean of the picture: every pixel gets half of them, noisy pixels the "
                 "rest");
  app.add_flag("--even-samples", a.even_samples, "Every pixel gets the same number of samples");
  app.add_option("--noise", a.noise,
                 "Stop when the estimated noise of the picture is below this, e.g. 0.02");
  app.add_option("--time", a.time,
                 "Time limit in seconds from the start of the program, for later frames from the "
                 "end of the one before (default none). At least one pass is completed");
}

void add_farm_options(CLI::App& app, RenderArguments& a) {
  app.add_option("--part", a.part,
                 "Render part K of N parts, which cost about the same, to NAME.part-K-of-N beside "
                 "the picture NAME.exr; oriel merge makes the picture of all parts. An existing "
                 "part continues. SIGUSR1 and SIGTERM save the part and end with status 75")
      ->type_name("K/N");
  app.add_option("--maps-only", a.maps_only,
                 "Compute photons, gather points and what paths learn before the picture, write "
                 "them to FOLDER, and end without a picture")
      ->type_name("FOLDER");
  app.add_option("--maps", a.maps,
                 "Read the maps that --maps-only wrote with the same scene and options")
      ->type_name("FOLDER");
}

}  // namespace

int render_scene(const RenderArguments& a, const RenderPlan& plan) {
  const ThreadLimit limit(a.threads);
  if (a.isolate_readers || a.scene.trust.untrusted) isolate_readers({});
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

void add_render_options(CLI::App& command, RenderArguments& arguments) {
  CLI::App* app = &command;
  RenderArguments* a = &arguments;
  add_scene_arguments(*app, a->scene);
  app->add_option(
         "-o,--output", a->outputs,
         "Output file instead of those of the camera; the suffix sets the type; repeatable. "
         "With several render statements, # is replaced by digits of the "
         "frame number: out.####.exr; without #, the second frame is out.0002.exr")
      ->allow_extra_args(false)
      ->type_name("FILE");
  add_sample_options(*app, *a);
  app->add_option("--frames", a->frames,
                  "Frames (render statements) to render, counted from 1: 1..20, 3,7,12..15 or 8.. "
                  "(default all)")
      ->type_name("A..B");
  app->add_flag("--skip-existing", a->skip_existing,
                "Skip frames whose files all exist, complete or not");
  app->add_flag("--live", a->live,
                "Write the picture in progress to the output file itself instead of "
                "NAME.part.exr, which replaces the file at the end");
  app->add_option(
      "--gi", a->gi,
      "Method of indirect light: path, path+cache, fg, photons, fg+photons or scene (default "
      "scene)");
  app->add_flag("--no-guiding", a->no_guiding,
                "Paths do not learn where light comes from; the mean is the same");
  app->add_option("--size", a->size, "Size of the picture (default: from the camera)")
      ->type_name("WxH");
  app->add_option("--crop", a->crop,
                  "Window to render, in pixels from the lower left, ends included (default all)")
      ->type_name("XL,YL,XH,YH");
  app->add_option(
         "--sun", a->sun,
         "Position of sun and sky by place and time, e.g. 48.14,11.58,2026-06-21T12:00+02:00")
      ->type_name("LAT,LON,TIME");
  app->add_option(
      "--north", a->north,
      "North for --sun: degrees clockwise from +Y, seen from above (from -Z if y is up)");
  app->add_option("--camera", a->camera,
                  "Camera instance to use (default: that of the render statement)");
  app->add_option(
      "--layers", a->layers,
      fmt::format(
          "Layers of EXR files, separated by commas: beauty, {}, outputs (of materials) or all",
          fmt::join(layer_names_beside_outputs(), ", ")));
  app->add_option(
         "--light-group", a->light_groups,
         "Light group: names of lights (wildcards * and ?, separated by commas; instances, "
         "instgroups, emissive objects or environment). Layer light_NAME of EXR "
         "files contains all their light with its bounces, light_rest the remaining light; the "
         "layers sum to the beauty; light_indirect contains light of unknown groups (from map "
         "files, "
         "interpolated reflections and users' shaders). Repeatable; a light belongs to the first "
         "group that matches. In scenes: option \"light group NAME\" \"PATTERN,...\"")
      ->allow_extra_args(false)
      ->type_name("NAME=PATTERN,...");
  app->add_option(
      "--unit-luminance", a->unit_luminance,
      "cd/m2 of one pixel unit (default: from the exposure or sky of the scene, else 1)");
  add_picture_options(*app, *a);
  add_checkpoint_options(*app, *a);
  add_farm_options(*app, *a);
  app->add_option("--seed", a->seed, "Random seed (default 0)");
  app->add_option(
         "--texture-cache", a->texture_cache,
         "Memory for textures in MB: three quarters for pictures that are kept whole, the rest for "
         "tiles of the others (default 4096, minimum 16)")
      ->type_name("MB");
  app->add_flag("--isolate-readers", a->isolate_readers,
                "Decode image files in confined processes, for scenes of unknown origin");
  app->add_option("--threads", a->threads, "Number of threads, 0 = all (default 0)")
      ->check(CLI::Range(0, 4096));
  app->add_flag("--json", a->json, "Print lines of JSON");
  app->add_flag("-q,--quiet", a->quiet, "Only warnings and errors");
}

Command add_render_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("render", "Render a scene");
  auto a = std::make_shared<RenderArguments>();
  add_render_options(*app, *a);
  return {app, [a] { return run_render(*a); }};
}

}  // namespace oriel::app
