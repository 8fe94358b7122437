// SPDX-License-Identifier: Apache-2.0
// oriel pack: everything a scene reads in one folder, for another machine.
#include <fmt/format.h>

#include "farm/pack_layout.h"
#include "scene_package.h"

namespace oriel::app {
namespace {

struct PackCommand : PackArguments {
  std::string folder;
};

int run_pack(const PackCommand& a) {
  const farm::PackReport report = pack(a, a.folder);
  if (a.quiet) return kExitDone;
  fmt::print("{}: {} file{}, {:.1f} MB, {} frame{}\n", a.folder, report.files,
             report.files == 1 ? "" : "s", static_cast<double>(report.bytes) / 1e6, report.frames,
             report.frames == 1 ? "" : "s");
  fmt::print("render it with: oriel render {}/{}{}{}\n", a.folder, report.scene,
             report.has_libraries
                 ? fmt::format(" --shader-path {}/{}", a.folder, farm::kPackedShaders)
                 : "",
             report.has_code ? " --trust-code" : "");
  return kExitDone;
}

}  // namespace

Command add_pack_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "pack", "Copy everything a scene reads into one folder, for rendering on other machines");
  auto a = std::make_shared<PackCommand>();
  add_pack_arguments(*command, *a);
  command->add_option("-o,--output", a->folder, "Folder to write, which is new or empty")
      ->required()
      ->type_name("FOLDER");
  return {command, [a] { return run_pack(*a); }};
}

}  // namespace oriel::app
