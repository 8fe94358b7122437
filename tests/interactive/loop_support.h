// SPDX-License-Identifier: Apache-2.0
// Test support: render loops over scenes in memory folders, their pixels, a scene with everything
// that can be edited.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "interactive/render_loop.h"
#include "shaders/registry.h"
#include "support/files.h"

namespace oriel::interactive {

/// A room corner with a glossy floor, a box, a point light and a sun; 48 x 32 pixels.
inline std::string editable_scene() {
  return R"(# A comment that has to stay.
options "opt"
  samples 0 1   # few
  trace depth 3 3 4
  "indirect" "path"
end options

light "lamp" "mib_light_point" ("color" 40 38 35, "shadow" on) origin 0 0 3 end light
instance "lamp_inst" "lamp" end instance

material "floor_mtl" opaque
  "mia_material_x" (
    "diffuse" .5 .4 .3,   # warm
    "refl_gloss" 1,
    "reflectivity" .2
  )
end material
material "box_mtl"
  "mib_illum_lambert" ("diffuse" .2 .5 .7)
end material

object "floor" visible shadow trace tag 1
  group
    -4 -4 0  4 -4 0  4 4 0  -4 4 0
    v 0 v 1 v 2 v 3
    p "floor_mtl" 0 1 2 3
  end group
end object
object "wall" visible shadow trace tag 2
  group
    -1 1 0  1 1 0  1 1 2  -1 1 2
    v 0 v 1 v 2 v 3
    p "box_mtl" 0 1 2 3
  end group
end object
instance "floor_inst" "floor" end instance
instance "wall_inst" "wall" end instance

camera "cam"
  output "rgba" "exr" "out.exr"
  focal 35
  aperture 36
  aspect 1.5
  resolution 48 32
end camera
instance "cam_inst" "cam"
  transform 1 0 0 0  0 .4472136 -.8944272 0  0 .8944272 .4472136 0  0 -1.3416408 -4.9193496 1
end instance
instgroup "root" "lamp_inst" "floor_inst" "wall_inst" "cam_inst" end instgroup
render "root" "cam_inst" "opt"
)";
}

/// A scene file in a temporary folder.
class LoopTest : public ::testing::Test {
 protected:
  void SetUp() override { write("scene.mi", editable_scene()); }
  std::string file(const std::string& name) const { return folder_.file(name); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
  }
  std::string text(const std::string& name) const {
    std::ifstream stream(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  SceneSource source(const std::string& name = "scene.mi") const {
    SceneSource s;
    s.path = file(name);
    s.registry = &builtin_shaders();
    s.read.packages = builtin_packages();
    s.read.knows_shader = [](std::string_view shader) {
      return builtin_shaders().find(shader) != nullptr;
    };
    return s;
  }

  static ViewSettings small_view() {
    ViewSettings view;
    view.budget.samples = 4;
    return view;
  }

 private:
  TestFolder folder_;
};

/// Renders until the picture is finished.
inline void finish(RenderLoop& loop) {
  const std::atomic<bool> never = false;
  while (!loop.run(never)) {
  }
}

/// All beauty values of the full-size picture.
inline std::vector<float> beauty(const RenderLoop& loop) {
  std::vector<float> values;
  const RenderSession* session = loop.session();
  if (!session) return values;
  for (int y = 0; y < session->film().height(); ++y)
    for (int x = 0; x < session->film().width(); ++x) {
      const Rgba c = session->film().pixel(x, y).beauty;
      values.insert(values.end(), {c.r, c.g, c.b, c.a});
    }
  return values;
}

}  // namespace oriel::interactive
