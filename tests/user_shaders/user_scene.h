// SPDX-License-Identifier: Apache-2.0
// Test support: scenes with shaders that are compiled in the way users compile them.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/temporary_folder.h"
#include "mi/reader.h"
#include "prepare/prepare.h"
#include "render/eye_rays.h"
#include "render/path_integrator.h"
#include "render/session.h"
#include "sampling/sampler.h"
#include "sdk/host.h"
#include "shaders/registry.h"
#include "support/expect_near.h"

namespace oriel::testing {

/// A temporary folder that is deleted with the test.
class ShaderFolder : public TemporaryFolder {
 public:
  /// Compiles source text to NAME.so; `suffix` selects the language.
  void compile(const std::string& name, const std::string& source, const std::string& suffix = "c",
               const std::string& flags = "") const {
    const std::string text = file(name + "." + suffix);
    std::ofstream(text) << source;
    compile_file(name, text, flags);
  }
  void compile_file(const std::string& name, const std::filesystem::path& text,
                    const std::string& flags = "") const {
    const bool cpp = text.extension() == ".cpp";
    const std::string command = std::string(cpp ? "c++ -std=c++98" : "cc -std=gnu99") +
                                " -shared -fPIC -O1 " + flags +
                                " -I" ORIEL_SOURCE_DIR "/include/oriel/sdk -o " +
                                file(name + ".so") + " " + text.string() + " -lm";
    if (std::system(command.c_str()) != 0) throw std::runtime_error("cannot compile " + name);
  }
};

/// A scene read and prepared with users' shaders.
class UserScene {
 public:
  /// `body`: elements; the camera looks down at z = 0 from (0, 0, 4), 90 degrees wide, 8 x 8
  /// pixels; the group "world" holds `members`.
  UserScene(const ShaderFolder& folder, const std::string& body, const std::string& members,
            const std::string& options = "", const std::string& camera = "")
      : UserScene(folder, text(body, members, options, camera)) {}

  UserScene(const ShaderFolder& folder, const std::string& whole) {
    mi::ReadOptions read;
    read.packages = builtin_packages();
    read.knows_shader = [](std::string_view n) { return builtin_shaders().find(n) != nullptr; };
    read.files.permit(folder.path().string());
    scene = mi::read_text(whole, read, diagnostics);
    host.emplace(scene, builtin_shaders(), sdk::TrustedFolders{folder.path()}, diagnostics);
    PrepareReport report;
    world = prepare(scene, scene.renders.back(), host->registry(), {}, diagnostics, report);
    if (!world) throw std::runtime_error("the scene cannot be rendered");
  }
  ~UserScene() { host->end_frame(); }

  static std::string text(const std::string& body, const std::string& members,
                          const std::string& options, const std::string& camera) {
    return "options \"opt\" samples 0 trace depth 4 4 8 " + options +
           " end options camera \"cam\" focal 1 aperture 2 aspect 1 resolution 8 8 " + camera +
           " end camera instance \"cam_i\" \"cam\" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -4 1 end "
           "instance " +
           body + " instgroup \"world\" \"cam_i\" " + members +
           " end instgroup render \"world\" \"cam_i\" \"opt\"\n";
  }

  /// A square at z = 0 of half size 8 with a material; add "square_i" to the members.
  static std::string square(const std::string& material) {
    return "object \"square\" visible shadow trace group -8 -8 0 8 -8 0 8 8 0 -8 8 0 "
           "0 0 0 1 0 0 1 1 0 0 1 0 v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 c 0 1 2 3 end group end "
           "object instance \"square_i\" \"square\" material \"" +
           material + "\" end instance ";
  }

  /// Mean colour of a pixel, through the lens.
  Rgb pixel(int x, int y, int samples = 64, Rgba* buffers = nullptr) {
    PathSettings settings;
    settings.indirect = indirect;
    const PathIntegrator integrator(*world, settings);
    Rgb sum(0);
    RayCounts counts;
    std::vector<Rgba> own(world->user_buffers.size(), Rgba(0));
    std::vector<Rgba> means(own.size(), Rgba(0));
    for (int i = 0; i < samples; ++i) {
      sampling::Sampler sampler(x, y, static_cast<std::uint32_t>(i), 7);
      const Vec2 u = sampler.next_2d();
      std::fill(own.begin(), own.end(), Rgba(0));
      const Vec2 raster(static_cast<float>(x) + u.x, static_cast<float>(y) + u.y);
      PathRecord path(RecordRequest{}, own);
      trace_eye_rays(*world, integrator, raster, settings.paths_of_pixel, path, sampler, counts);
      sum += path.radiance * (1.0f / static_cast<float>(samples));
      for (std::size_t b = 0; b < own.size(); ++b)
        means[b] += own[b] * (1.0f / static_cast<float>(samples));
    }
    if (buffers) std::copy(means.begin(), means.end(), buffers);
    return sum;
  }

  bool indirect = true;
  Diagnostics diagnostics;
  scene::Scene scene;
  std::optional<sdk::Host> host;
  std::unique_ptr<World> world;

  std::string messages() const {
    std::string all;
    for (const Diagnostic& d : diagnostics.all()) all += diagnostics.format(d) + "\n";
    return all;
  }
};

}  // namespace oriel::testing
