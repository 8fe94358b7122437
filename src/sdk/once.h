// SPDX-License-Identifier: Apache-2.0
// Warnings about functions that accept their arguments and do nothing.
#pragma once

namespace oriel::sdk {

/// Warns "FUNCTION: TEXT", the first time in a frame that a shader calls the function.
void warn_once(const char* function, const char* text);

}  // namespace oriel::sdk
