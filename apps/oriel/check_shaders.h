// SPDX-License-Identifier: Apache-2.0
// How far each shader, texture and library of a scene is followed: facts for `oriel check`.
#pragma once

#include <nlohmann/json.hpp>

#include "runtime/binder.h"
#include "scene/scene.h"
#include "sdk/host.h"

namespace oriel::app {

/// Of a frame that was prepared.
struct CheckedScene {
  const scene::Scene& scene;
  const Registry& builtin;
  const sdk::Host& host;
  const BindingReport& binding;
  const Diagnostics& diagnostics;
};

/// One entry for each type that is called, by name: {type, calls, status, library, doc, note,
/// parameters}. status: exact, approximated, ignored (some parameters are), native (of a C
/// library), phenomenon, guessed or unknown (magenta: whether the picture shows it so). Shaders of
/// every kind are listed, whether something uses them or not. Parameters are those that the scene
/// writes: {name, support (exact, approximated, ignored, unknown), count, value, file, line,
/// reason}; the place is the first.
nlohmann::json used_shaders(const CheckedScene& checked);

/// {name, written, state, file, line} of each texture file that the scene names. state: found,
/// missing, or unused where no shader looks for a file that is not there.
nlohmann::json used_textures(const CheckedScene& checked);

/// {written, found, path} of each C library that the scene links.
nlohmann::json used_libraries(const CheckedScene& checked);

}  // namespace oriel::app
