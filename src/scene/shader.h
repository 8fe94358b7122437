// SPDX-License-Identifier: Apache-2.0
// Shaders in a scene: calls, named shaders, declarations, phenomena.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/value.h"

namespace oriel::scene {

/// One link of a shader list: a call `"declared" ( arguments )` or a reference `= "named"`.
struct ShaderUse {
  std::string reference;  ///< name of a shader element; empty for a call
  std::string type;       ///< declared name of the shader or phenomenon that is called
  std::vector<Argument> arguments;
  bool interface = false;  ///< = interface "p": reference names a parameter of the phenomenon
  SourceLocation where;
  bool operator==(const ShaderUse&) const = default;
};

/// Shaders run in order; each one receives the result of the previous one.
using ShaderList = std::vector<ShaderUse>;

/// shader "name" function...
struct ShaderElement {
  std::string name;
  ShaderList functions;
  SourceLocation where;
  bool operator==(const ShaderElement&) const = default;
};

enum class ParamType : std::uint8_t {
  Boolean,
  Integer,
  Scalar,
  String,
  Color,
  Vector,
  Transform,
  Light,
  Material,
  Geometry,
  LightProfile,
  Spectrum,
  ColorTexture,
  ScalarTexture,
  VectorTexture,
  Shader,
  Data,
  Struct,
  Array
};

/// The keyword(s) of a type in `.mi`: "scalar", "color texture", ...
std::string_view type_name(ParamType type);
/// Maximum number of numbers in a value of the type; 1 for types without numbers.
std::size_t number_count(ParamType type);

/// One declared parameter or result member.
struct ParamDecl {
  ParamType type = ParamType::Scalar;
  std::string name;
  std::string type_argument;       ///< Data: name of its declaration; Shader: empty
  std::vector<ParamDecl> members;  ///< Struct: the members; Array: exactly one, the element
  std::optional<Value> default_value;
  SourceLocation where;
  bool operator==(const ParamDecl&) const = default;
};

/// declare [shader] result "name" ( parameters ) requirements end declare
struct ShaderDeclaration {
  std::string name;
  std::vector<ParamDecl> results;  ///< one unnamed result, or the members of a struct
  std::vector<ParamDecl> parameters;
  std::vector<Statement> requirements;  ///< version, apply, trace, shadow, ... as written
  std::vector<UninterpretedStatement> uninterpreted;  ///< gui and hardware blocks
  bool old_form = false;  ///< without the word shader: ends at the parenthesis
  SourceLocation where;
  bool operator==(const ShaderDeclaration&) const = default;
};

/// declare data "name" ( parameters ) ... end declare
struct DataDeclaration {
  std::string name;
  std::vector<ParamDecl> parameters;
  std::vector<Statement> requirements;
  std::vector<UninterpretedStatement> uninterpreted;  ///< gui blocks
  SourceLocation where;
  bool operator==(const DataDeclaration&) const = default;
};

}  // namespace oriel::scene
