// SPDX-License-Identifier: Apache-2.0
// Arrays and structures as text of edits, in the form of the scene language.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene/value.h"

namespace oriel::interactive {

/// Whether the text of a value starts an array `[...]` or a structure `{...}`.
bool is_structured(std::string_view text);

/// Parses `[ VALUE, ... ]` and `{ "NAME" VALUE, ... }`. Values are numbers, strings in quotes, on
/// and off, `= "SHADER"`, arrays and structures. Unset if the text has another form or is nested
/// deeper than kMaxValueDepth. Checked: StructuredValue.*
inline constexpr int kMaxValueDepth = 16;
std::optional<scene::Value> parse_structured(std::string_view text);

/// The text of a value, which parse_structured() reads if it is an array or a structure.
std::string structured_text(const scene::Value& value);

}  // namespace oriel::interactive
