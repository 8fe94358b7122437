// SPDX-License-Identifier: Apache-2.0
#include "sdk/library.h"

#include <dlfcn.h>
#include <elf.h>
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace oriel::sdk {
namespace {

namespace fs = std::filesystem;

void add_folders(const std::string& text, TrustedFolders& folders) {
  std::stringstream parts(text);
  for (std::string part; std::getline(parts, part, ':');)
    if (!part.empty()) folders.emplace_back(part);
}

/// What stands at an offset of a file's bytes; false where they end before.
template <class T>
bool read_at(const std::vector<char>& bytes, std::size_t offset, T& value) {
  if (offset > bytes.size() || bytes.size() - offset < sizeof(T)) return false;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return true;
}

std::string text_at(const std::vector<char>& bytes, std::size_t offset) {
  std::string text;
  for (std::size_t i = offset; i < bytes.size() && bytes[i] != 0; ++i) text += bytes[i];
  return text;
}

std::vector<char> read_all(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Why the program cannot load the file; empty when it may.
std::string misfit(const std::vector<char>& bytes) {
  Elf64_Ehdr head;
  if (!read_at(bytes, 0, head) || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0)
    return "it is no shared library of this system";
#if defined(__x86_64__)
  constexpr int kMachine = EM_X86_64;
#elif defined(__aarch64__)
  constexpr int kMachine = EM_AARCH64;
#endif
  if (head.e_ident[EI_CLASS] != ELFCLASS64 || head.e_machine != kMachine)
    return "it was built for another processor";
  if (head.e_type != ET_DYN) return "it is no shared library";
  return {};
}

}  // namespace

std::string library_stem(const std::string& written) {
  const std::size_t slash = written.find_last_of("/\\");
  std::string name = slash == std::string::npos ? written : written.substr(slash + 1);
  for (const char* suffix : {".dll", ".dylib", ".so"})
    if (name.ends_with(suffix)) name.resize(name.size() - std::strlen(suffix));
  return name;
}

TrustedFolders trusted_folders(const std::string& told) {
  TrustedFolders folders;
  add_folders(told, folders);
  if (const char* more = std::getenv("ORIEL_SHADER_PATH")) add_folders(more, folders);
  return folders;
}

std::vector<std::string> missing_symbols(const fs::path& library) {
  const std::vector<char> bytes = read_all(library);
  std::vector<std::string> missing;
  Elf64_Ehdr head;
  if (!read_at(bytes, 0, head)) return missing;
  for (std::size_t i = 0; i < head.e_shnum; ++i) {
    Elf64_Shdr section, names;
    if (!read_at(bytes, head.e_shoff + i * sizeof(Elf64_Shdr), section)) break;
    if (section.sh_type != SHT_DYNSYM) continue;
    if (!read_at(bytes, head.e_shoff + section.sh_link * sizeof(Elf64_Shdr), names)) break;
    for (std::size_t at = 0; at + sizeof(Elf64_Sym) <= section.sh_size; at += sizeof(Elf64_Sym)) {
      Elf64_Sym symbol;
      if (!read_at(bytes, section.sh_offset + at, symbol)) break;
      if (symbol.st_shndx != SHN_UNDEF || ELF64_ST_BIND(symbol.st_info) != STB_GLOBAL) continue;
      const std::string name = text_at(bytes, names.sh_offset + symbol.st_name);
      if (!name.empty() && !dlsym(RTLD_DEFAULT, name.c_str())) missing.push_back(name);
    }
  }
  return missing;
}

std::unique_ptr<Library> Library::open(const std::string& written, SourceLocation where,
                                       const TrustedFolders& folders, Diagnostics& diagnostics) {
  const std::string name = library_stem(written) + ".so";
  fs::path path;
  std::error_code unreadable;
  for (const fs::path& folder : folders)
    if (path.empty() && fs::is_regular_file(folder / name, unreadable)) path = folder / name;
  if (path.empty()) return nullptr;
  if (const std::string reason = misfit(read_all(path)); !reason.empty()) {
    diagnostics.error("OR-SDK-002", where,
                      fmt::format("{} cannot be used: {}", path.string(), reason),
                      "build the shaders for this machine: `oriel shader-build DIR`");
    return nullptr;
  }
  std::unique_ptr<Library> library(new Library);
  library->path_ = path;
  library->file_name_ = name;
  library->handle_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library->handle_) return library;
  const std::string error = dlerror();
  std::string list;
  for (const std::string& symbol : missing_symbols(path)) {
    // Those of libraries that it brings itself are looked for by the loader alone.
    if (symbol.starts_with("mi_") || symbol.starts_with("mayabase_") ||
        error.find(symbol) != std::string::npos)
      list += (list.empty() ? "" : ", ") + symbol;
  }
  diagnostics.error(
      "OR-SDK-003", where,
      list.empty() ? fmt::format("{} cannot be loaded: {}", path.string(), error)
                   : fmt::format("{} cannot be loaded: it asks for functions that Oriel does not "
                                 "offer: {}",
                                 path.string(), list),
      "its shaders are missing in this picture");
  return nullptr;
}

void* Library::find(const std::string& name) const { return dlsym(handle_, name.c_str()); }

Library::~Library() {
  if (handle_) dlclose(handle_);
}

}  // namespace oriel::sdk
