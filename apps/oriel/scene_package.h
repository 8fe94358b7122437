// SPDX-License-Identifier: Apache-2.0
// Packs the scene or model of a command line.
#pragma once

#include <string>
#include <vector>

#include "command.h"
#include "farm/pack.h"
#include "trust_options.h"

namespace oriel::app {

struct PackArguments {
  std::string scene;  ///< or a model
  std::vector<std::string> include_paths;
  std::string shader_path;
  bool keep_missing = false, quiet = false;
  TrustArguments trust;
};

/// SCENE, -I, --shader-path, --missing and the options of trust_options.h.
void add_pack_arguments(CLI::App& command, PackArguments& arguments);

/// Packs into `folder`. A model is converted as by `oriel quick`.
/// Errors:  UserError that names missing files; std::runtime_error.
farm::PackReport pack(const PackArguments& arguments, const std::string& folder);

}  // namespace oriel::app
