// SPDX-License-Identifier: Apache-2.0
// The readers of values, shader calls, elements and declarations. See parse.h for conventions.
#pragma once

#include "mi/parse.h"

namespace oriel::mi {

// values.cpp
scene::Value read_value(Parse& parse);
/// Arguments up to and including the closing bracket.
std::vector<scene::Argument> read_arguments(Parse& parse, char close);

// shaders.cpp
/// A string, '=', or a bare word before '(' stands here.
bool at_shader(Parse& parse);
scene::ShaderUse read_shader(Parse& parse);
scene::ShaderList read_shader_list(Parse& parse);
/// The call of a type whose name was read already; its '(' stands here or is missing.
scene::ShaderUse read_call(Parse& parse, std::string type, SourceLocation at);
void read_shader_element(Parse& parse, SourceLocation at);

/// Where a camera statement begins; ends the open lists of framebuffer and pass.
inline constexpr std::string_view kCameraWords[] = {
    "output", "framebuffer", "pass",   "lens", "volume", "environment", "focal", "aperture",
    "aspect", "resolution",  "offset", "clip", "window", "dof",         "frame", "data"};

// one file each, named after the element
void read_options(Parse& parse, SourceLocation at);
void read_camera(Parse& parse, SourceLocation at);
void read_frame_buffer(Parse& parse, scene::Camera& camera, SourceLocation at);
void read_light(Parse& parse, SourceLocation at);
void read_light_profile(Parse& parse, SourceLocation at);
void read_material(Parse& parse, SourceLocation at);
/// `word` is the first one: local, filter, writable, color, scalar, vector.
void read_texture(Parse& parse, std::string_view word, SourceLocation at);
void read_user_data(Parse& parse, SourceLocation at);
/// The bytes of a hexadecimal block that stands here.
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
/// result "name" ( parameters ), common to shaders and phenomena.
void read_declaration_head(Parse& parse, scene::ShaderDeclaration& d, SourceLocation at);
std::vector<scene::ParamDecl> read_parameter_declarations(Parse& parse, char close);
/// A statement of a declaration's end part (version, apply, ...), into `d`.
void read_requirement(Parse& parse, std::vector<scene::Statement>& requirements,
                      std::vector<scene::UninterpretedStatement>& uninterpreted);

// kept.cpp: constructs that are kept as text
void append_source(std::string& text, const Token& token);
/// Everything to `end kind`, which is consumed but not part of the text.
std::string keep_until_end(Parse& parse, std::string_view kind);
/// One group in brackets of any kind that begins here, brackets included.
void keep_brackets(Parse& parse, std::string& text);
/// Tokens up to one of `words` or `end`; groups in brackets are taken whole.
std::string keep_until_word(Parse& parse, std::span<const std::string_view> words);
/// `gui`, `registry`, `colorprofile`, `spectrum` elements.
void read_uninterpreted_element(Parse& parse, std::string_view kind, SourceLocation at);
scene::UninterpretedStatement read_gui(Parse& parse, SourceLocation at);

// commands.cpp
/// Reads one statement of the top level; true after `render`.
bool read_top_level(Parse& parse);
void finish_reading(Parse& parse);

// resolve.cpp
/// Reports every name that nothing defines; `render` is the command that asks.
void report_unresolved(Parse& parse, const scene::RenderCommand& render);

}  // namespace oriel::mi
