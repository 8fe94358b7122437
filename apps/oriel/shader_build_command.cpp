// SPDX-License-Identifier: Apache-2.0
// oriel shader-build: a folder of shader sources in C and C++ becomes a library that scenes link.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <thread>

#include "command.h"
#include "shader_build.h"
#include "shader_sources.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct ShaderBuildArguments {
  std::vector<std::string> paths, flags, include_folders, defines, standards, one_dash, helpers;
  std::string output, cc, cxx, include, manifest;
  bool recursive = false, each = false;
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
};

std::string output_name(const ShaderBuildArguments& a) {
  if (a.each) return a.output.empty() ? "." : a.output;
  if (!a.output.empty()) return a.output;
  if (a.paths.size() != 1) throw UsageError("-o is required for more than one folder or source");
  // "shaders/" and "." have a last part, too.
  const fs::path path = fs::canonical(a.paths[0]);
  return (fs::is_directory(path) ? path.filename() : path.stem()).string() + ".so";
}

/// Standards of --std, and of -std=, which arrives as the option -s with "td=".
std::vector<std::string> standards_of(const ShaderBuildArguments& a) {
  std::vector<std::string> standards = a.standards;
  for (const std::string& word : a.one_dash) {
    if (!word.starts_with("td=")) throw UsageError(fmt::format("unknown option -s{}", word));
    standards.push_back(word.substr(3));
  }
  return standards;
}

std::vector<ShaderManifest> manifests_of(const ShaderBuildArguments& a) {
  std::vector<ShaderManifest> manifests;
  if (!a.manifest.empty()) return {ShaderManifest(a.manifest)};
  for (const std::string& path : a.paths)
    if (const fs::path file = fs::path(path) / kManifestName; fs::is_regular_file(file))
      manifests.emplace_back(file);
  return manifests;
}

/// Helpers of the command line and of manifests, as sources and as archives.
void add_helpers(const ShaderBuildArguments& a, ShaderBuild& build) {
  std::vector<std::string> paths = a.helpers, to_search;
  for (const ShaderManifest& manifest : build.manifests)
    paths.insert(paths.end(), manifest.helpers().begin(), manifest.helpers().end());
  for (const std::string& path : paths) {
    if (fs::path(path).extension() != ".a")
      to_search.push_back(path);
    else if (fs::is_regular_file(path))
      build.archives.push_back(path);
    else
      throw UserError(fmt::format("there is no '{}'", path));
  }
  if (!to_search.empty())
    build.helpers = find_shader_sources(to_search, a.recursive, build.manifests);
  // They may lie in the folder of the shaders.
  std::set<fs::path> shared;
  for (const std::string& helper : build.helpers) shared.insert(fs::canonical(helper));
  std::erase_if(build.sources,
                [&](const std::string& source) { return shared.count(fs::canonical(source)) > 0; });
  if (build.sources.empty()) throw UserError("there are no sources to build beside the helpers");
}

ShaderBuild plan_of(const ShaderBuildArguments& a) {
  ShaderBuild build;
  build.standards = standards_of(a);
  build.manifests = manifests_of(a);
  build.sources = find_shader_sources(a.paths, a.recursive, build.manifests);
  build.output = output_name(a);
  for (const std::string& macro : a.defines) build.flags.push_back("-D" + macro);
  build.flags.insert(build.flags.end(), a.flags.begin(), a.flags.end());
  build.cc = a.cc, build.cxx = a.cxx, build.include = a.include;
  build.include_folders = a.include_folders;
  for (const ShaderManifest& manifest : build.manifests)
    for (const std::string& folder : manifest.include_folders())
      build.include_folders.push_back(folder);
  for (const std::string& folder : build.include_folders)
    if (!fs::is_directory(folder)) throw UserError(fmt::format("-I: there is no '{}'", folder));
  build.each = a.each, build.jobs = a.jobs;
  add_helpers(a, build);
  return build;
}

int run_shader_build(const ShaderBuildArguments& a) {
  for (const BuiltLibrary& built : build_shaders(plan_of(a)))
    fmt::print("{}: {} source{}\n", built.path, built.sources, built.sources == 1 ? "" : "s");
  return kExitDone;
}

/// An option that may be repeated and takes one word each time.
void add_words(CLI::App* app, const char* name, std::vector<std::string>& words, const char* help,
               const char* type) {
  app->add_option(name, words, help)->type_name(type)->allow_extra_args(false);
}

}  // namespace

Command add_shader_build_command(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("shader-build", "Compile C and C++ shaders into a library for scenes");
  auto a = std::make_shared<ShaderBuildArguments>();
  app->add_option("paths", a->paths, "Folder of sources, or the sources themselves")
      ->required()
      ->type_name("PATH");
  app->add_option("-o,--output", a->output,
                  "Library (default: name of the folder with .so); with --each the folder of "
                  "libraries (default: the current one)")
      ->type_name("FILE");
  app->add_flag("-r,--recursive", a->recursive, "Include sources in subfolders");
  app->add_flag("--each", a->each, "One library per source, named after it");
  add_words(app, "-I", a->include_folders, "Folder of headers; may be repeated", "FOLDER");
  add_words(app, "-D", a->defines, "Macro; may be repeated", "NAME[=VALUE]");
  add_words(app, "--std", a->standards,
            "Standard of C or of C++ (default gnu99 and gnu++14); -std= is the same; may be "
            "repeated",
            "STANDARD");
  add_words(app, "-s", a->one_dash, "", "");
  app->get_option("-s")->group("");
  add_words(app, "--helper", a->helpers,
            "Source, folder or archive (.a) linked to each library; sources are compiled once; may "
            "be repeated",
            "PATH");
  app->add_option(
         "--manifest", a->manifest,
         "Manifest with flags of single sources (default: oriel-shaders.txt in the folder)")
      ->type_name("FILE");
  app->add_option("-j,--jobs", a->jobs,
                  "Number of parallel compilers (default: number of processors)")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  app->add_option("--cc", a->cc, "C compiler (default: $CC, cc, gcc, clang)")->type_name("PROGRAM");
  app->add_option("--cxx", a->cxx, "C++ compiler (default: $CXX, c++, g++, clang++)")
      ->type_name("PROGRAM");
  app->add_option("--include", a->include, "Folder of shader.h (else $ORIEL_SDK, else Oriel's own)")
      ->type_name("FOLDER");
  app->add_option("--flag", a->flags, "Additional compiler flag, e.g. --flag=-DDEBUG; repeatable")
      ->type_name("WORD")
      ->allow_extra_args(false);
  return {app, [a] { return run_shader_build(*a); }};
}

}  // namespace oriel::app
