// SPDX-License-Identifier: Apache-2.0
// The stable codes of everything the .mi reader may say.
#pragma once

#include <string_view>

namespace oriel::mi::code {

using Code = std::string_view;

// Text
inline constexpr Code kSyntax = "OR-MI-001";        ///< error: unexpected token; element cut short
inline constexpr Code kUnterminated = "OR-MI-002";  ///< error: string, pixels or binary never close
inline constexpr Code kBadCharacter = "OR-MI-003";  ///< warning: a byte that starts no token
inline constexpr Code kNumberRange = "OR-MI-004";   ///< warning: overflowing number, clamped
inline constexpr Code kMissingComma = "OR-MI-005";  ///< warning: two parameters without a comma
inline constexpr Code kNesting = "OR-MI-006";       ///< error: values nested too deeply
inline constexpr Code kUnclosed = "OR-MI-007";      ///< error: the file ends inside an element
inline constexpr Code kBadBinary = "OR-MI-008";  ///< error: a binary or pixel block of wrong size
// Files
inline constexpr Code kMissingInclude = "OR-MI-010";    ///< warning: include not found
inline constexpr Code kForbiddenInclude = "OR-MI-011";  ///< warning: outside the allowed folders
inline constexpr Code kIncludeCycle = "OR-MI-012";      ///< error: a file includes itself
inline constexpr Code kIncludeLimit = "OR-MI-013";      ///< error: includes too deep or too many
inline constexpr Code kUnreadable = "OR-MI-014";        ///< error: cannot be read, or too large
inline constexpr Code kConditional = "OR-MI-015";       ///< warning: $else, $endif out of place
inline constexpr Code kUnknownDirective = "OR-MI-016";  ///< warning: unknown $ command
// Statements
inline constexpr Code kUnknownStatement =
    "OR-MI-020";                                  ///< warning: no such statement here, skipped
inline constexpr Code kObsolete = "OR-MI-021";    ///< error: frame/view form of version 1.9
inline constexpr Code kRefused = "OR-MI-022";     ///< warning: would run foreign code; kept only
inline constexpr Code kRedefined = "OR-MI-023";   ///< warning: name used again, last one wins
inline constexpr Code kNotThere = "OR-MI-024";    ///< warning: incremental/delete of nothing
inline constexpr Code kIgnored = "OR-MI-025";     ///< note: read, has no place in the scene
inline constexpr Code kNoContent = "OR-MI-026";   ///< warning: a placeholder's file lacks it
inline constexpr Code kStrayToken = "OR-MI-027";  ///< warning: no statement begins here, skipped
// Names
inline constexpr Code kUnknownShader = "OR-MI-030";     ///< warning: shader type nobody declares
inline constexpr Code kUnresolved = "OR-MI-031";        ///< warning: element that does not exist
inline constexpr Code kUnknownParameter = "OR-MI-032";  ///< warning: not in the declaration
inline constexpr Code kTooManyValues = "OR-MI-033";     ///< warning: more numbers than the type has
// Geometry
inline constexpr Code kBadIndex = "OR-MI-040";    ///< warning: index beyond the list
inline constexpr Code kBadPolygon = "OR-MI-041";  ///< warning: polygon dropped
inline constexpr Code kBadCount = "OR-MI-042";    ///< error: a list is not as long as announced
inline constexpr Code kSingular = "OR-MI-043";    ///< warning: singular transform, identity instead

/// How a user may have code of a scene run.
inline constexpr std::string_view kTrustHint =
    "build it with `oriel shader-build` and name its folder with --shader-path; or --trust-code, "
    "if you trust the scene as yourself";

}  // namespace oriel::mi::code
