// SPDX-License-Identifier: Apache-2.0
#include "output/camera_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "output/output_names.h"
#include "output/output_request.h"
#include "runtime/binder.h"
#include "runtime/color_mapping.h"
#include "runtime/fallback_shader.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;

/// Resolves output shaders one by one. They have no light lists.
class ShaderReader {
 public:
  ShaderReader(const scene::Scene& scene, const Registry& registry, World& world,
               Diagnostics& diagnostics)
      : world_(world),
        binder_(scene, registry, world, no_lights_, diagnostics),
        diagnostics_(diagnostics) {}

  void append(const scene::Output& output, NodeList& nodes) {
    for (const ShaderNode* node : binder_.bind(output.shaders)) {
      if (node->spec().lens.map_color) {
        nodes.push_back(node);
        note_preview(*node, world_);
        warn_missing_channel(*node, output);
      } else if (node->spec().output) {
        nodes.push_back(node);
      } else if (!node->spec().fallback.is_fallback &&
                 // substitutes of host shaders such as buffers and shader glow
                 !is_substitute(node->spec()))
        diagnostics_.warning(
            "OR-RN-052", output.where,
            fmt::format("shader \"{}\" is not an output shader; it is skipped", node->spec().name));
    }
  }

 private:
  void warn_missing_channel(const ShaderNode& node, const scene::Output& output) {
    const LensTraits traits = lens_traits(node);
    if (traits.side_channel_mode == 0 || has_side_channel(world_, traits.side_channel)) return;
    diagnostics_.warning(
        "OR-RN-056", output.where,
        fmt::format("output shader \"{}\" reads the side channel \"{}\", which no lens "
                    "shader writes; it uses the beauty instead",
                    node.spec().name, traits.side_channel),
        "add a copy of the shader with the same side_channel and mode to the lens shaders of the "
        "camera");
  }

  World& world_;
  std::unordered_map<std::string, std::vector<int>> no_lights_;
  Binder binder_;
  Diagnostics& diagnostics_;
};

/// Whether a frame buffer contains the beauty.
bool is_picture(const scene::FrameBuffer& buffer) {
  const std::string name = lower_case(buffer.name);
  return buffer.primary.value_or(false) || name == "rgba" || name == "beauty" || name == "color";
}

/// Depth, normals, labels and coverage exist once, independent of the name of the buffer.
bool is_geometry_type(std::string_view datatype) {
  if (datatype.starts_with('+') || datatype.starts_with('-')) datatype.remove_prefix(1);
  return datatype == "z" || datatype == "n" || datatype == "tag" || datatype == "coverage";
}

/// Several buffers with the same EXR file become its layers.
void add_file(PictureFile file, std::vector<PictureFile>& files) {
  const auto same = std::find_if(files.begin(), files.end(), [&](const PictureFile& f) {
    return f.path == file.path && f.format == "exr" && file.format == "exr";
  });
  if (same == files.end()) return files.push_back(std::move(file));
  for (const std::string* shown : {&same->shown_layer, &file.shown_layer})
    if (!shown->empty()) same->layers |= LayerSet(*shown);
  same->layers |= file.layers;
  same->shown_layer.clear();
  same->user_buffer = -1;
  same->only_user_buffer = false;
  same->samples = std::max(same->samples, file.samples);
}

/// Makes the files of the frame buffers.
class BufferReader {
 public:
  BufferReader(const OutputRoots& roots, const World& world, Diagnostics& diagnostics)
      : roots_(roots), world_(world), diagnostics_(diagnostics) {}

  void read(const scene::FrameBuffer& buffer, const NodeList& shaders,
            std::vector<PictureFile>& files) {
    if (buffer.filename.empty()) return;
    const int shown = is_picture(buffer) ? -1 : output_of_frame_buffer(buffer.name);
    const int written = is_picture(buffer) ? -1 : user_buffer(buffer.name);
    scene::Output output{buffer.datatype.empty() ? "rgba" : buffer.datatype, buffer.filetype,
                         buffer.filename, buffer.modifiers};
    output.where = buffer.where;
    const bool side_channel = has_side_channel(world_, buffer.name);
    const bool means_nothing =
        shown < 0 && !side_channel && !is_picture(buffer) && !is_geometry_type(output.types);
    if (means_nothing && written < 0) {
      unknown_ += fmt::format("{}\"{}\"", unknown_.empty() ? "" : ", ", buffer.name);
      if (count_++ == 0) first_ = buffer.where;
      return;
    }
    // The buffer defines the pixel type of values written by a shader.
    if (means_nothing)
      output.types =
          "rgba" + output.types.substr(std::min(output.types.find('_'), output.types.size()));
    std::optional<PictureFile> file =
        requested_file(output, "framebuffer", roots_, world_.user_buffers, diagnostics_);
    if (!file) return;
    file->user_buffer = written;
    file->only_user_buffer = means_nothing;
    if (shown >= 0)
      file->shown_layer = material_output_names()[static_cast<std::size_t>(shown)];
    else if (side_channel)
      file->unmapped = true;
    else
      file->shaders = shaders;
    add_file(std::move(*file), files);
  }

  void report_unknown() {
    if (count_ == 0) return;
    diagnostics_.error(
        "OR-RN-053", first_,
        fmt::format("framebuffer {} {} not match any render output; {} skipped", unknown_,
                    count_ == 1 ? "does" : "do", count_ == 1 ? "it is" : "they are"),
        fmt::format("use a name that ends in one of {}, or use rgba, beauty, color or "
                    "primary on for the beauty",
                    fmt::join(material_output_names(), ", ")));
  }

 private:
  /// Index of the buffer in World::user_buffers; -1 if not found.
  int user_buffer(std::string_view name) const {
    const auto& all = world_.user_buffers;
    const auto at = std::find_if(all.begin(), all.end(), [&](auto& b) { return b.name == name; });
    return at == all.end() || name.empty() ? -1 : static_cast<int>(at - all.begin());
  }

  const OutputRoots& roots_;
  const World& world_;
  Diagnostics& diagnostics_;
  std::string unknown_;
  int count_ = 0;
  SourceLocation first_;
};

}  // namespace

const scene::Camera* find_camera(const scene::Scene& scene, const scene::RenderCommand& command,
                                 const std::string& name) {
  const std::string& wanted = name.empty() ? command.camera : name;
  if (const auto* instance = scene.get<scene::Instance>(wanted))
    return scene.get<scene::Camera>(instance->element);
  return scene.get<scene::Camera>(wanted);
}

bool has_writable_suffix(const std::string& path) {
  const std::string suffix = lower_case(fs::path(path).extension().string());
  return !suffix.empty() && !writable_format(suffix.substr(1)).empty();
}

std::vector<PictureFile> camera_outputs(const scene::Camera& camera, const OutputRoots& roots,
                                        const scene::Scene& scene, const Registry& registry,
                                        World& world, Diagnostics& diagnostics) {
  ShaderReader shaders(scene, registry, world, diagnostics);
  NodeList before;
  std::vector<PictureFile> out;
  for (const scene::Output& output : camera.outputs) {
    if (!output.shaders.empty()) {
      if (world.options.output) shaders.append(output, before);
      continue;
    }
    if (std::optional<PictureFile> file =
            requested_file(output, "output", roots, world.user_buffers, diagnostics)) {
      file->shaders = before;
      out.push_back(std::move(*file));
    }
  }
  BufferReader buffers(roots, world, diagnostics);
  for (const scene::FrameBuffer& b : camera.frame_buffers) buffers.read(b, before, out);
  buffers.report_unknown();
  return out;
}

NodeList camera_output_shaders(const scene::Camera& camera, const scene::Scene& scene,
                               const Registry& registry, World& world, Diagnostics& diagnostics) {
  ShaderReader shaders(scene, registry, world, diagnostics);
  NodeList nodes;
  for (const scene::Output& output : camera.outputs)
    if (!output.shaders.empty() && world.options.output) shaders.append(output, nodes);
  return nodes;
}

}  // namespace oriel
