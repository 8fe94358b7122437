// SPDX-License-Identifier: Apache-2.0
// Test support: complete images of scenes with user shaders, and their output files.
#pragma once

#include "image/exr.h"
#include "output/camera_output.h"
#include "output/output.h"
#include "user_scene.h"

namespace oriel::testing {

/// A scene rendered whole.
struct UserPicture {
  UserScene& scene;
  std::optional<RenderSession> session = {};

  explicit UserPicture(UserScene& its_scene, std::uint32_t samples = 16, bool outputs = false)
      : scene(its_scene) {
    SessionSettings settings;
    settings.budget.samples = samples;
    settings.outputs = outputs;
    session.emplace(*scene.world, settings);
    session->run();
  }

  /// Layers as an EXR file of all of them has them.
  std::vector<Layer> layers(const ShaderFolder& folder,
                            const LayerSet& set = LayerSet(LayerGroup::Film)) const {
    PictureFile file = picture_file((folder.path() / "picture.exr").string());
    file.precision = ExrPrecision::Float;
    file.layers = set;
    write_picture(file, *session, {});
    return read_exr(file.path).layers;
  }

  /// Writes the output files of the camera into the folder; returns them.
  std::vector<PictureFile> write_files(const ShaderFolder& folder) const {
    const scene::Camera* camera = find_camera(scene.scene, scene.scene.renders.back());
    const std::string root = folder.path().string();
    std::vector<PictureFile> files =
        camera_outputs(*camera, {root, {root}}, scene.scene, scene.host->registry(), *scene.world,
                       scene.diagnostics);
    for (const PictureFile& file : files) write_picture(file, *session, {});
    return files;
  }

  /// Mean beauty.
  Rgb mean() const {
    Rgb sum(0);
    const Film& film = session->film();
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) sum += rgb(film.pixel(x, y).beauty);
    return sum / static_cast<float>(film.pixel_count());
  }
};

}  // namespace oriel::testing
