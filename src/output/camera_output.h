// SPDX-License-Identifier: Apache-2.0
// What a camera's `output` statements ask for: which files, with what in them, where.
#pragma once

#include <string>
#include <vector>

#include "output/output.h"
#include "output/output_place.h"
#include "scene/scene.h"

namespace oriel {

/// The camera of a render command, or of the instance (or camera) `name` when that is given; null
/// when there is none.
const scene::Camera* find_camera(const scene::Scene& scene, const scene::RenderCommand& command,
                                 const std::string& name = {});

/// The files a camera asks for, each with the output shaders that stand before it.
///
/// Model:   `output "types" "format" "file"`: the first type that is a picture decides what a plain
///          file shows, all of them which layers an EXR file has; a sign (interpolation) is
///          accepted and has no effect. `output "x" "file"`: x is a type ("rgba") or a format
///          ("pic"); a known suffix of the file decides its format, else x does.
///          Then the frame buffers with a file: one whose name means an output of the materials
///          (output_of_frame_buffer()) shows that output; one that is primary, or named rgba,
///          beauty or color, the picture after all output shaders; one of type z or n depth or
///          normals; one named as a side channel, the picture before lens shaders. Several of one
///          EXR file are layers of it, beside the picture. `user` has no effect. Where users'
///          shaders may write buffers (World::user_buffers) a file shows what they wrote, by number
///          ("fb10") or name, rather than what else the name means.
/// Errors:  OR-RN-050 a file outside of the allowed folders is left out (a path that leads out
///          through links counts as outside); OR-RN-064 (note) an absolute path outside of them is
///          replaced by its file name in the base folder; OR-RN-051 a type or format nobody can
///          write; OR-RN-052 an output shader that is none; OR-RN-056 one whose side channel is not
///          filled; OR-RN-053 frame buffers whose names mean nothing, all in one message; OR-RN-054
///          a numbered buffer ("fb0") that the options do not have or no shader could write.
/// Checked: CameraOutput.* in camera_output_test.cpp
std::vector<PictureFile> camera_outputs(const scene::Camera& camera, const OutputRoots& roots,
                                        const scene::Scene& scene, const Registry& registry,
                                        World& world, Diagnostics& diagnostics);

/// Whether the suffix names a file type that can be written.
bool has_writable_suffix(const std::string& path);

/// All output shaders of a camera, for files that the user names.
NodeList camera_output_shaders(const scene::Camera& camera, const scene::Scene& scene,
                               const Registry& registry, World& world, Diagnostics& diagnostics);

}  // namespace oriel
