// SPDX-License-Identifier: Apache-2.0
// Other scene elements: options, cameras, lights, materials, textures, instances, groups.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "scene/object.h"
#include "scene/shader.h"

namespace oriel::scene {

/// options "name" ... end options. Statements in file order; interpreted by render_options.h.
struct Options {
  std::string name;
  std::vector<Statement> statements;
  ShaderList state;                                   ///< called before and after the image samples
  std::vector<UninterpretedStatement> uninterpreted;  ///< contour, data blocks
  SourceLocation where;
  bool operator==(const Options&) const = default;
};

/// One `output` statement of a camera: an image file or an output shader.
struct Output {
  std::string types;   ///< "rgba", "+rgba,z", "fb0"; empty if only a format was written
  std::string format;  ///< "exr", "tif"; empty for a shader
  std::string file;
  std::vector<Statement> modifiers;  ///< quality, compress, dpi, ...
  ShaderList shaders;                ///< an output shader instead of a file
  SourceLocation where;
  bool operator==(const Output&) const = default;
};

/// A `framebuffer` block of a camera: a named image buffer, with or without an output file.
struct FrameBuffer {
  std::string name;
  std::string datatype;              ///< "rgba_fp"; this and the next two are empty if not written
  std::string filename, filetype;    ///< as written; a type as in `output`
  std::optional<bool> filtering;     ///< samples are filtered; off: nearest sample
  std::optional<bool> primary;       ///< main image of the camera
  std::optional<bool> user;          ///< written by shaders only
  std::vector<Statement> modifiers;  ///< compression, quality, dpi, premultiplied, ...
  std::vector<UninterpretedStatement> uninterpreted;  ///< unknown items
  SourceLocation where;
  bool operator==(const FrameBuffer&) const = default;
};

/// camera "name" ... end camera
struct Camera {
  std::string name;
  std::optional<float> focal;  ///< unset for `focal infinity`, which sets `orthographic`
  bool orthographic = false;
  std::optional<float> aperture;  ///< film width, unit of focal; orthographic: width in scene units
  std::optional<float> aspect;    ///< image width / height
  std::optional<std::array<int, 2>> resolution;
  std::vector<Output> outputs;
  ShaderList lens, volume, environment;
  std::vector<Statement> other;  ///< offset, window, clip, frame, dof, ... as written
  std::vector<FrameBuffer> frame_buffers;
  std::vector<UninterpretedStatement> uninterpreted;  ///< pass blocks
  SourceLocation where;
  bool operator==(const Camera&) const = default;
};

/// light "name" ... end light. Origin, direction and area vectors are in the local space of the
/// light.
struct Light {
  std::string name;
  ShaderList shaders, emitters;
  std::optional<Vec3> origin, direction;
  std::optional<float> spread;    ///< cosine of the outer cone angle
  std::optional<Statement> area;  ///< keyword rectangle|disc|sphere|cylinder|object|user, numbers
  std::vector<Statement> other;   ///< energy, exponent, visible, photons, shadowmap, ...
  SourceLocation where;
  bool operator==(const Light&) const = default;
};

/// material "name" flags shader_list { slot shader_list }... end material
struct Material {
  std::string name;
  bool nocontour = false, opaque = false;
  ShaderList shaders;
  /// displace, shadow, volume, environment, contour, photon, photonvol, lightmap, hardware
  struct Slot {
    std::string keyword;
    ShaderList shaders;
    bool operator==(const Slot&) const = default;
  };
  std::vector<Slot> slots;
  SourceLocation where;
  const ShaderList* slot(std::string_view keyword) const;  ///< null if absent
  bool operator==(const Material&) const = default;
};

/// [local] [filter] color|scalar|vector texture "name" ...
struct Texture {
  std::string name;
  ParamType type = ParamType::ColorTexture;
  bool local = false, writable = false;
  std::optional<float> filter;    ///< set if `filter` was written (default 1)
  std::string file;               ///< as written; empty for pixels or a procedure
  std::string format, data_type;  ///< of the raw form
  std::vector<int> size;          ///< width height [bytes or depth]
  std::vector<std::uint8_t> pixels;
  ShaderList procedure;
  std::string directory;  ///< of the defining file, for relative names; not compared
  SourceLocation where;
  friend bool operator==(const Texture&, const Texture&);
};

/// lightprofile "name" ... end lightprofile
struct LightProfile {
  std::string name;
  std::vector<Statement> statements;
  std::string directory;  ///< of the defining file, for relative names; not compared
  SourceLocation where;
  friend bool operator==(const LightProfile& a, const LightProfile& b) {
    return a.name == b.name && a.statements == b.statements;
  }
};

/// Light list of an instance.
struct LightLinks {
  bool exclusive = false;
  std::vector<std::string> lights;
  bool operator==(const LightLinks&) const = default;
};

/// instance "name" "element" ... end instance
struct Instance {
  std::string name;
  std::string element;
  ShaderList geometry;            ///< geometry shaders instead of an element
  std::vector<Statement> flags;   ///< visible, shadow, hide, ... as written; override, approximate
  std::optional<Mat4> transform;  ///< parent space to local space, rows as written
  std::optional<Mat4> motion_transform;
  ShaderList transform_shaders;
  bool material_list = false;  ///< written in brackets
  std::vector<std::string> materials;
  std::optional<LightLinks> light_links, shadow_links;
  std::optional<std::vector<Argument>> parameters;
  std::vector<UninterpretedStatement> uninterpreted;
  SourceLocation where;
  bool operator==(const Instance&) const = default;
};

/// instgroup "name" members... end instgroup
struct InstanceGroup {
  std::string name;
  std::vector<Statement> settings;  ///< merge, tag, data
  std::vector<std::string> members;
  SourceLocation where;
  bool operator==(const InstanceGroup&) const = default;
};

/// assembly "name" box ... file "f" end assembly: a part of the scene in a separate file
struct Assembly {
  std::string name;
  std::vector<Statement> statements;  ///< box, motion box, file, tag, data
  std::string content;                ///< the loaded group; empty: not loaded
  SourceLocation where;
  bool operator==(const Assembly&) const = default;
};

/// data "name" ...: user data attached to other elements, for shaders. Contains bytes, or a file of
/// bytes, or parameters with a declared layout.
struct UserData {
  std::string name;
  std::optional<std::uint32_t> label;  ///< `tag N`
  std::optional<int> size;             ///< bytes, as written
  std::vector<std::uint8_t> bytes;
  std::string file;
  std::string declaration;  ///< of `declare data`
  std::vector<Argument> arguments;
  std::string next;       ///< set by geometry shaders that chain data; not written to files
  std::string directory;  ///< of the defining file, for relative names; not compared
  SourceLocation where;
  friend bool operator==(const UserData&, const UserData&);
};

/// An uninterpreted element: gui, colorprofile, spectrum, registry...
struct UninterpretedElement {
  std::string kind;
  std::string name;
  std::string text;  ///< source between the name and the end, tokens separated by blanks
  SourceLocation where;
  bool operator==(const UninterpretedElement&) const = default;
};

/// render "root" "camera instance" "options"
struct RenderCommand {
  std::string root, camera, options;
  SourceLocation where;
  bool operator==(const RenderCommand&) const = default;
};

}  // namespace oriel::scene
