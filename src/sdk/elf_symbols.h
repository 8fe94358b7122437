// SPDX-License-Identifier: Apache-2.0
// Undefined symbols of ELF libraries and object files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace oriel::sdk {

/// Reason why this program cannot load the file as a shared library; empty if it can.
std::string library_misfit(const std::filesystem::path& file);

/// Undefined symbols of a shared library or an object file, except weak ones. Empty for files that
/// are not ELF.
std::vector<std::string> undefined_symbols(const std::filesystem::path& file);

/// Undefined symbols of an ELF shared library that no loaded module provides, except weak ones.
std::vector<std::string> missing_symbols(const std::filesystem::path& library);

/// Whether a name belongs to the shader interface, as a C or C++ symbol.
bool is_interface_name(const std::string& symbol);

/// Readable form of a symbol: C++ names are demangled.
std::string readable_symbol(const std::string& symbol);

}  // namespace oriel::sdk
