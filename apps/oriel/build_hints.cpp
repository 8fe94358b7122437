// SPDX-License-Identifier: Apache-2.0
#include "build_hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>

#include "sdk/elf_symbols.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& line, const char* text) { return line.find(text) != std::string::npos; }

/// The text between two others; empty where they are not there.
std::string between(const std::string& line, const char* before, const char* after) {
  std::size_t at = line.find(before);
  if (at == std::string::npos) return {};
  at += std::string(before).size();
  const std::size_t end = line.find(after, at);
  return end == std::string::npos ? std::string() : line.substr(at, end - at);
}

/// Macros are written so.
bool is_in_capitals(const std::string& name) {
  return name.size() > 1 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isupper(c) || std::isdigit(c) || c == '_';
         });
}

bool is_path_end(const std::string& path, const std::string& end) {
  return path.size() > end.size() && path.ends_with(end) &&
         path[path.size() - end.size() - 1] == '/';
}

/// The folder below `root` from which `name` is found; empty where there is none.
std::string folder_of(const fs::path& root, const std::string& name) {
  constexpr int kMaxFiles = 20000;  // a source may lie in somebody's home
  std::error_code error;
  fs::recursive_directory_iterator at(root.empty() ? "." : root, error);
  const fs::recursive_directory_iterator end;
  for (int i = 0; !error && at != end && i < kMaxFiles; ++i, at.increment(error)) {
    const std::string path = at->path().string();
    if (is_path_end(path, name)) return path.substr(0, path.size() - name.size() - 1);
  }
  return {};
}

}  // namespace

std::string without_colours(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\x1b')
      plain += text[i];
    else
      while (i + 1 < text.size() && !std::isalpha(static_cast<unsigned char>(text[++i])))
        ;
  }
  return plain;
}

void BuildHints::add(std::string hint) {
  if (std::find(hints_.begin(), hints_.end(), hint) == hints_.end())
    hints_.push_back(std::move(hint));
}

void BuildHints::read(const std::string& messages) {
  std::istringstream lines(without_colours(messages));
  failed_ = has(lines.str(), "error: ");
  for (std::string line; std::getline(lines, line);) read_line(line);
}

void BuildHints::missing_header(const std::string& name) {
  if (name == "windows.h")
    return add("windows.h belongs to Windows: enclose its include in #ifdef _WIN32 and #endif");
  for (const char* old : {"iostream.h", "fstream.h", "iomanip.h", "strstream.h"})
    if (name == old)
      return add(
          fmt::format("{} is older than standard C++: write #include <{}> and 'using "
                      "namespace std;'",
                      name, name.substr(0, name.size() - 2)));
  for (const std::string& folder : folders_)
    if (const std::string found = folder_of(folder, name); !found.empty())
      return add(fmt::format("{} is in {}: add -I {}", name, found, found));
  add(fmt::format("{} was not found: name the folder that holds it with -I FOLDER", name));
}

void BuildHints::unknown_name(const std::string& name) {
  if (sdk::is_interface_name(name))
    add(fmt::format("{} is not offered: see docs/c-interface-functions.md", name));
  else if (is_in_capitals(name))
    add(fmt::format("{} is defined nowhere: if it is a macro, give it with -D {}=VALUE", name,
                    name));
}

void BuildHints::read_line(const std::string& line) {
  if (has(line, "No such file or directory"))
    missing_header(between(line, "fatal error: ", ": No such"));
  else if (has(line, "' file not found"))
    missing_header(between(line, "fatal error: '", "' file not found"));
  for (const char* end : {"' undeclared", "' was not declared in this scope"})
    if (has(line, end)) unknown_name(between(line, "error: '", end));
  if (has(line, "use of undeclared identifier '"))
    unknown_name(between(line, "undeclared identifier '", "'"));
  if (has(line, "error: #error"))
    add("#error: the source requires a macro of its build; give it with -D NAME or -D NAME=VALUE");
  const std::string since = between(line, "only available from C++", " onwards");
  if (!since.empty()) add(fmt::format("the source is newer C++: add --std=gnu++{}", since));
  for (const char* strict :
       {"unable to find string literal operator", "ISO C++17 does not allow",
        "ISO C++11 does not allow", "invalid suffix on literal", "reserved user-defined literal"})
    if (has(line, strict)) add("the source is older C++: add --std=gnu++98");
  if (has(line, "only allowed in C99") || has(line, "C++ style comments are not allowed"))
    add("the source is newer C: add --std=gnu99");
  if (has(line, "[-Werror=return-type]"))
    add("this compiler may miscompile functions without 'return': write one, or build with GCC "
        "(--cxx g++)");
  else if (has(line, "[-Wreturn-type]") && !failed_)  // else it may follow from an error
    add("the result of a function that ends without 'return' is undefined: write 'return miTRUE;'");
  if (has(line, "recompile with -fPIC"))
    add("an archive must be compiled with -fPIC: compile it again so, or give its sources to "
        "--helper");
  if (const std::string twice = between(line, "multiple definition of `", "'"); !twice.empty())
    add(
        fmt::format("{} is defined twice: build one library for each source (--each), or leave a "
                    "source out with 'skip' in the manifest",
                    twice));
}

}  // namespace oriel::app
