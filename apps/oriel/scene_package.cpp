// SPDX-License-Identifier: Apache-2.0
#include "scene_package.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/temporary_folder.h"
#include "convert_model.h"
#include "scene_file.h"
#include "sdk/library.h"
#include "shaders/registry.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

/// More missing files are counted.
constexpr std::size_t kMaxNamed = 20;

std::string missing_text(const farm::FileReference& r, const Diagnostics& diagnostics) {
  return fmt::format("{}:{}: {} \"{}\" was not found{}{}", diagnostics.file(r.where.file),
                     r.where.line, farm::kind_name(r.kind), r.written, r.reason.empty() ? "" : ": ",
                     r.reason);
}

void report_missing(const farm::PackReport& report, bool keep, const Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < report.missing.size() && i < kMaxNamed; ++i)
    fmt::print(stderr, "oriel: {}\n", missing_text(report.missing[i], diagnostics));
  const std::size_t count = report.missing.size();
  if (count > kMaxNamed) fmt::print(stderr, "oriel: {} further files\n", count - kMaxNamed);
  if (count > 0 && !keep)
    throw UserError(fmt::format(
        "{} file{} missing; nothing was written: correct the scene, or pack it without {} by "
        "--missing keep",
        count, count == 1 ? " is" : "s are", count == 1 ? "it" : "them"));
}

std::optional<std::string> library_in(const sdk::TrustedFolders& folders, const std::string& name) {
  const std::vector<std::string>& own = builtin_packages();
  if (std::find(own.begin(), own.end(), sdk::library_stem(name)) != own.end()) return std::nullopt;
  std::error_code error;
  for (const fs::path& folder : folders)
    if (const fs::path path = folder / (sdk::library_stem(name) + ".so");
        fs::is_regular_file(path, error))
      return path.string();
  return "";
}

}  // namespace

void add_pack_arguments(CLI::App& command, PackArguments& a) {
  command.add_option("SCENE", a.scene, "Scene (.mi), or model of another program")
      ->required()
      ->check(CLI::ExistingFile);
  command
      .add_option("-I,--include", a.include_paths, "Search folder for include files; repeatable")
      ->allow_extra_args(false)
      ->type_name("DIR");
  command
      .add_option("--shader-path", a.shader_path,
                  "Folders of the shader libraries that the scene links, separated by colons; "
                  "those of ORIEL_SHADER_PATH are searched as well, except with --untrusted")
      ->type_name("DIRS");
  command
      .add_option_function<std::string>(
          "--missing", [&a](const std::string& what) { a.keep_missing = what == "keep"; },
          "Missing files: stop, or keep their names (default stop)")
      ->check(CLI::IsMember({"stop", "keep"}));
  add_trust_options(command, a.trust);
  command.add_flag("-q,--quiet", a.quiet, "Only warnings and errors");
}

farm::PackReport pack(const PackArguments& a, const std::string& folder) {
  SceneArguments scene;
  scene.path = a.scene;
  scene.include_paths = a.include_paths;
  scene.trust = a.trust;
  std::optional<TemporaryFolder> converted;
  if (is_model(a.scene)) {
    ConvertArguments convert;
    convert.model = a.scene;
    convert.trust = a.trust;
    convert.daylight = true;
    convert.quiet = a.quiet;
    converted.emplace();
    scene.path = converted->file(fs::path(a.scene).stem().string() + ".mi");
    if (!convert_model(convert, scene.path))
      throw UserError(fmt::format("'{}' could not be converted completely", a.scene));
    scene.trust = trust_of_result(convert);
  }
  const Registry& registry = builtin_shaders();
  const sdk::TrustedFolders libraries = sdk::trusted_folders(a.shader_path, a.trust.untrusted);
  farm::SceneSource source{scene.path, read_options(scene, registry),
                           [&](const std::string& name) { return library_in(libraries, name); }};
  source.read.trusts_code = true;  // nothing is run
  Diagnostics diagnostics;
  DiagnosticPrinter printer(diagnostics, false, Severity::Error);
  farm::PackReport report;
  try {
    report = farm::pack_scene(source, folder, a.keep_missing, diagnostics);
  } catch (const std::runtime_error&) {
    printer.print_new();
    throw;
  }
  printer.print_new();
  report_missing(report, a.keep_missing, diagnostics);
  return report;
}

}  // namespace oriel::app
