// SPDX-License-Identifier: Apache-2.0
// Parts of the writer: values and shader calls, declarations, geometry. See writer.h.
#pragma once

#include "mi/text_sink.h"
#include "scene/scene.h"

namespace oriel::mi {

// Conventions
//   A part starts at the current position and ends its last line. Values and shader lists do not
//   end the line. `depth` is the indentation level.

// write_values.cpp
void write_indent(TextSink& out, int depth);
void write_value(TextSink& out, const scene::Value& value, int depth);
/// Writes the arguments in `open` and `close`, one per line.
void write_arguments(TextSink& out, const std::vector<scene::Argument>& arguments, char open,
                     char close, int depth);
/// Writes a blank before each shader.
void write_shader_list(TextSink& out, const scene::ShaderList& list, int depth);
/// Writes one line.
void write_statement(TextSink& out, const scene::Statement& statement, int depth);
void write_statements(TextSink& out, const std::vector<scene::Statement>& statements, int depth);
void write_uninterpreted(TextSink& out,
                         const std::vector<scene::UninterpretedStatement>& uninterpreted,
                         int depth);
void write_names(TextSink& out, const std::vector<std::string>& names);  ///< [ "a", "b" ]
void write_matrix(TextSink& out, const Mat4& matrix, int depth);

// write_declare.cpp
void write_declaration(TextSink& out, const scene::ShaderDeclaration& declaration);
void write_declaration(TextSink& out, const scene::DataDeclaration& declaration);
void write_phenomenon(TextSink& out, const scene::Phenomenon& phenomenon);

// write_subdivision.cpp
/// Writes the material name or label of consecutive faces. A face without a name inherits the
/// previous name, so an empty name is written to reset it. Labels are always written.
class FaceMaterials {
 public:
  FaceMaterials(const scene::PolygonGroup& group, bool tagged) : group_(group), tagged_(tagged) {}
  void write(TextSink& out, std::uint32_t material);

 private:
  const scene::PolygonGroup& group_;
  bool tagged_;
  std::uint32_t last_ = scene::kNone;
};
void write_subdivision(TextSink& out, const scene::SubdivisionSurface& surface,
                       FaceMaterials& materials);

// write_hair.cpp
void write_hair(TextSink& out, const scene::Hair& hair, int depth);

// write_object.cpp
void write_element(TextSink& out, const scene::Object& object, int depth);

// write_freeform.cpp
void write_bases(TextSink& out, const std::vector<scene::Basis>& bases);
void write_freeform(TextSink& out, const scene::PolygonGroup& group, bool tagged);

// write_elements.cpp
void write_element(TextSink& out, const scene::Options& options, int depth);
void write_element(TextSink& out, const scene::Camera& camera, int depth);
void write_element(TextSink& out, const scene::Light& light, int depth);
void write_element(TextSink& out, const scene::Material& material, int depth);
void write_element(TextSink& out, const scene::Texture& texture, int depth);
void write_element(TextSink& out, const scene::LightProfile& profile, int depth);
void write_element(TextSink& out, const scene::Instance& instance, int depth);
void write_element(TextSink& out, const scene::InstanceGroup& group, int depth);
void write_element(TextSink& out, const scene::ShaderElement& shader, int depth);
void write_element(TextSink& out, const scene::Assembly& assembly, int depth);
void write_element(TextSink& out, const scene::UserData& data, int depth);
void write_element(TextSink& out, const scene::UninterpretedElement& element, int depth);

}  // namespace oriel::mi
