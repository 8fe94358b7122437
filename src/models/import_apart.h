// SPDX-License-Identifier: Apache-2.0
// Imports models in a confined process, so that a damaged or hostile file cannot harm this one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "base/sandbox.h"
#include "models/import.h"

namespace oriel::models {

struct ImportProcess {
  /// Program that calls serve_model() when its first argument is kModelReaderArgument; the others
  /// are those of ConfinedOptions.
  std::string program = "/proc/self/exe";
  std::size_t memory_mb = 0;  ///< of the process; 0 = as much as the machine has
  double seconds = 3600;      ///< for the whole import
};

inline constexpr const char* kModelReaderArgument = "--read-model";

/// import_model() in a process that can open no file: this one opens the files that the model names
/// if the policy permits them, and writes embedded textures.
///
/// Model:   the process returns the scene as .mi text in shared memory. Only what import_model()
///          makes is kept of it.
/// Errors:  as import_model(); OR-MD-001 also if the process crashes, takes too long, needs too
///          much memory or gives an invalid answer. Without seccomp, models of untrusted scenes
///          (ImportOptions::files) are refused; others are imported with the other limits.
/// Checked: ModelApart.*, ConvertTest.* in tests/cli
std::optional<scene::Scene> import_model_apart(const std::string& path,
                                               const ImportOptions& options,
                                               const ImportProcess& process,
                                               Diagnostics& diagnostics);

/// Runs the process: confines itself and imports one model.
/// Returns: the exit code.
int serve_model(const SandboxLimits& limits);

}  // namespace oriel::models
