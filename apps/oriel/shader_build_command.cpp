// SPDX-License-Identifier: Apache-2.0
// oriel shader-build: a folder of shader sources in C and C++ becomes a library that scenes link.
#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "command.h"
#include "compiler.h"
#include "image/atomic_file.h"
#include "include_shim.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct ShaderBuildArguments {
  std::vector<std::string> paths, flags;
  std::string output, cc, cxx, include;
};

bool is_c(const fs::path& file) { return file.extension() == ".c"; }

bool is_source(const fs::path& file) {
  const std::string extension = file.extension().string();
  return is_c(file) || extension == ".cpp" || extension == ".cc" || extension == ".cxx" ||
         extension == ".C";
}

bool is_header(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".h" || extension == ".hpp" || extension == ".hh" || extension == ".hxx";
}

/// The DllMain of a Windows library in a file of its own, as such folders often have one.
bool is_windows_entry(const fs::path& file) {
  std::string stem = file.stem().string();
  for (char& c : stem) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (stem.size() < 3 || stem.compare(stem.size() - 3, 3, "dll") != 0) return false;
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return text.find("windows.h") != std::string::npos && text.find("DllMain") != std::string::npos;
}

std::vector<std::string> files_in(const fs::path& folder, bool (*wanted)(const fs::path&)) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && wanted(entry.path())) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> find_sources(const std::vector<std::string>& paths) {
  std::vector<std::string> sources;
  for (const std::string& path : paths) {
    if (!fs::exists(path)) throw UserError(fmt::format("there is no '{}'", path));
    if (!fs::is_directory(path)) {
      if (!is_source(path))
        throw UserError(fmt::format("'{}' is no source (.c, .cpp, .cc, .cxx)", path));
      sources.push_back(path);
      continue;
    }
    const std::vector<std::string> found = files_in(path, is_source);
    if (found.empty())
      throw UserError(fmt::format("'{}' has no sources (.c, .cpp, .cc, .cxx) in it", path));
    for (const std::string& file : found) {
      if (is_windows_entry(file))
        fmt::print(stderr, "oriel: {} is left out: the entry point of a Windows library\n", file);
      else
        sources.push_back(file);
    }
  }
  if (sources.empty()) throw UserError("there are no sources to build");
  return sources;
}

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

std::string output_name(const ShaderBuildArguments& a) {
  if (!a.output.empty()) return a.output;
  if (a.paths.size() != 1) throw UsageError("-o is needed for more than one folder or source");
  // "shaders/" and "." have a last part, too.
  const fs::path path = fs::canonical(a.paths[0]);
  return (fs::is_directory(path) ? path.filename() : path.stem()).string() + ".so";
}

/// A folder that goes away with its content.
class WorkFolder {
 public:
  WorkFolder() {
    std::string name = (fs::temp_directory_path() / "oriel-shader-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw UserError(fmt::format("cannot make a folder '{}'", name));
    path_ = name;
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

/// Sources of the time rely on what compilers let pass then; newer ones are told to as well.
std::vector<std::string> dialect(bool c) {
  if (!c) return {"-std=gnu++14", "-fpermissive"};
  return {"-std=gnu99", "-Wno-error=implicit-function-declaration", "-Wno-error=implicit-int",
          "-Wno-error=int-conversion", "-Wno-error=incompatible-pointer-types"};
}

/// Where the compiler looks for headers.
std::vector<std::string> include_flags(const std::vector<std::string>& sources,
                                       const std::string& sdk, const WorkFolder& work) {
  std::vector<std::string> read = sources;
  std::vector<std::string> folders;
  for (const std::string& source : sources) {
    const std::string folder = (fs::path(source).parent_path() / "").string();
    if (std::find(folders.begin(), folders.end(), folder) != folders.end()) continue;
    folders.push_back(folder);
    for (std::string& header : files_in(folder.empty() ? "." : folder, is_header))
      read.push_back(std::move(header));
  }
  std::vector<StrayInclude> stray;
  const std::string shim = write_include_shim(read, sdk, work.file("include"), stray);
  for (const StrayInclude& s : stray)
    fmt::print(stderr, "oriel: {}:{}: there is no \"{}\" here; write #include <{}>\n", s.file,
               s.line, s.name, fs::path(s.name).filename().string());
  std::vector<std::string> flags = {"-I" + sdk};
  if (!shim.empty()) flags.push_back("-I" + shim);
  return flags;
}

int run_shader_build(const ShaderBuildArguments& a) {
  const std::vector<std::string> sources = find_sources(a.paths);
  const std::string sdk = find_headers(a.include), output = output_name(a);
  const WorkFolder work;
  const std::vector<std::string> includes = include_flags(sources, sdk, work);
  Compiler cc("C", "--cc", a.cc, "CC", {"cc", "gcc", "clang"});
  Compiler cxx("C++", "--cxx", a.cxx, "CXX", {"c++", "g++", "clang++"});

  std::vector<std::string> objects;
  std::size_t failed = 0;
  bool all_c = true;
  for (const std::string& source : sources) {
    const bool c = is_c(source);
    all_c = all_c && c;
    objects.push_back(work.file(fmt::format("{}.o", objects.size())));
    std::vector<std::string> arguments = dialect(c);
    for (const char* flag : {"-O2", "-fPIC", "-fno-strict-aliasing"}) arguments.push_back(flag);
    arguments.insert(arguments.end(), includes.begin(), includes.end());
    arguments.insert(arguments.end(), a.flags.begin(), a.flags.end());
    arguments.insert(arguments.end(), {"-c", source, "-o", objects.back()});
    if (!(c ? cc : cxx).run(arguments)) ++failed;
  }
  if (failed > 0)
    throw UserError(fmt::format("{} of {} sources did not compile; nothing was written", failed,
                                sources.size()));

  write_atomically(output, [&](const std::string& path) {
    std::vector<std::string> arguments = {"-shared", "-o", path};
    arguments.insert(arguments.end(), objects.begin(), objects.end());
    arguments.insert(arguments.end(), a.flags.begin(), a.flags.end());
    arguments.push_back("-lm");
    if (!(all_c ? cc : cxx).run(arguments))
      throw UserError("the sources could not be linked; nothing was written");
  });
  fmt::print("{}: {} source{}\n", output, sources.size(), sources.size() == 1 ? "" : "s");
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
