// SPDX-License-Identifier: Apache-2.0
// A model with its material library (see Files): imported, or refused with one error. What was
// imported is readable as a scene.
#include <cstdlib>
#include <sstream>

#include "file.h"
#include "fuzzers.h"
#include "mi/reader.h"
#include "mi/writer.h"
#include "models/import.h"

int oriel::fuzz::fuzz_model(const std::uint8_t* data, std::size_t size) {
  const Files files(data, size);
  if (files.names().empty()) return 0;
  const std::string path = files.path(files.names().front());
  const std::string suffix = models::lower_suffix(path);
  // Other formats are read by other parts of assimp alone.
  if (suffix != ".obj" && suffix != ".ply" && suffix != ".stl") return 0;
  models::ImportOptions options;
  options.texture_folder = options.scene_folder = files.folder();
  options.files.set_untrusted(true);
  Diagnostics diagnostics;
  const auto scene = models::import_model(path, options, diagnostics);
  if (!scene && diagnostics.count(Severity::Error) != 1) std::abort();
  if (!scene) return 0;
  std::ostringstream written;
  mi::write_scene(*scene, written);
  Diagnostics again;
  mi::read_text(written.str(), {}, again);
  if (again.count(Severity::Error) != 0) std::abort();
  return 0;
}
