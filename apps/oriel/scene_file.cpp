// SPDX-License-Identifier: Apache-2.0
#include "scene_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "interactive/scene_edit.h"
#include "shaders/registry.h"
#include "templates.h"

namespace oriel::app {

void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("SCENE", arguments.path, "Scene file (.mi)")->required();
  command
      .add_option("-I,--include", arguments.include_paths,
                  "Search folder for include files; repeatable")
      ->allow_extra_args(false)
      ->type_name("DIR");
  command
      .add_option("--set", arguments.edits,
                  "Set a parameter of a shader, material, light or options block; repeatable")
      ->allow_extra_args(false)
      ->type_name("ELEMENT.PARAM=VALUE");
  command
      .add_option(
          "--shader-path", arguments.shader_path,
          "Folders from which `link` may load shader libraries, separated by colons; those of "
          "ORIEL_SHADER_PATH are searched as well, except with --untrusted")
      ->type_name("DIRS");
  command.add_flag("--trust-code", arguments.trust_code,
                   "Compile and run C sources in the scene ($code and `code` statements); only "
                   "for scenes from trusted authors");
  add_trust_options(command, arguments.trust);
}

mi::ReadOptions read_options(const SceneArguments& arguments, const Registry& registry) {
  mi::ReadOptions options;
  options.include_paths = arguments.include_paths;
  options.include_paths.push_back(data_folder());
  options.packages = builtin_packages();
  options.trusts_code = arguments.trust_code;
  if (arguments.trust_code && arguments.trust.untrusted)
    throw UsageError("--trust-code and --untrusted exclude each other");
  options.files = file_access(arguments.trust);
  options.budgets = scene_budgets(arguments.trust);
  options.knows_shader = [&registry](std::string_view name) { return registry.find(name); };
  return options;
}

void apply_edit(scene::Scene& scene, const std::string& text, const Registry& registry) {
  try {
    interactive::apply_edit(scene, text, registry);
  } catch (const interactive::EditFormError& error) {
    throw UsageError(error.what());
  } catch (const interactive::EditError& error) {
    throw UserError(error.what());
  }
}

void DiagnosticPrinter::print_new() {
  for (; printed_ < diagnostics_.all().size(); ++printed_) {
    const Diagnostic& d = diagnostics_.all()[printed_];
    if (d.severity < least_) continue;
    if (json_) {
      nlohmann::json line = to_json(d, diagnostics_);
      line["event"] = "diagnostic";
      print_json(line);
    } else {
      fmt::print(stderr, "{}\n", diagnostics_.format(d));
    }
  }
}

nlohmann::json to_json(const Diagnostic& d, const Diagnostics& all) {
  constexpr const char* kSeverities[] = {"note", "warning", "error"};
  nlohmann::json json = {{"severity", kSeverities[static_cast<int>(d.severity)]},
                         {"code", d.code},
                         {"message", d.message}};
  if (d.where.file) json["file"] = all.file(d.where.file);
  if (d.where.line) json["line"] = d.where.line, json["column"] = d.where.column;
  if (!d.hint.empty()) json["hint"] = d.hint;
  return json;
}

void print_json(const nlohmann::json& line) {
  fmt::print("{}\n", line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  std::fflush(stdout);
}

}  // namespace oriel::app
