// SPDX-License-Identifier: Apache-2.0
// Text for terminals: names from files must not control them.
#pragma once

#include <string>
#include <string_view>

namespace oriel {

/// The text with escapes in place of control characters: \x1b for those below 0x20 except line feed
/// and tab, and for bytes that are not UTF-8; \u0085 for 0x7f to 0x9f and for characters that
/// change the direction of text. The latter form is also an escape of JSON.
/// Source:  ECMA-48, C0 and C1 sets; Unicode 15, 23.2 and 23.3; Unicode Technical Report 36, 2.4.
/// Checked: Printable.*
std::string printable(std::string_view text);

/// Number of bytes at the end that begin a UTF-8 character which is not complete.
/// Checked: Printable.IncompleteCharactersAtTheEndAreCounted
std::size_t incomplete_end(std::string_view text);

}  // namespace oriel
