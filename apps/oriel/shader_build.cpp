// SPDX-License-Identifier: Apache-2.0
#include "shader_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/durable_file.h"
#include "base/file_text.h"
#include "base/temporary_folder.h"
#include "command.h"
#include "include_shim.h"
#include "shader_link.h"
#include "shader_sources.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

/// Where shader.h is: as asked, ORIEL_SDK, beside the installed program, in the source tree.
std::string find_headers(const std::string& asked) {
  std::error_code error;
  const auto checked = [](const std::string& folder, const char* who) {
    if (!fs::exists(fs::path(folder) / "shader.h"))
      throw UserError(fmt::format("{} '{}': there is no shader.h in it", who, folder));
    return folder;
  };
  if (!asked.empty()) return checked(asked, "--include");
  if (const char* said = std::getenv("ORIEL_SDK"); said != nullptr && *said != '\0')
    return checked(said, "ORIEL_SDK");
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "include" / "oriel" / "sdk";
  if (!error && fs::exists(installed / "shader.h", error)) return installed.string();
  if (fs::exists(fs::path(ORIEL_SDK_FOLDER) / "shader.h", error)) return ORIEL_SDK_FOLDER;
  throw UserError(
      fmt::format("the headers for shaders are not in '{}'; name their folder with "
                  "--include or ORIEL_SDK",
                  installed.string()));
}

/// Folders of sources, then those of further headers, each once.
std::vector<std::string> folders_of(const ShaderBuild& build) {
  std::vector<std::string> folders;
  const auto add = [&](const fs::path& folder) {
    const std::string text = folder.empty() ? "." : folder.string();
    if (std::find(folders.begin(), folders.end(), text) == folders.end()) folders.push_back(text);
  };
  for (const std::string& source : build.sources) add(fs::path(source).parent_path());
  for (const std::string& source : build.helpers) add(fs::path(source).parent_path());
  for (const std::string& folder : build.include_folders) add(folder);
  return folders;
}

/// Headers that are missing are often in a folder beside.
std::vector<std::string> with_parents(std::vector<std::string> folders) {
  for (std::size_t i = 0, count = folders.size(); i < count; ++i)
    if (const fs::path parent = fs::path(folders[i]).parent_path(); !parent.empty())
      folders.push_back(parent.string());
  return folders;
}

/// Where the compiler looks for headers: Oriel's own come first, so that another shader.h in a
/// folder of -I is not taken for it.
std::vector<std::string> include_flags(const ShaderBuild& build,
                                       const std::vector<std::string>& folders,
                                       const std::string& sdk, const TemporaryFolder& work) {
  std::vector<std::string> read = build.sources;
  read.insert(read.end(), build.helpers.begin(), build.helpers.end());
  for (const std::string& folder : folders)
    for (std::string& header : headers_in(folder)) read.push_back(std::move(header));
  std::vector<StrayInclude> stray;
  const std::string shim = write_include_shim(read, sdk, folders, work.file("include"), stray);
  for (const StrayInclude& s : stray)
    fmt::print(stderr, "oriel: {}:{}: there is no \"{}\" here; write #include <{}>\n", s.file,
               s.line, s.name, fs::path(s.name).filename().string());
  std::vector<std::string> flags = {"-I" + sdk};
  if (!shim.empty()) flags.push_back("-I" + shim);
  for (const std::string& folder : build.include_folders) flags.push_back("-I" + folder);
  // The helpers' headers, for the sources that call them.
  for (const std::string& helper : build.helpers) {
    const std::string folder = "-I" + (fs::path(helper).parent_path() / "").string();
    if (folder != "-I" && std::find(flags.begin(), flags.end(), folder) == flags.end())
      flags.push_back(folder);
  }
  return flags;
}

/// "shader.h" in quotes is looked for beside the source first: another renderer's would be taken.
void warn_of_other_headers(const std::vector<std::string>& sources, const std::string& sdk) {
  std::set<fs::path> seen;
  for (const std::string& source : sources) {
    fs::path folder = fs::path(source).parent_path();
    if (folder.empty()) folder = ".";
    if (!seen.insert(folder).second || fs::equivalent(folder, sdk)) continue;
    for (const std::string& header : headers_in(folder))
      if (fs::exists(fs::path(sdk) / fs::path(header).filename()))
        fmt::print(stderr,
                   "oriel: {} may be taken for Oriel's header of that name: move it away if it is "
                   "of another renderer\n",
                   header);
  }
}

std::vector<CompiledSource> to_compile(const std::vector<std::string>& sources,
                                       const ShaderBuild& build, const std::string& prefix,
                                       const TemporaryFolder& work) {
  std::vector<CompiledSource> all;
  for (const std::string& source : sources) {
    CompiledSource one{source, work.file(fmt::format("{}{}.o", prefix, all.size())),
                       is_c_source(source), build.flags};
    for (const ShaderManifest& manifest : build.manifests)
      for (std::string& flag : manifest.flags_of(source)) one.flags.push_back(std::move(flag));
    all.push_back(std::move(one));
  }
  return all;
}

/// Sources of each library, by its path.
std::map<std::string, std::vector<const CompiledSource*>> libraries_of(
    const ShaderBuild& build, const std::vector<CompiledSource>& sources) {
  std::map<std::string, std::vector<const CompiledSource*>> libraries;
  for (const CompiledSource& source : sources) {
    std::string path = build.output;
    if (build.each)
      path = (fs::path(build.output) / (fs::path(source.source).stem().string() + ".so")).string();
    auto& parts = libraries[path];
    if (build.each && !parts.empty())
      throw UserError(
          fmt::format("{} and {} would both become {}", parts[0]->source, source.source, path));
    parts.push_back(&source);
  }
  return libraries;
}

void print_hints(const BuildHints& hints) {
  for (const std::string& hint : hints.all()) fmt::print(stderr, "oriel: hint: {}\n", hint);
}

}  // namespace

std::vector<BuiltLibrary> build_shaders(const ShaderBuild& build) {
  const std::string sdk = find_headers(build.include);
  const TemporaryFolder work;
  const std::vector<std::string> folders = folders_of(build);
  const std::vector<std::string> includes = include_flags(build, folders, sdk, work);
  warn_of_other_headers(build.sources, sdk);
  warn_of_other_headers(build.helpers, sdk);
  ShaderCompilers compilers(build.cc, build.cxx, build.standards, work.path().string());
  BuildHints hints(with_parents(folders));

  const std::vector<CompiledSource> sources = to_compile(build.sources, build, "", work);
  const std::vector<CompiledSource> helpers = to_compile(build.helpers, build, "helper", work);
  const auto libraries = libraries_of(build, sources);
  std::vector<CompiledSource> all = sources;
  all.insert(all.end(), helpers.begin(), helpers.end());
  const std::size_t failed = compilers.compile(all, includes, build.jobs, hints);
  if (failed > 0) print_hints(hints);
  if (failed > 0)
    throw UserError(
        fmt::format("{} of {} sources did not compile; nothing was written", failed, all.size()));

  ShaderLink link{{}, {}, build.flags};
  if (!helpers.empty()) {
    link.archives.push_back(work.file("helpers.a"));
    archive_objects(helpers, link.archives[0], work.path().string());
  }
  link.archives.insert(link.archives.end(), build.archives.begin(), build.archives.end());
  std::vector<BuiltLibrary> built;
  // Linked before the first is put in its place: then nothing is written when one fails.
  for (const auto& [path, parts] : libraries) {
    link.sources = parts;
    const std::string made = work.file(fmt::format("{}.so", built.size()));
    try {
      link_shaders(link, helpers, made, work.path().string(), compilers, hints);
    } catch (const UserError&) {
      print_hints(hints);
      throw;
    }
    built.push_back({path, parts.size()});
  }
  if (build.each) fs::create_directories(build.output);
  for (std::size_t i = 0; i < built.size(); ++i)
    write_durably(built[i].path, file_text(work.file(fmt::format("{}.so", i))), 0777);
  print_hints(hints);
  return built;
}

}  // namespace oriel::app
