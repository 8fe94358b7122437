// SPDX-License-Identifier: Apache-2.0
// Readers of values, shader calls, elements and declarations. Conventions: parse.h.
#pragma once

#include "mi/parse.h"

namespace oriel::mi {

// values.cpp
scene::Value read_value(Parse& parse);
/// Reads arguments up to and including the closing bracket.
std::vector<scene::Argument> read_arguments(Parse& parse, char close);

// shaders.cpp
/// Whether the next token starts a shader: a string, '=', or a bare word before '('.
bool at_shader(Parse& parse);
scene::ShaderUse read_shader(Parse& parse);
scene::ShaderList read_shader_list(Parse& parse);
/// Reads a shader call after its type name. A missing '(' is reported.
scene::ShaderUse read_call(Parse& parse, std::string type, SourceLocation at);
void read_shader_element(Parse& parse, SourceLocation at);

/// First words of camera statements. They end the open lists of framebuffer and pass.
inline constexpr std::string_view kCameraWords[] = {
    "output", "framebuffer", "pass",   "lens", "volume", "environment", "focal", "aperture",
    "aspect", "resolution",  "offset", "clip", "window", "dof",         "frame", "data"};

// One file per element, with the name of the element.
void read_options(Parse& parse, SourceLocation at);
void read_camera(Parse& parse, SourceLocation at);
void read_frame_buffer(Parse& parse, scene::Camera& camera, SourceLocation at);
void read_light(Parse& parse, SourceLocation at);
void read_light_profile(Parse& parse, SourceLocation at);
void read_material(Parse& parse, SourceLocation at);
/// `word` is the first word of the element: local, filter, writable, color, scalar, vector.
void read_texture(Parse& parse, std::string_view word, SourceLocation at);
void read_user_data(Parse& parse, SourceLocation at);
/// Appends the bytes of the next token, a hexadecimal block.
void append_hex(Parse& parse, std::vector<std::uint8_t>& bytes);
void read_object(Parse& parse, SourceLocation at);
void read_instance(Parse& parse, SourceLocation at);
void read_instance_group(Parse& parse, SourceLocation at);
void read_assembly(Parse& parse, SourceLocation at);

// geometry
void read_group(Parse& parse, scene::Object& object, SourceLocation at);
void read_trilist(Parse& parse, scene::Object& object, SourceLocation at);
void read_hair(Parse& parse, scene::Object& object, SourceLocation at);

// declare.cpp, phenomenon.cpp
void read_declare(Parse& parse, SourceLocation at);
void read_phenomenon(Parse& parse, SourceLocation at);
/// Reads result "name" ( parameters ), the common head of shaders and phenomena.
void read_declaration_head(Parse& parse, scene::ShaderDeclaration& d, SourceLocation at);
std::vector<scene::ParamDecl> read_parameter_declarations(Parse& parse, char close);
/// Reads a statement of the end part of a declaration (version, apply, ...).
void read_requirement(Parse& parse, std::vector<scene::Statement>& requirements,
                      std::vector<scene::UninterpretedStatement>& uninterpreted);

// uninterpreted.cpp: constructs stored as text
void append_source(std::string& text, const Token& token);
/// Returns all source up to `end kind`; consumes `end kind`.
std::string keep_until_end(Parse& parse, std::string_view kind);
/// Appends the next group in brackets of any kind, including the brackets.
void keep_brackets(Parse& parse, std::string& text);
/// Returns the tokens up to one of `words` or `end`. Groups in brackets are not split.
std::string keep_until_word(Parse& parse, std::span<const std::string_view> words);
/// `gui`, `registry`, `colorprofile`, `spectrum` elements.
void read_uninterpreted_element(Parse& parse, std::string_view kind, SourceLocation at);
scene::UninterpretedStatement read_gui(Parse& parse, SourceLocation at);

// commands.cpp
/// Reads one top-level statement. Returns true after `render`.
bool read_top_level(Parse& parse);
void finish_reading(Parse& parse);

// resolve.cpp
/// Reports undefined names in all elements and in `render`.
void report_unresolved(Parse& parse, const scene::RenderCommand& render);

}  // namespace oriel::mi
