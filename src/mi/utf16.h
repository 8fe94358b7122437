// SPDX-License-Identifier: Apache-2.0
// Text that an editor of Windows saved as "Unicode".
#pragma once

#include <string>
#include <string_view>

namespace oriel::mi {

/// Whether the bytes begin with a byte order mark of UTF-16, of either byte order.
bool is_utf16(std::string_view bytes);

/// The text in UTF-8, without its mark. Half a surrogate pair becomes U+FFFD; an odd last byte is
/// dropped.
///
/// Source:  The Unicode Standard 15, tables 3-5 and 3-6.
/// Checked: LineEndsAndEncodings.* in source_test.cpp
std::string utf8_of_utf16(std::string_view bytes);

}  // namespace oriel::mi
