// SPDX-License-Identifier: Apache-2.0
#include "shader_link.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/file_text.h"
#include "command.h"
#include "sdk/elf_symbols.h"

namespace oriel::app {
namespace {

std::vector<std::string> link_words(const ShaderLink& link, const std::string& path) {
  std::vector<std::string> words = {"-shared", "-o", path};
  for (const CompiledSource* source : link.sources) words.push_back(source->object);
  words.insert(words.end(), link.archives.begin(), link.archives.end());
  words.insert(words.end(), link.flags.begin(), link.flags.end());
  words.emplace_back("-lm");
  return words;
}

/// Symbols that a library needs and neither this program nor a library of the link offers.
std::vector<std::string> not_defined(const ShaderLink& link, const std::string& path,
                                     const std::string& work, Compiler& linker) {
  std::vector<std::string> missing = sdk::missing_symbols(path);
  if (missing.empty()) return missing;
  // What libraries of the link define, the linker knows.
  std::vector<std::string> words = link_words(link, work + "/probe.so");
  for (const char* word : {"-Wl,-z,defs", "-Wl,--no-demangle", "-Wl,--warn-unresolved-symbols"})
    words.emplace_back(word);
  const std::string log = work + "/undefined.log";
  linker.run(words, log);
  const std::string messages = file_text(log);
  std::erase_if(missing, [&](const std::string& name) {
    return messages.find("`" + name + "'") == std::string::npos &&
           messages.find("symbol: " + name) == std::string::npos;
  });
  return missing;
}

bool needs(const CompiledSource& source, const std::string& symbol) {
  const std::vector<std::string> undefined = sdk::undefined_symbols(source.object);
  return std::find(undefined.begin(), undefined.end(), symbol) != undefined.end();
}

/// Names an undefined symbol, the sources that need it, and what to do.
void print_undefined(const std::string& symbol, const ShaderLink& link,
                     const std::vector<CompiledSource>& helpers) {
  std::vector<std::string> sources;
  for (const CompiledSource* source : link.sources)
    if (needs(*source, symbol)) sources.push_back(source->source);
  for (const CompiledSource& helper : helpers)
    if (needs(helper, symbol)) sources.push_back(helper.source);
  fmt::print(stderr, "oriel: {}: {} is {}\n",
             sources.empty() ? "an archive" : fmt::format("{}", fmt::join(sources, ", ")),
             sdk::readable_symbol(symbol),
             sdk::is_interface_name(symbol)
                 ? "not offered: see docs/c-interface-functions.md"
                 : "not defined: give the source, folder or archive that defines it with --helper");
}

void show_log(const std::string& log, BuildHints& hints) {
  const std::string messages = file_text(log);
  std::fwrite(messages.data(), 1, messages.size(), stderr);
  hints.read(messages);
}

}  // namespace

void link_shaders(const ShaderLink& link, const std::vector<CompiledSource>& helpers,
                  const std::string& path, const std::string& work, ShaderCompilers& compilers,
                  BuildHints& hints) {
  const auto in_c = [](const CompiledSource* source) { return source->c; };
  const bool all_c = std::all_of(link.sources.begin(), link.sources.end(), in_c) &&
                     std::all_of(helpers.begin(), helpers.end(),
                                 [](const CompiledSource& helper) { return helper.c; });
  Compiler& linker = compilers.of(all_c);
  const std::string log = work + "/link.log";
  const bool linked = linker.run(link_words(link, path), log);
  show_log(log, hints);
  if (!linked) throw UserError("the sources could not be linked; nothing was written");
  const std::vector<std::string> missing = not_defined(link, path, work, linker);
  for (const std::string& symbol : missing) print_undefined(symbol, link, helpers);
  if (!missing.empty())
    throw UserError(fmt::format("{} undefined symbol{}; nothing was written", missing.size(),
                                missing.size() == 1 ? "" : "s"));
}

void archive_objects(const std::vector<CompiledSource>& sources, const std::string& path,
                     const std::string& work) {
  Compiler archiver("archive (ar)", "AR in the environment", "", "AR", {"ar", "gcc-ar", "llvm-ar"});
  std::vector<std::string> words = {"rcs", path};
  for (const CompiledSource& source : sources) words.push_back(source.object);
  const std::string log = work + "/ar.log";
  if (archiver.run(words, log)) return;
  fmt::print(stderr, "{}", file_text(log));
  throw UserError("the archive of the helpers could not be made; nothing was written");
}

}  // namespace oriel::app
