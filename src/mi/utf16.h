// SPDX-License-Identifier: Apache-2.0
// UTF-16 text, as Windows editors save "Unicode".
#pragma once

#include <string>
#include <string_view>

namespace oriel::mi {

/// Whether the bytes begin with a UTF-16 byte order mark of either byte order.
bool is_utf16(std::string_view bytes);

/// Converts to UTF-8 without the byte order mark. An unpaired surrogate becomes U+FFFD; an odd last
/// byte is dropped.
///
/// Source:  The Unicode Standard 15, tables 3-5 and 3-6.
/// Checked: LineEndsAndEncodings.* in source_test.cpp
std::string utf8_of_utf16(std::string_view bytes);

}  // namespace oriel::mi
