// SPDX-License-Identifier: Apache-2.0
// What does a trivial texture shader in C on every surface cost over the built-in constant?
//
// Rooms of two sizes, path traced with a Lambert material whose colour is the built-in constant
// shader and with one whose colour is a shader in C that returns its parameter. They take turns;
// printed are medians of the ratio by processor time. The shader is compiled on the spot.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bench_scenes.h"
#include "mi/reader.h"
#include "path_picture.h"
#include "prepare/prepare.h"
#include "sdk/host.h"
#include "shaders/registry.h"
#include "timing.h"

namespace {

using namespace oriel;
namespace fs = std::filesystem;

constexpr int kTurns = 7, kSamples = 2;

constexpr const char* kSource =
    "#include <shader.h>\n"
    "struct bench_constant { miColor color; };\n"
    "DLLEXPORT miBoolean bench_constant(miColor *result, miState *state,\n"
    "                                   struct bench_constant *p) {\n"
    "  *result = *mi_eval_color(&p->color); return miTRUE; }\n";

/// The folder of the compiled shader.
fs::path compiled() {
  const fs::path folder = fs::temp_directory_path() / fmt::format("oriel_bench_{}", getpid());
  fs::create_directories(folder);
  std::ofstream(folder / "bench.c") << kSource;
  const std::string command = fmt::format(
      "cc -std=gnu99 -O2 -shared -fPIC -I {}/include/oriel/sdk -o {}/bench.so {}/bench.c",
      ORIEL_SOURCE_DIR, folder.string(), folder.string());
  if (std::system(command.c_str()) != 0) std::exit(1);
  return folder;
}

struct Room {
  Diagnostics diagnostics;
  scene::Scene scene;
  sdk::Host host;
  std::unique_ptr<World> world;

  Room(const std::string& text, const fs::path& folder)
      : scene(read(text)), host(scene, builtin_shaders(), {folder}, diagnostics) {
    PrepareReport report;
    world = prepare(scene, scene.renders.back(), host.registry(), {}, diagnostics, report);
    for (const Diagnostic& d : diagnostics.all()) fmt::print(stderr, "{}\n", diagnostics.format(d));
  }
  ~Room() { host.end_frame(); }
  scene::Scene read(const std::string& text) {
    oriel::mi::ReadOptions options;
    options.packages = builtin_packages();
    options.knows_shader = [](std::string_view n) { return builtin_shaders().find(n) != nullptr; };
    return oriel::mi::read_text(text, options, diagnostics);
  }
};

/// The room with its material's colour from a shader.
std::string room_of(bool large, const std::string& shader) {
  std::string text = large ? bench::big_room() : bench::small_room();
  const std::string plain = "\"diffuse\" .75 .75 .75";
  for (std::size_t at; (at = text.find(plain)) != std::string::npos;)
    text.replace(at, plain.size(), "\"diffuse\" = \"colour\"");
  return "link \"bench.so\"\ndeclare shader color \"bench_constant\" ( color \"color\" ) apply "
         "texture end declare\nshader \"colour\" " +
         shader + "\n" + text;
}

void compare(const char* name, bool large, const fs::path& folder) {
  Room built_in(room_of(large, "\"mib_color_mix\" ( \"num\" 0, \"color_base\" .75 .75 .75 1 )"),
                folder);
  Room users(room_of(large, "\"bench_constant\" ( \"color\" .75 .75 .75 1 )"), folder);
  const ThreadLimit one(1);
  std::vector<double> ratios;
  bench::Picture a, b;
  for (int i = 0; i < kTurns; ++i) {
    const double first =
        bench::timed([&] { a = bench::path_picture(*built_in.world, kSamples, 1); }).cpu;
    const double second =
        bench::timed([&] { b = bench::path_picture(*users.world, kSamples, 1); }).cpu;
    ratios.push_back(second / first);
  }
  std::sort(ratios.begin(), ratios.end());
  fmt::print("{}: {:.3f} ({:.3f} to {:.3f}); pictures differ by {:.1e}\n", name,
             bench::median(ratios), ratios.front(), ratios.back(), bench::relative_error(b, a));
}

}  // namespace

int main() {
  const fs::path folder = compiled();
  compare("small room", false, folder);
  compare("room of a million triangles", true, folder);
  fs::remove_all(folder);
}
