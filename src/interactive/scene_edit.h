// SPDX-License-Identifier: Apache-2.0
// Edits of a scene as text, ELEMENT.PARAMETER=VALUE: those of `--set` and of interactive sessions.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "runtime/shader_spec.h"
#include "scene/scene.h"

namespace oriel::interactive {

/// An edit that the scene cannot take: an unknown element or parameter, with the nearest name.
struct EditError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A text without the form of an edit.
struct EditFormError : EditError {
  using EditError::EditError;
};

/// An edit in parts.
struct SceneEdit {
  std::string element, parameter;
  std::string value;  ///< as written
  /// ELEMENT.PARAMETER, which a later edit of the same parameter shares.
  std::string target() const { return element + "." + parameter; }
};

/// Splits an edit. Names may contain dots: the element is the longest part before a dot that names
/// one.
/// Errors:  EditError, EditFormError.
SceneEdit parse_edit(const scene::Scene& scene, const std::string& text);

/// The value of an edit: on, off, numbers, `=shader`, an array `[...]` or structure `{...}` in the
/// form of the scene language, otherwise a string.
scene::Value parse_edit_value(const std::string& text);

/// A shader call that has a parameter.
struct FoundCall {
  scene::ShaderUse* call = nullptr;  ///< null: none
  std::string owner;                 ///< element that contains it
};

/// The call whose parameter an edit sets: the first of the element's shaders that has it; named
/// shaders are followed. Adds the names of the parameters that it looked at to `candidates`.
FoundCall find_call(scene::Scene& scene, const SceneEdit& edit, const Registry& registry,
                    std::vector<std::string>& candidates);

/// Called before an element is changed.
using BeforeChange = std::function<void(const scene::Element&)>;

/// Changes the scene.
///
/// Model:   the parameter is one of, in this order: a parameter of the element's shaders (of the
///          first call that has it; named shaders are followed), then a statement of the element:
///          options, cameras, lights and instances have those of their tables and, in addition,
///          `focal`, `aperture`, `aspect`, `resolution`; `origin`, `direction`, `spread`;
///          `transform` (16 numbers as in a scene). Textures have `file`.
/// Returns: the name of the element that was changed, which is a named shader if it was followed.
/// Errors:  EditError, EditFormError; the scene is then unchanged.
/// Checked: EditTable.* in tests/interactive
std::string apply_edit(scene::Scene& scene, const std::string& text, const Registry& registry,
                       const BeforeChange& before = {});

}  // namespace oriel::interactive
