// SPDX-License-Identifier: Apache-2.0
#include "trust_options.h"

#include <fmt/format.h>

namespace oriel::app {

void add_trust_options(CLI::App& command, TrustArguments& arguments) {
  command.add_flag("--untrusted", arguments.untrusted,
                   "Read only files below the folder of the scene, -I and --allow, also pictures; "
                   "for scenes of unknown authors");
  command
      .add_option("--allow", arguments.allowed,
                  "File or folder that the scene may read; repeatable")
      ->allow_extra_args(false)
      ->type_name("PATH");
  std::string names;
  for (const BudgetRow& row : budget_table())
    names += fmt::format("{}{} ({:g})", names.empty() ? "" : ", ", row.name, row.standard);
  command
      .add_option("--budget", arguments.budgets,
                  "Maximum of what the scene may expand to, such as instances=20M; repeatable. "
                  "Names and defaults: " +
                      names)
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
}

FileAccess file_access(const TrustArguments& arguments) {
  FileAccess files;
  files.set_untrusted(arguments.untrusted);
  for (const std::string& path : arguments.allowed) files.permit(path);
  return files;
}

SceneBudgets scene_budgets(const TrustArguments& arguments) {
  SceneBudgets budgets;
  for (const std::string& text : arguments.budgets)
    if (const std::string fault = budgets.set(text); !fault.empty())
      throw UsageError("--budget: " + fault);
  return budgets;
}

std::vector<std::string> trust_words(const TrustArguments& arguments) {
  std::vector<std::string> words;
  if (arguments.untrusted) words.emplace_back("--untrusted");
  for (const std::string& path : arguments.allowed) words.insert(words.end(), {"--allow", path});
  for (const std::string& text : arguments.budgets) words.insert(words.end(), {"--budget", text});
  return words;
}

}  // namespace oriel::app
