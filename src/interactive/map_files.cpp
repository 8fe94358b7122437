// SPDX-License-Identifier: Apache-2.0
#include "interactive/map_files.h"

#include <filesystem>

#include "output/output_place.h"

namespace oriel::interactive {

MapFiles allowed_map_files(const World& world, const std::string& scene_path,
                           Diagnostics& diagnostics) {
  const std::string folder = std::filesystem::path(scene_path).parent_path().string();
  const OutputRoots roots{folder, {folder}};
  const auto allowed = [&](const std::string& file) {
    std::string path = allowed_path(file, roots);
    if (path.empty())
      diagnostics.warning(
          "OR-RN-043", {},
          "the map \"" + file + "\" is outside of the scene's folder; it is ignored",
          "move the file into the folder of the scene");
    return path;
  };
  MapFiles files;
  const scene::RenderOptions& o = world.options;
  if (!o.photonmap_file.empty()) files.photons = allowed(o.photonmap_file);
  for (const std::string& file : o.finalgather.files)
    if (std::string path = allowed(file); !path.empty()) files.gather.push_back(std::move(path));
  return files;
}

}  // namespace oriel::interactive
