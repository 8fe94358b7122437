// SPDX-License-Identifier: Apache-2.0
// The secret that a client of the server has to know.
#pragma once

#include <string>
#include <string_view>

namespace oriel::studio {

/// 256 random bits of the system as 64 hexadecimal digits.
/// Errors:  std::runtime_error if the system has none.
std::string make_token();

/// Whether both are equal; the time depends on the length of `given` alone.
/// Checked: StudioToken.*
bool is_same_token(std::string_view expected, std::string_view given);

}  // namespace oriel::studio
