// SPDX-License-Identifier: Apache-2.0
// Declarations of shaders, data and phenomena.
#include "mi/write_parts.h"

namespace oriel::mi {
namespace {

using scene::ParamDecl;
using scene::ParamType;

void write_members(TextSink& out, const std::vector<ParamDecl>& members, int depth);

/// Writes type, name and default. The name of an array is written after its element type.
void write_parameter(TextSink& out, const ParamDecl& p, const std::string& name, int depth) {
  out.put(scene::type_name(p.type));
  out.put(' ');
  if (p.type == ParamType::Array) {
    if (!p.members.empty()) write_parameter(out, p.members[0], name, depth);
    return;
  }
  if (!p.type_argument.empty()) {
    out.quoted(p.type_argument);
    out.put(' ');
  }
  out.quoted(name);
  if (p.type == ParamType::Struct) {
    out.put(' ');
    write_members(out, p.members, depth);
  }
  if (p.default_value) {
    out.put(" default ");
    write_value(out, *p.default_value, depth);
  }
}

void write_list(TextSink& out, const std::vector<ParamDecl>& parameters, char open, char close,
                int depth) {
  out.put(open);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    out.put(i ? ",\n" : "\n");
    write_indent(out, depth + 1);
    write_parameter(out, parameters[i], parameters[i].name, depth + 1);
  }
  if (!parameters.empty()) {
    out.put('\n');
    write_indent(out, depth);
  }
  out.put(close);
}

void write_members(TextSink& out, const std::vector<ParamDecl>& members, int depth) {
  write_list(out, members, '{', '}', depth);
}

/// A single unnamed result is written as a plain type, all others as a struct.
void write_results(TextSink& out, const std::vector<ParamDecl>& results) {
  if (results.empty()) return;
  if (results.size() == 1 && results[0].name.empty()) {
    out.put(scene::type_name(results[0].type));
  } else {
    out.put("struct ");
    write_members(out, results, 0);
  }
  out.put(' ');
}

/// Writes the statements of the end part. Only the words of `apply` are separated by commas.
void write_requirements(TextSink& out, const std::vector<scene::Statement>& requirements) {
  for (const scene::Statement& s : requirements) {
    if (s.keyword != "apply") {
      write_statement(out, s, 1);
      continue;
    }
    write_indent(out, 1);
    out.put(s.keyword);
    for (std::size_t i = 0; i < s.values.size(); ++i) {
      out.put(i ? ", " : " ");
      write_value(out, s.values[i], 1);
    }
    out.put('\n');
  }
}

void write_head(TextSink& out, std::string_view kind, const scene::ShaderDeclaration& d) {
  out.put("declare ");
  out.put(kind);
  write_results(out, d.results);
  out.quoted(d.name);
  out.put(' ');
  write_list(out, d.parameters, '(', ')', 0);
  out.put('\n');
}

template <class T>
void write_inner(TextSink& out, const std::vector<T>& elements) {
  for (const T& e : elements) {
    write_indent(out, 1);
    write_element(out, e, 1);
  }
}

}  // namespace

void write_declaration(TextSink& out, const scene::ShaderDeclaration& d) {
  write_head(out, d.old_form ? "" : "shader ", d);
  if (d.old_form) return;
  write_requirements(out, d.requirements);
  write_uninterpreted(out, d.uninterpreted, 1);
  out.put("end declare\n");
}

void write_declaration(TextSink& out, const scene::DataDeclaration& d) {
  out.put("declare data ");
  out.quoted(d.name);
  out.put(' ');
  write_list(out, d.parameters, '(', ')', 0);
  out.put('\n');
  write_requirements(out, d.requirements);
  write_uninterpreted(out, d.uninterpreted, 1);
  out.put("end declare\n");
}

void write_phenomenon(TextSink& out, const scene::Phenomenon& p) {
  write_head(out, "phenomenon ", p.declaration);
  write_inner(out, p.shaders);
  write_inner(out, p.materials);
  write_inner(out, p.lights);
  write_inner(out, p.instances);
  for (const scene::Phenomenon::Root& root : p.roots) {
    write_indent(out, 1);
    out.put(root.keyword);
    if (!root.name.empty()) {
      out.put(' ');
      out.quoted(root.name);
    }
    write_shader_list(out, root.shaders, 1);
    out.put('\n');
  }
  write_requirements(out, p.requirements);
  write_requirements(out, p.declaration.requirements);
  write_uninterpreted(out, p.declaration.uninterpreted, 1);
  out.put("end declare\n");
}

}  // namespace oriel::mi
