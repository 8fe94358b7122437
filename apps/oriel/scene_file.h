// SPDX-License-Identifier: Apache-2.0
// The scene a command works on: read from its file, edited by --set, told about on stderr.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "mi/reader.h"
#include "runtime/shader_spec.h"
#include "scene/scene.h"
#include "trust_options.h"

namespace oriel::app {

struct SceneArguments {
  std::string path;
  std::vector<std::string> include_paths;
  std::vector<std::string> edits;  ///< element.parameter=value
  std::string shader_path;         ///< folders whose native shaders may run
  bool trust_code = false;         ///< C sources in the scene are compiled and run
  TrustArguments trust = {};
};

/// SCENE, -I, --set, --shader-path and those of trust_options.h.
void add_scene_arguments(CLI::App& command, SceneArguments& arguments);

/// How .mi files are read by the program. Includes are looked for in the program's own data folder
/// last.
mi::ReadOptions read_options(const SceneArguments& arguments, const Registry& registry);

/// interactive::apply_edit() for the command line.
///
/// Errors:  UsageError, UserError with the nearest name that exists.
void apply_edit(scene::Scene& scene, const std::string& text, const Registry& registry);

/// Prints what was not printed yet and is severe enough.
class DiagnosticPrinter {
 public:
  DiagnosticPrinter(const Diagnostics& diagnostics, bool json, Severity least)
      : diagnostics_(diagnostics), json_(json), least_(least) {}
  DiagnosticPrinter(const Diagnostics& diagnostics, bool json, bool notes)
      : DiagnosticPrinter(diagnostics, json, notes ? Severity::Note : Severity::Warning) {}
  void print_new();

 private:
  const Diagnostics& diagnostics_;
  bool json_;
  Severity least_;
  std::size_t printed_ = 0;
};

nlohmann::json to_json(const Diagnostic& diagnostic, const Diagnostics& all);

/// One line of JSON on stdout, at once.
void print_json(const nlohmann::json& line);

}  // namespace oriel::app
