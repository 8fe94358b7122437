// SPDX-License-Identifier: Apache-2.0
// Options that say how far a scene or model is trusted: which files it may read and how large it
// may become.
#pragma once

#include <string>
#include <vector>

#include "base/file_access.h"
#include "base/scene_budgets.h"
#include "command.h"

namespace oriel::app {

struct TrustArguments {
  bool untrusted = false;
  std::vector<std::string> allowed;  ///< files and folders that scenes may read
  std::vector<std::string> budgets;  ///< name=value
};

/// --untrusted, --allow and --budget.
void add_trust_options(CLI::App& command, TrustArguments& arguments);

/// Without the folder of the scene, which its reader permits.
FileAccess file_access(const TrustArguments& arguments);
/// Errors:  UsageError.
SceneBudgets scene_budgets(const TrustArguments& arguments);

/// The options as words of a command line.
std::vector<std::string> trust_words(const TrustArguments& arguments);

}  // namespace oriel::app
