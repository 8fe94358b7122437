// SPDX-License-Identifier: Apache-2.0
// Evaluates the `output` statements of a camera: files with their content and location.
#pragma once

#include <string>
#include <vector>

#include "output/output.h"
#include "output/output_place.h"
#include "scene/scene.h"

namespace oriel {

/// The camera of a render command, or of the instance (or camera) `name` if given; null if there is
/// none.
const scene::Camera* find_camera(const scene::Scene& scene, const scene::RenderCommand& command,
                                 const std::string& name = {});

/// The files of a camera, each with the output shaders that precede it.
///
/// Model:   `output "types" "format" "file"`: the first picture type selects the content of a plain
///          file, all types select the layers of an EXR file; a sign (interpolation) is ignored.
///          `output "x" "file"`: x is a type ("rgba") or a format ("pic"); a known suffix of the
///          file selects the format, else x does. Then the frame buffers with a file. The name of a
///          frame buffer selects its content: an output of the materials
///          (output_of_frame_buffer()); the picture after all output shaders if it is primary or
///          named rgba, beauty or color; depth or normals if its type is z or n; the picture before
///          lens shaders if it is named like a side channel. Several buffers with the same EXR file
///          are layers of it, in addition to the picture. `user` is ignored. If user shaders can
///          write a buffer (World::user_buffers) of that number ("fb10") or name, its values have
///          priority over other meanings of the name.
/// Errors:  OR-RN-050 a file outside of the allowed folders is skipped (also if the path leaves
///          them through links); OR-RN-064 (note) an absolute path outside of them is replaced by
///          its file name in the base folder; OR-RN-051 unsupported type or format; OR-RN-052 not
///          an output shader; OR-RN-056 an output shader whose side channel is not written;
///          OR-RN-053 frame buffers with unknown names, in one message; OR-RN-054 a numbered buffer
///          ("fb0") that the options do not define or that no shader writes.
/// Checked: CameraOutput.* in camera_output_test.cpp
std::vector<PictureFile> camera_outputs(const scene::Camera& camera, const OutputRoots& roots,
                                        const scene::Scene& scene, const Registry& registry,
                                        World& world, Diagnostics& diagnostics);

/// Whether the suffix names a supported file type.
bool has_writable_suffix(const std::string& path);

/// All output shaders of a camera, for files that the user names.
NodeList camera_output_shaders(const scene::Camera& camera, const scene::Scene& scene,
                               const Registry& registry, World& world, Diagnostics& diagnostics);

}  // namespace oriel
