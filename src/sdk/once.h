// SPDX-License-Identifier: Apache-2.0
// Warnings that are given once for each scene: Host::warn_once for code without a Host.
#pragma once

#include <string>

namespace oriel::sdk {

/// Warns of a function that accepts its arguments and does nothing: "FUNCTION: TEXT", the first
/// time that a shader calls the function.
void warn_no_effect(const char* function, const char* text);

/// Warns once for each text; nothing where no shader runs.
void warn_once(const char* code, const std::string& text);

}  // namespace oriel::sdk
