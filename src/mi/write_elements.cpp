// SPDX-License-Identifier: Apache-2.0
// All elements except objects.
#include <algorithm>

#include "mi/write_parts.h"

namespace oriel::mi {
namespace {

void begin(TextSink& out, std::string_view kind, const std::string& name) {
  out.put(kind);
  out.put(' ');
  out.quoted(name);
}

void end(TextSink& out, std::string_view kind, int depth) {
  write_indent(out, depth);
  out.put("end ");
  out.put(kind);
  out.put('\n');
}

void write_list(TextSink& out, std::string_view keyword, const scene::ShaderList& list, int depth) {
  if (list.empty()) return;
  write_indent(out, depth);
  out.put(keyword);
  write_shader_list(out, list, depth);
  out.put('\n');
}

void write_float(TextSink& out, std::string_view keyword, const std::optional<float>& value,
                 int depth) {
  if (!value) return;
  write_indent(out, depth);
  out.put(keyword);
  out.put(' ');
  out.number(*value);
  out.put('\n');
}

void write_vector(TextSink& out, std::string_view keyword, const std::optional<Vec3>& v,
                  int depth) {
  if (!v) return;
  write_indent(out, depth);
  out.put(keyword);
  for (const float x : {v->x, v->y, v->z}) {
    out.put(' ');
    out.number(x);
  }
  out.put('\n');
}

/// Whether a single string before the file name is unambiguous. The manual defines it as a format,
/// but many files write a type there. Ambiguous outputs are written with type and format.
bool is_unmistakable(const scene::Output& output) {
  constexpr std::string_view kFormats[] = {"tif", "png", "exr", "hdr", "jpg", "tga",
                                           "iff", "pic", "bmp", "ppm", "rla"};
  constexpr std::string_view kTypes[] = {"rgba", "a", "s", "z", "n", "m", "tag", "coverage"};
  if (output.types.empty())
    return std::find(std::begin(kFormats), std::end(kFormats), output.format) != std::end(kFormats);
  if (output.format.empty())
    return std::find(std::begin(kTypes), std::end(kTypes), output.types) != std::end(kTypes) ||
           output.types.find_first_of("+-,_") != std::string::npos ||
           output.types.starts_with("fb") ||
           (output.types == "rgb" && !output.file.ends_with(".rgb"));
  return false;
}

void write_output(TextSink& out, const scene::Output& output) {
  write_indent(out, 1);
  out.put("output");
  const auto string = [&](const std::string& text) {
    out.put(' ');
    out.quoted(text);
  };
  if (!output.shaders.empty()) {
    if (!output.types.empty()) string(output.types);
    write_shader_list(out, output.shaders, 1);
    out.put('\n');
    return;
  }
  const bool neither = output.types.empty() && output.format.empty();
  const bool one = !neither && is_unmistakable(output);
  if (!neither && !(one && output.types.empty())) string(output.types);
  if (!neither && !(one && output.format.empty())) string(output.format);
  for (const scene::Statement& s : output.modifiers) {
    out.put(' ');
    out.put(s.keyword);
    for (const scene::Value& value : s.values) {
      out.put(' ');
      write_value(out, value, 1);
    }
  }
  string(output.file);
  out.put('\n');
}

// One item per line. The item list ends at the next camera statement.
void write_frame_buffer(TextSink& out, const scene::FrameBuffer& buffer, int depth) {
  write_indent(out, depth);
  begin(out, "framebuffer", buffer.name);
  out.put('\n');
  const auto item = [&](std::string_view keyword) {
    write_indent(out, depth + 1);
    out.put(keyword);
    out.put(' ');
  };
  const auto text = [&](std::string_view keyword, const std::string& value) {
    if (value.empty()) return;
    item(keyword);
    out.quoted(value);
    out.put('\n');
  };
  const auto flag = [&](std::string_view keyword, const std::optional<bool>& value) {
    if (!value) return;
    item(keyword);
    out.put(*value ? "on\n" : "off\n");
  };
  text("datatype", buffer.datatype);
  text("filename", buffer.filename);
  text("filetype", buffer.filetype);
  flag("filtering", buffer.filtering);
  flag("primary", buffer.primary);
  flag("user", buffer.user);
  write_statements(out, buffer.modifiers, depth + 1);
  write_uninterpreted(out, buffer.uninterpreted, depth + 1);
}

void write_links(TextSink& out, std::string_view keyword,
                 const std::optional<scene::LightLinks>& links, int depth) {
  if (!links) return;
  write_indent(out, depth);
  out.put(keyword);
  if (links->exclusive) out.put(" \"exclusive\"");
  out.put(' ');
  write_names(out, links->lights);
  out.put('\n');
}

void write_bytes(TextSink& out, const std::vector<std::uint8_t>& pixels) {
  constexpr std::size_t kBytesInLine = 32;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (i % kBytesInLine == 0) out.put(i ? "'\n'" : "\n'");
    out.hex(pixels[i]);
  }
  if (!pixels.empty()) out.put('\'');
}

void write_transform(TextSink& out, const scene::Instance& instance, int depth) {
  if (instance.transform) {
    write_indent(out, depth);
    out.put("transform");
    write_matrix(out, *instance.transform, depth + 1);
    out.put('\n');
  }
  write_list(out, "transform", instance.transform_shaders, depth);
  if (instance.motion_transform) {
    write_indent(out, depth);
    out.put("motion transform");
    write_matrix(out, *instance.motion_transform, depth + 1);
    out.put('\n');
  }
}

void write_materials(TextSink& out, const scene::Instance& instance, int depth) {
  if (instance.materials.empty() && !instance.material_list) return;
  write_indent(out, depth);
  out.put("material ");
  if (instance.material_list || instance.materials.size() != 1)
    write_names(out, instance.materials);
  else
    out.quoted(instance.materials[0]);
  out.put('\n');
}

}  // namespace

void write_element(TextSink& out, const scene::Options& options, int depth) {
  begin(out, "options", options.name);
  out.put('\n');
  for (std::size_t i = 0; i < options.statements.size(); ++i) {
    scene::Statement s = options.statements[i];
    // An empty type keeps a following string option from being read as the type.
    const bool string_follows =
        i + 1 < options.statements.size() && options.statements[i + 1].quoted;
    if (s.keyword == "frame buffer" && s.values.size() == 1 && string_follows) {
      s.values.emplace_back();
      s.values.back().kind = scene::Value::Kind::Text;
    }
    write_statement(out, s, depth + 1);
  }
  if (!options.state.empty()) {
    write_indent(out, depth + 1);
    out.put("state [");
    for (std::size_t i = 0; i < options.state.size(); ++i) {
      if (i > 0) out.put(" ,");
      write_shader_list(out, {options.state[i]}, depth + 1);
    }
    out.put(" ]\n");
  }
  write_uninterpreted(out, options.uninterpreted, depth + 1);
  end(out, "options", depth);
}

void write_element(TextSink& out, const scene::Camera& camera, int depth) {
  begin(out, "camera", camera.name);
  out.put('\n');
  for (const scene::Output& output : camera.outputs) write_output(out, output);
  if (camera.orthographic) {
    write_indent(out, depth + 1);
    out.put("focal infinity\n");
  }
  write_float(out, "focal", camera.focal, depth + 1);
  write_float(out, "aperture", camera.aperture, depth + 1);
  write_float(out, "aspect", camera.aspect, depth + 1);
  if (camera.resolution) {
    write_indent(out, depth + 1);
    out.put("resolution ");
    out.integer((*camera.resolution)[0]);
    out.put(' ');
    out.integer((*camera.resolution)[1]);
    out.put('\n');
  }
  write_statements(out, camera.other, depth + 1);
  write_list(out, "lens", camera.lens, depth + 1);
  write_list(out, "volume", camera.volume, depth + 1);
  write_list(out, "environment", camera.environment, depth + 1);
  // These blocks end at the next camera statement, so they are written last.
  for (const scene::FrameBuffer& b : camera.frame_buffers) write_frame_buffer(out, b, depth + 1);
  write_uninterpreted(out, camera.uninterpreted, depth + 1);
  end(out, "camera", depth);
}

void write_element(TextSink& out, const scene::Light& light, int depth) {
  begin(out, "light", light.name);
  write_shader_list(out, light.shaders, depth + 1);
  out.put('\n');
  write_list(out, "emitter", light.emitters, depth + 1);
  write_vector(out, "origin", light.origin, depth + 1);
  write_vector(out, "direction", light.direction, depth + 1);
  write_float(out, "spread", light.spread, depth + 1);
  if (light.area) write_statement(out, *light.area, depth + 1);
  write_statements(out, light.other, depth + 1);
  end(out, "light", depth);
}

void write_element(TextSink& out, const scene::Material& material, int depth) {
  begin(out, "material", material.name);
  if (material.nocontour) out.put(" nocontour");
  if (material.opaque) out.put(" opaque");
  write_shader_list(out, material.shaders, depth + 1);
  out.put('\n');
  for (const auto& slot : material.slots) {
    write_indent(out, depth + 1);
    out.put(slot.keyword);
    write_shader_list(out, slot.shaders, depth + 1);
    out.put('\n');
  }
  end(out, "material", depth);
}

void write_element(TextSink& out, const scene::Texture& texture, int depth) {
  if (texture.local) out.put("local ");
  if (texture.filter) {
    out.put("filter ");
    out.number(*texture.filter);
    out.put(' ');
  }
  if (texture.writable) out.put("writable ");
  begin(out, scene::type_name(texture.type), texture.name);
  if (!texture.procedure.empty()) {
    write_shader_list(out, texture.procedure, depth + 1);
    out.put('\n');
    return;
  }
  const bool inline_pixels = texture.file.empty() && !texture.size.empty();
  for (const std::string* text : {&texture.file, &texture.format, &texture.data_type}) {
    if (text == &texture.file ? inline_pixels : text->empty()) continue;
    out.put(' ');
    out.quoted(*text);
  }
  if (!texture.size.empty()) {
    out.put(" [");
    for (const int n : texture.size) {
      out.put(' ');
      out.integer(n);
    }
    out.put(" ]");
  }
  write_bytes(out, texture.pixels);
  out.put('\n');
}

void write_element(TextSink& out, const scene::LightProfile& profile, int depth) {
  begin(out, "lightprofile", profile.name);
  out.put('\n');
  write_statements(out, profile.statements, depth + 1);
  end(out, "lightprofile", depth);
}

void write_element(TextSink& out, const scene::Instance& instance, int depth) {
  begin(out, "instance", instance.name);
  if (!instance.geometry.empty()) {
    out.put(" geometry");
    write_shader_list(out, instance.geometry, depth + 1);
  } else if (!instance.element.empty()) {
    out.put(' ');
    out.quoted(instance.element);
  }
  out.put('\n');
  // Flags first: `light` and `motion` could otherwise consume a following `shadow` or `off`.
  write_statements(out, instance.flags, depth + 1);
  write_uninterpreted(out, instance.uninterpreted, depth + 1);
  write_transform(out, instance, depth + 1);
  write_materials(out, instance, depth + 1);
  write_links(out, "light", instance.light_links, depth + 1);
  write_links(out, "light shadow", instance.shadow_links, depth + 1);
  if (instance.parameters) {
    write_indent(out, depth + 1);
    write_arguments(out, *instance.parameters, '(', ')', depth + 1);
    out.put('\n');
  }
  end(out, "instance", depth);
}

void write_element(TextSink& out, const scene::InstanceGroup& group, int depth) {
  begin(out, "instgroup", group.name);
  out.put('\n');
  write_statements(out, group.settings, depth + 1);
  for (const std::string& member : group.members) {
    write_indent(out, depth + 1);
    out.quoted(member);
    out.put('\n');
  }
  end(out, "instgroup", depth);
}

void write_element(TextSink& out, const scene::ShaderElement& shader, int depth) {
  begin(out, "shader", shader.name);
  write_shader_list(out, shader.functions, depth);
  out.put('\n');
}

void write_element(TextSink& out, const scene::Assembly& assembly, int depth) {
  begin(out, "assembly", assembly.name);
  out.put('\n');
  write_statements(out, assembly.statements, depth + 1);
  end(out, "assembly", depth);
}

void write_element(TextSink& out, const scene::UserData& data, int depth) {
  begin(out, "data", data.name);
  if (data.label) {
    out.put(" tag ");
    out.index(*data.label);
  }
  out.put(' ');
  if (!data.declaration.empty()) {
    out.quoted(data.declaration);
    out.put(' ');
    write_arguments(out, data.arguments, '(', ')', depth);
  } else if (!data.file.empty()) {
    out.quoted(data.file);
  } else if (data.size || !data.bytes.empty()) {
    out.integer(data.size.value_or(static_cast<int>(data.bytes.size())));
    out.put(" [");
    write_bytes(out, data.bytes);
    out.put(" ]");
  } else {
    out.put("null");
  }
  out.put('\n');
}

void write_element(TextSink& out, const scene::UninterpretedElement& element, int depth) {
  begin(out, element.kind, element.name);
  out.put(' ');
  out.put(element.text);
  out.put('\n');
  if (element.kind != "gui") end(out, element.kind, depth);
}

}  // namespace oriel::mi
