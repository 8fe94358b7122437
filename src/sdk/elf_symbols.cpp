// SPDX-License-Identifier: Apache-2.0
#include "sdk/elf_symbols.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <elf.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>

namespace oriel::sdk {
namespace {

namespace fs = std::filesystem;

/// Reads a value at a file offset; returns false beyond the end.
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

}  // namespace

std::string library_misfit(const fs::path& file) {
  Elf64_Ehdr head;
  const std::vector<char> bytes = read_all(file);
  if (bytes.size() > 2 && bytes[0] == 'M' && bytes[1] == 'Z')
    return "it is a Windows library, not a shared library of this system";
  if (!read_at(bytes, 0, head) || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0)
    return "it is not a shared library of this system";
#if defined(__x86_64__)
  constexpr int kMachine = EM_X86_64;
#elif defined(__aarch64__)
  constexpr int kMachine = EM_AARCH64;
#endif
  if (head.e_ident[EI_CLASS] == ELFCLASS32) return "it was built for a 32-bit processor";
  if (head.e_ident[EI_CLASS] != ELFCLASS64 || head.e_machine != kMachine)
    return "it was built for another processor";
  if (head.e_type != ET_DYN) return "it is not a shared library";
  return {};
}

std::vector<std::string> undefined_symbols(const fs::path& file) {
  const std::vector<char> bytes = read_all(file);
  std::vector<std::string> undefined;
  Elf64_Ehdr head;
  if (!read_at(bytes, 0, head) || std::memcmp(head.e_ident, ELFMAG, SELFMAG) != 0) return undefined;
  const Elf64_Word table = head.e_type == ET_DYN ? SHT_DYNSYM : SHT_SYMTAB;
  for (std::size_t i = 0; i < head.e_shnum; ++i) {
    Elf64_Shdr section, names;
    if (!read_at(bytes, head.e_shoff + i * sizeof(Elf64_Shdr), section)) break;
    if (section.sh_type != table) continue;
    if (!read_at(bytes, head.e_shoff + section.sh_link * sizeof(Elf64_Shdr), names)) break;
    for (std::size_t at = 0; at + sizeof(Elf64_Sym) <= section.sh_size; at += sizeof(Elf64_Sym)) {
      Elf64_Sym symbol;
      if (!read_at(bytes, section.sh_offset + at, symbol)) break;
      if (symbol.st_shndx != SHN_UNDEF || ELF64_ST_BIND(symbol.st_info) != STB_GLOBAL) continue;
      if (std::string name = text_at(bytes, names.sh_offset + symbol.st_name); !name.empty())
        undefined.push_back(std::move(name));
    }
  }
  return undefined;
}

std::vector<std::string> missing_symbols(const fs::path& library) {
  std::vector<std::string> missing = undefined_symbols(library);
  std::erase_if(missing, [](const std::string& name) {
    return dlsym(RTLD_DEFAULT, name.c_str()) != nullptr;
  });
  return missing;
}

bool is_interface_name(const std::string& symbol) {
  // C++ sources may declare interface functions without extern "C".
  const std::string readable = readable_symbol(symbol);
  for (const char* prefix : {"mi_", "mayabase_", "mi::"})
    if (readable.starts_with(prefix)) return true;
  return false;
}

std::string readable_symbol(const std::string& symbol) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &status), std::free);
  return symbol.starts_with("_Z") && name ? name.get() : symbol;
}

}  // namespace oriel::sdk
