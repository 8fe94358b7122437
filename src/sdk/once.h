// SPDX-License-Identifier: Apache-2.0
// Warnings that are issued once per scene: Host::warn_once for code without a Host.
#pragma once

#include <string>

namespace oriel::sdk {

/// Warns about a function that accepts its arguments without effect: "FUNCTION: TEXT", at its first
/// call by a shader.
void warn_no_effect(const char* function, const char* text);

/// Warns once per text; does nothing if no shader is running.
void warn_once(const char* code, const std::string& text);

}  // namespace oriel::sdk
