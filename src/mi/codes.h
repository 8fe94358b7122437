// SPDX-License-Identifier: Apache-2.0
// Stable codes of the diagnostics of the .mi reader.
#pragma once

#include <string_view>

namespace oriel::mi::code {

using Code = std::string_view;

// Text
inline constexpr Code kSyntax = "OR-MI-001";        ///< error: unexpected token; element incomplete
inline constexpr Code kUnterminated = "OR-MI-002";  ///< error: unclosed string, pixels or binary
inline constexpr Code kBadCharacter = "OR-MI-003";  ///< warning: byte that starts no token
inline constexpr Code kNumberRange = "OR-MI-004";   ///< warning: overflowing number, clamped
inline constexpr Code kMissingComma = "OR-MI-005";  ///< warning: two parameters without a comma
inline constexpr Code kNesting = "OR-MI-006";       ///< error: values nested too deeply
inline constexpr Code kUnclosed = "OR-MI-007";      ///< error: the file ends inside an element
inline constexpr Code kBadBinary = "OR-MI-008";  ///< error: a binary or pixel block of wrong size
// Files
inline constexpr Code kMissingInclude = "OR-MI-010";    ///< warning: include not found
inline constexpr Code kForbiddenInclude = "OR-MI-011";  ///< warning: outside the permitted folders
inline constexpr Code kIncludeCycle = "OR-MI-012";      ///< error: a file includes itself
inline constexpr Code kIncludeLimit = "OR-MI-013";      ///< error: includes too deep or too many
inline constexpr Code kUnreadable = "OR-MI-014";        ///< error: cannot be read
inline constexpr Code kConditional = "OR-MI-015";       ///< warning: $else, $endif out of place
inline constexpr Code kUnknownDirective = "OR-MI-016";  ///< warning: unknown $ command
inline constexpr Code kTextBudget = "OR-MI-017";        ///< error: text exceeds its budget
// Statements
inline constexpr Code kUnknownStatement = "OR-MI-020";  ///< warning: unknown statement, skipped
inline constexpr Code kObsolete = "OR-MI-021";          ///< error: frame/view form of version 1.9
inline constexpr Code kRefused = "OR-MI-022";     ///< warning: foreign code, stored and not run
inline constexpr Code kRedefined = "OR-MI-023";   ///< warning: duplicate name, last one wins
inline constexpr Code kNotThere = "OR-MI-024";    ///< warning: incremental/delete of missing name
inline constexpr Code kIgnored = "OR-MI-025";     ///< note: valid syntax without effect
inline constexpr Code kNoContent = "OR-MI-026";   ///< warning: placeholder file lacks the element
inline constexpr Code kStrayToken = "OR-MI-027";  ///< warning: token outside of statements, skipped
// Names
inline constexpr Code kUnknownShader = "OR-MI-030";     ///< warning: undeclared shader type
inline constexpr Code kUnresolved = "OR-MI-031";        ///< warning: missing element
inline constexpr Code kUnknownParameter = "OR-MI-032";  ///< warning: not in the declaration
inline constexpr Code kTooManyValues = "OR-MI-033";     ///< warning: more numbers than the type has
// Geometry
inline constexpr Code kBadIndex = "OR-MI-040";    ///< warning: index out of range
inline constexpr Code kBadPolygon = "OR-MI-041";  ///< warning: polygon dropped
inline constexpr Code kBadCount = "OR-MI-042";    ///< error: list length differs from its count
inline constexpr Code kSingular = "OR-MI-043";    ///< warning: singular transform, identity used

/// Hint of the diagnostics about code in a scene.
inline constexpr std::string_view kTrustHint =
    "build it with `oriel shader-build` and name its folder with --shader-path; or --trust-code, "
    "if you trust the scene as yourself";

}  // namespace oriel::mi::code
