// SPDX-License-Identifier: Apache-2.0
#include "sdk/library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>

#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "base/input_files.h"
#include "sdk/crash.h"
#include "sdk/elf_symbols.h"

namespace oriel::sdk {
namespace {

namespace fs = std::filesystem;

void add_folders(const std::string& text, TrustedFolders& folders) {
  std::stringstream parts(text);
  for (std::string part; std::getline(parts, part, ':');)
    if (!part.empty()) folders.emplace_back(part);
}

/// Whether the message of the loader refers to this symbol.
bool names_symbol(const std::string& error, const std::string& symbol) {
  const std::size_t at = error.find("symbol: " + symbol);
  if (at == std::string::npos) return false;
  const char after = error.c_str()[at + 8 + symbol.size()];
  return after == 0 || after == ',' || after == ' ' || after == '\n';
}

/// Reports why a library cannot be loaded, with hints.
void report_unloadable(const fs::path& path, const std::string& error, SourceLocation where,
                       Diagnostics& diagnostics) {
  std::vector<std::string> interface, others;
  for (const std::string& symbol : missing_symbols(path)) {
    if (is_interface_name(symbol))
      interface.push_back(readable_symbol(symbol));
    else if (names_symbol(error, symbol))  // other symbols may be defined by its dependencies
      others.push_back(readable_symbol(symbol));
  }
  std::string reason = error, hint;
  if (!interface.empty() || !others.empty()) reason.clear();
  if (!interface.empty()) {
    reason = fmt::format("it requires functions that Oriel does not provide: {}",
                         fmt::join(interface, ", "));
    hint =
        "build it without the sources that call them (docs/c-interface-functions.md lists what "
        "is offered); ";
  }
  if (!others.empty()) {
    reason += fmt::format("{}it requires {}, which no library defines", reason.empty() ? "" : "; ",
                          fmt::join(others, ", "));
    hint +=
        "build it with the missing source or archive: `oriel shader-build DIR --helper "
        "PATH`; ";
  }
  if (error.find("cannot open shared object file") != std::string::npos)
    hint += "install that library, or name its folder in LD_LIBRARY_PATH; ";
  diagnostics.error("OR-SDK-003", where,
                    fmt::format("{} cannot be loaded: {}", path.string(), reason),
                    hint + "its shaders are missing in the picture");
}

}  // namespace

std::string library_stem(const std::string& written) {
  const std::size_t slash = written.find_last_of("/\\");
  std::string name = slash == std::string::npos ? written : written.substr(slash + 1);
  for (const char* suffix : {".dll", ".dylib", ".so"})
    if (name.ends_with(suffix)) name.resize(name.size() - std::strlen(suffix));
  return name;
}

TrustedFolders trusted_folders(const std::string& told, bool untrusted) {
  TrustedFolders folders;
  add_folders(told, folders);
  const char* const more = untrusted ? nullptr : std::getenv("ORIEL_SHADER_PATH");
  if (more) add_folders(more, folders);
  return folders;
}

std::unique_ptr<Library> Library::open(const std::string& written, SourceLocation where,
                                       const TrustedFolders& folders, Diagnostics& diagnostics) {
  const std::string name = library_stem(written) + ".so";
  fs::path path;
  std::error_code unreadable;
  for (const fs::path& folder : folders)
    if (path.empty() && fs::is_regular_file(folder / name, unreadable)) path = folder / name;
  if (path.empty()) return nullptr;
  if (const std::string reason = library_misfit(path); !reason.empty()) {
    diagnostics.error("OR-SDK-002", where,
                      fmt::format("{} cannot be used: {}", path.string(), reason),
                      "build the shaders for this machine: `oriel shader-build DIR`");
    return nullptr;
  }
  std::unique_ptr<Library> library(new Library);
  library->path_ = path;
  library->file_name_ = name;
  note_input_file(path.string(), InputKind::Frame);
  install_crash_handlers();
  Running running{nullptr, "a static constructor", &library->file_name_};
  if (!run_guarded(running,
                   [&] { library->handle_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); }))
    // Exit: the loader still holds its lock, so other threads would wait forever.
    throw std::runtime_error(fmt::format("error: {} [OR-SDK-005]", describe(running)));
  if (library->handle_) {
    const auto* map = static_cast<const link_map*>(library->handle_);
    watch_library(map->l_ld, name);
    return library;
  }
  report_unloadable(path, dlerror(), where, diagnostics);
  return nullptr;
}

void* Library::find(const std::string& name) const { return dlsym(handle_, name.c_str()); }

std::string Library::close() {
  void* const handle = std::exchange(handle_, nullptr);
  if (!handle) return {};
  Running running{nullptr, "a static destructor", &file_name_};
  const bool done = run_guarded(running, [&] { dlclose(handle); });
  unwatch_library(file_name_);
  return done ? std::string() : describe(running);
}

Library::~Library() { close(); }

}  // namespace oriel::sdk
