// SPDX-License-Identifier: Apache-2.0
// Symbols of ELF files: what a library or an object file needs from elsewhere.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace oriel::sdk {

/// Why this program cannot load the file as a shared library; empty when it may.
std::string library_misfit(const std::filesystem::path& file);

/// Undefined symbols of a shared library or an object file; weak ones are not counted. Empty for
/// files that are not ELF.
std::vector<std::string> undefined_symbols(const std::filesystem::path& file);

/// Undefined symbols of an ELF shared library that nothing loaded offers; weak ones not counted.
std::vector<std::string> missing_symbols(const std::filesystem::path& library);

/// Whether a name belongs to the interface for shaders, in C or as a C++ symbol.
bool is_interface_name(const std::string& symbol);

/// A symbol as its source writes it: C++ names demangled, others as they are.
std::string readable_symbol(const std::string& symbol);

}  // namespace oriel::sdk
