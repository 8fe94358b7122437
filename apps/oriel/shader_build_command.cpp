// SPDX-License-Identifier: Apache-2.0
// oriel shader-build: a folder of shader sources in C and C++ becomes a library that scenes link.
#include <fmt/format.h>

#include <filesystem>

#include "command.h"
#include "shader_build.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct ShaderBuildArguments {
  std::vector<std::string> paths, flags;
  std::string output, cc, cxx, include;
};

std::string output_name(const ShaderBuildArguments& a) {
  if (!a.output.empty()) return a.output;
  if (a.paths.size() != 1) throw UsageError("-o is needed for more than one folder or source");
  // "shaders/" and "." have a last part, too.
  const fs::path path = fs::canonical(a.paths[0]);
  return (fs::is_directory(path) ? path.filename() : path.stem()).string() + ".so";
}

int run_shader_build(const ShaderBuildArguments& a) {
  const ShaderBuild build{.sources = find_shader_sources(a.paths),
                          .output = output_name(a),
                          .flags = a.flags,
                          .cc = a.cc,
                          .cxx = a.cxx,
                          .include = a.include};
  build_shaders(build);
  fmt::print("{}: {} source{}\n", build.output, build.sources.size(),
             build.sources.size() == 1 ? "" : "s");
  return kExitDone;
}

}  // namespace

Command add_shader_build_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "shader-build", "Compiles shaders written in C and C++ into a library that scenes link");
  auto a = std::make_shared<ShaderBuildArguments>();
  app->add_option("paths", a->paths, "Folder of sources, or the sources themselves")
      ->required()
      ->type_name("PATH");
  app->add_option("-o,--output", a->output, "Library; without it, as the folder is called, .so")
      ->type_name("FILE");
  app->add_option("--cc", a->cc, "C compiler (else $CC, cc, gcc, clang)")->type_name("PROGRAM");
  app->add_option("--cxx", a->cxx, "C++ compiler (else $CXX, c++, g++, clang++)")
      ->type_name("PROGRAM");
  app->add_option("--include", a->include, "Folder of shader.h (else $ORIEL_SDK, else Oriel's own)")
      ->type_name("FOLDER");
  app->add_option("--flag", a->flags,
                  "Further word for the compiler, as --flag=-DDEBUG; may be repeated")
      ->type_name("WORD")
      ->allow_extra_args(false);
  return {app, [a] { return run_shader_build(*a); }};
}

}  // namespace oriel::app
