// SPDX-License-Identifier: Apache-2.0
// Files of indirect light that a scene may read and write.
#pragma once

#include <string>

#include "base/diagnostic.h"
#include "render/integrator.h"
#include "runtime/world.h"

namespace oriel::interactive {

/// The map files that the options name and that exist or may be written below the scene's folder.
/// Sessions read them; they are only written if the options ask for it, as by `oriel render`.
/// Errors:  OR-RN-043 a file outside of the folder, which is ignored.
MapFiles allowed_map_files(const World& world, const std::string& scene_path,
                           Diagnostics& diagnostics);

}  // namespace oriel::interactive
