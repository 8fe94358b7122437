// SPDX-License-Identifier: Apache-2.0
#include "check_thumbnail.h"

#include "base/file_text.h"
#include "base/temporary_folder.h"
#include "output/camera_output.h"
#include "output/output.h"
#include "quick_look.h"

namespace oriel::app {
namespace {

std::string rendered(scene::Scene& scene, const sdk::TrustedFolders& trusted, std::string& why) {
  std::string png;
  const bool seen = quick_look(scene, trusted, {}, [&](const QuickLookResult& look) {
    const TemporaryFolder folder;
    Diagnostics unheard;
    PictureFile file = picture_file(folder.file("scene.png"));
    file.shaders =
        camera_output_shaders(look.camera, scene, look.host.registry(), look.world, unheard);
    write_picture(file, look.session, {});
    png = file_text(file.path);
    if (!look.host.stopped) return;
    // What a crash leaves of the picture is not shown.
    png.clear();
    for (const Diagnostic& d : look.host.diagnostics().all())
      if (d.severity == Severity::Error) why = d.message;
  });
  if (!seen) why = "the scene has no camera that could render it";
  return png;
}

}  // namespace

std::string thumbnail(scene::Scene& scene, const sdk::TrustedFolders& trusted, std::string& why) {
  if (scene.renders.empty()) {
    why = "the scene has no render statement";
    return {};
  }
  try {
    return rendered(scene, trusted, why);
  } catch (const std::exception& e) {
    why = e.what();
    return {};
  }
}

}  // namespace oriel::app
