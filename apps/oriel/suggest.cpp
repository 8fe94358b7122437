// SPDX-License-Identifier: Apache-2.0
#include "suggest.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/diagnostic.h"

namespace oriel::app {
namespace {

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// With their dashes.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && (word[1] < '0' || word[1] > '9') && word[1] != '.';
}

std::string unknown_option(const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  return fmt::format("unknown option {}{}", name, suggestion(name, option_names(command)));
}

}  // namespace

std::string suggestion(std::string_view name, std::span<const std::string> candidates) {
  const std::string near = nearest_name(name, candidates);
  return near.empty() ? "" : fmt::format("; did you mean {}?", near);
}

std::string expected_one_of(std::string_view value, const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i)
    list += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return fmt::format("expected {}{}", list, suggestion(value, names));
}

CLI::Validator one_of(std::vector<std::string> names) {
  const std::string shown = fmt::format("{{{}}}", fmt::join(names, ","));
  return CLI::Validator(
      [names = std::move(names)](const std::string& value) {
        if (std::find(names.begin(), names.end(), value) != names.end()) return std::string();
        return fmt::format("'{}': {}", value, expected_one_of(value, names));
      },
      shown);
}

std::string usage_message(const CLI::App& program, const CLI::ParseError& error,
                          const std::vector<std::string>& words) {
  const std::vector<CLI::App*> parsed = program.get_subcommands();
  if (parsed.empty()) {
    if (words.empty()) return "a command is required";
    if (is_option(words[0])) return unknown_option(program, words[0]);
    return fmt::format("unknown command {}{}", words[0],
                       suggestion(words[0], command_names(program)));
  }
  const CLI::App& command = *parsed.front();
  const std::vector<std::string> extras = command.remaining();
  const auto wrong = std::find_if(extras.begin(), extras.end(), is_option);
  if (wrong != extras.end()) return unknown_option(command, *wrong);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) && !extras.empty())
    return fmt::format("unexpected argument {}", extras.front());
  const std::string text = error.what();
  return text.substr(0, text.find('\n'));
}

}  // namespace oriel::app
