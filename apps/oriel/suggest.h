// SPDX-License-Identifier: Apache-2.0
// Messages of wrong commands, options and values, with the nearest name that exists.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "command.h"

namespace oriel::app {

/// "; did you mean NAME?" with the nearest candidate; empty if none is near (see nearest_name).
std::string suggestion(std::string_view name, std::span<const std::string> candidates);

/// "expected a, b or c; did you mean b?", for a value that is none of `names`.
std::string expected_one_of(std::string_view value, const std::vector<std::string>& names);

/// Check of an option that accepts only these values.
CLI::Validator one_of(std::vector<std::string> names);

/// Message of an error of the command line: names the unknown command or option if there is one.
///
/// Inputs:  words: the command line without the name of the program.
/// Checked: Suggestions.* in tests/cli/suggest_test.cpp
std::string usage_message(const CLI::App& program, const CLI::ParseError& error,
                          const std::vector<std::string>& words);

}  // namespace oriel::app
