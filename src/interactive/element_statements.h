// SPDX-License-Identifier: Apache-2.0
// Edits of an element's own statements: options, cameras, lights, instances, textures.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace oriel::interactive {

enum class StatementEdit : std::uint8_t {
  Done,
  NoStatements,  ///< the element is of a kind whose statements cannot be edited
  Unknown,       ///< there is no such statement
  BadValue,
};

/// Sets a statement of an element.
///
/// Inputs:  before: called before the element is changed; may be empty.
/// Returns: in `known` the names of the statements if there is none of that name.
/// Checked: EditTable.*
StatementEdit set_statement(scene::Element& element, const std::string& name,
                            const scene::Value& value,
                            const std::function<void(const scene::Element&)>& before,
                            std::vector<std::string>& known);

/// A statement with its present value, for panels.
struct StatementValue {
  std::string name;
  std::string_view form, meaning;    ///< as in scene/statement_table.h; empty for typed fields
  bool quoted = false;               ///< a string option
  std::vector<scene::Value> values;  ///< empty: the scene has no such statement
};

/// The statements that set_statement() accepts for an element.
std::vector<StatementValue> statements_of(const scene::Element& element);

}  // namespace oriel::interactive
