// SPDX-License-Identifier: Apache-2.0
// Statements of a camera: where its files go and what they contain. Files outside of the folder of
// the scene are never among them.
#include <cstdlib>

#include "base/file_access.h"
#include "file.h"
#include "fuzzers.h"
#include "output/camera_output.h"
#include "prepare/testing/prepared_scene.h"

int oriel::fuzz::fuzz_output(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  const std::string base = folder.path().string();
  testing::PreparedScene prepared(testing::scene_text(
      "material \"m\" \"mib_illum_lambert\" () end material", {}, text_of(data, size)));
  if (!prepared.world) return 0;
  const scene::Camera* camera = find_camera(prepared.scene, prepared.scene.renders.back());
  if (!camera) return 0;
  for (const PictureFile& file :
       camera_outputs(*camera, {base, {base}, {}}, prepared.scene, builtin_shaders(),
                      *prepared.world, prepared.diagnostics)) {
    if (!lies_below(file.path, base)) std::abort();
    has_writable_suffix(file.path);
    picture_file(file.path);
  }
  return 0;
}
