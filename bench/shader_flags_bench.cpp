// SPDX-License-Identifier: Apache-2.0
// What do the flags cost that `oriel shader-build` gives to make old sources safe?
//
// A procedural texture in C++ (gradient noise in octaves, integer hashing, arrays, pointers) is
// compiled with -O2 and each set of flags. The sets take turns; printed are medians of the ratio by
// processor time to -O2 alone.
#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "timing.h"

namespace {

namespace fs = std::filesystem;
using namespace oriel;

constexpr int kTurns = 15;

constexpr const char* kSource = R"(
#include <math.h>
static float gradients[256][3]; static int order[512]; static int ready;
static void fill() {
  for (int i = 0; i < 256; ++i) {
    unsigned h = i * 374761393u + 668265263u; h = (h ^ (h >> 13)) * 1274126177u;
    order[i] = order[i + 256] = (h ^ (h >> 16)) & 255;
    for (int k = 0; k < 3; ++k) gradients[i][k] = ((h >> (8 * k)) & 255) / 127.5f - 1;
  }
  ready = 1;
}
static float corner(const int* cell, const float* f, int x, int y, int z) {
  const float* g = gradients[order[(cell[0] + x + order[(cell[1] + y + order[(cell[2] + z) & 255]) & 255]) & 255]];
  return g[0] * (f[0] - x) + g[1] * (f[1] - y) + g[2] * (f[2] - z);
}
static float noise(const float* p) {
  int cell[3]; float f[3], s[3], sum = 0;
  for (int i = 0; i < 3; ++i) {
    cell[i] = (int)floorf(p[i]); f[i] = p[i] - cell[i]; s[i] = f[i] * f[i] * (3 - 2 * f[i]);
  }
  for (int x = 0; x < 2; ++x) for (int y = 0; y < 2; ++y) for (int z = 0; z < 2; ++z)
    sum += (x ? s[0] : 1 - s[0]) * (y ? s[1] : 1 - s[1]) * (z ? s[2] : 1 - s[2]) * corner(cell, f, x, y, z);
  return sum;
}
extern "C" float bench(int count) {
  if (!ready) fill();
  float total = 0, p[3] = {0, 0, 0};
  for (int i = 0; i < count; ++i) {
    float scale = 1;
    p[0] = i * .013f; p[1] = i * .0077f; p[2] = i * .0051f;
    for (int octave = 0; octave < 4; ++octave, scale *= .5f) {
      total += scale * noise(p);
      for (int k = 0; k < 3; ++k) p[k] *= 2.03f;
    }
  }
  return total;
}
)";

struct Flags {
  const char *name, *words;
};
constexpr Flags kSets[] = {
    {"-O2 alone", ""},
    {"-fno-strict-aliasing", "-fno-strict-aliasing"},
    {"-fwrapv", "-fwrapv"},
    {"-fno-delete-null-pointer-checks", "-fno-delete-null-pointer-checks"},
    {"safe returns", "-fsanitize=unreachable -fsanitize-undefined-trap-on-error"},
    {"all",
     "-fno-strict-aliasing -fwrapv -fno-delete-null-pointer-checks -fsanitize=unreachable "
     "-fsanitize-undefined-trap-on-error"}};

using Bench = float (*)(int);

Bench compiled(const fs::path& folder, const char* words, std::size_t number) {
  const std::string library = (folder / fmt::format("{}.so", number)).string();
  const std::string command = fmt::format(
      "g++ -std=gnu++14 -O2 -fPIC -shared {} -o {} {}/bench.cpp", words, library, folder.string());
  if (std::system(command.c_str()) != 0) std::exit(1);
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) std::exit(1);
  return reinterpret_cast<Bench>(dlsym(handle, "bench"));
}

}  // namespace

int main() {
  const fs::path folder = fs::temp_directory_path() / fmt::format("oriel_flags_{}", getpid());
  fs::create_directories(folder);
  std::ofstream(folder / "bench.cpp") << kSource;
  std::vector<Bench> benches;
  for (const Flags& flags : kSets) benches.push_back(compiled(folder, flags.words, benches.size()));
  std::vector<std::vector<double>> ratios(benches.size());
  volatile float kept = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    double base = 0;
    for (std::size_t i = 0; i < benches.size(); ++i) {
      const double time = bench::timed([&] { kept = benches[i](400000); }).cpu;
      if (i == 0) base = time;
      ratios[i].push_back(time / base);
    }
  }
  (void)kept;
  for (std::size_t i = 0; i < benches.size(); ++i) {
    std::sort(ratios[i].begin(), ratios[i].end());
    fmt::print("{:34}{:.3f} ({:.3f} to {:.3f})\n", kSets[i].name, bench::median(ratios[i]),
               ratios[i].front(), ratios[i].back());
  }
  fs::remove_all(folder);
}
