// SPDX-License-Identifier: Apache-2.0
// The flags of the old stand-alone program: names, what follows them, what they act on.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/value.h"

namespace oriel::app {

/// What a flag acts on.
enum class RayTarget : std::uint8_t {
  Options,  ///< a statement of the options block
  Camera,   ///< a statement of the camera
  Program,  ///< the run itself
  Nothing   ///< read for old scripts' sake
};

struct RayFlag {
  std::string name;  ///< without the dash
  std::string form;  ///< what follows, as scene/statement_table.h writes it; `...` = up to `--`
  RayTarget target;
  std::string statement;  ///< keyword that it stands for; empty where there is none
  std::string meaning;
  bool acts = true;  ///< false: the picture does not depend on it
};

/// All flags by name. Every statement of the options block that takes few values is one, its blanks
/// as underscores.
const std::vector<RayFlag>& ray_flags();

/// A flag with what followed it.
struct RayCall {
  const RayFlag* flag;
  std::string keyword;               ///< statement, with words that belong to it
  std::vector<scene::Value> values;  ///< one per word, typed as the language would
  std::vector<std::string> words;    ///< the same as written
};

struct RayLine {
  std::vector<RayCall> calls;
  std::vector<std::string> scenes;
};

/// Reads a command line. Flags may be shortened as long as one alone begins so.
///
/// Errors:  UsageError: an unknown flag (with the nearest), one that several begin with (with
///          their names), values that do not fit.
/// Checked: RayProgram.* in tests/cli/ray_test.cpp
RayLine read_ray_line(std::span<const std::string> arguments);

}  // namespace oriel::app
