// SPDX-License-Identifier: Apache-2.0
#include "sdk/user_spec.h"

#include <fmt/format.h>

#include <algorithm>

#include "sdk/call.h"
#include "sdk/host.h"

namespace oriel::sdk {
namespace {

constexpr struct {
  const char* word;
  unsigned bits;
} kApplyWords[] = {
    {"material", kApplyMaterial},       {"texture", kApplyTexture}, {"light", kApplyLight},
    {"environment", kApplyEnvironment}, {"lens", kApplyLens},       {"output", kApplyOutput},
    {"shadow", kApplyShadow},           {"photon", kApplyPhoton},   {"volume", kApplyVolume},
    {"emitter", kApplyEmitter},         {"state", kApplyState}};

unsigned apply_of(const scene::ShaderDeclaration& declaration) {
  unsigned bits = 0;
  for (const scene::Statement& s : declaration.requirements) {
    if (s.keyword != "apply") continue;
    for (const scene::Value& word : s.values)
      for (const auto& known : kApplyWords)
        if (word.text == known.word) bits |= known.bits;
  }
  return bits;
}

int version_of(const scene::ShaderDeclaration& declaration) {
  int version = 0;
  for (const scene::Statement& s : declaration.requirements)
    if (s.keyword == "version")
      version = s.values.empty() || s.values[0].numbers.empty()
                    ? 0
                    : static_cast<int>(s.values[0].numbers[0]);
  return version;
}

std::size_t aligned(std::size_t offset, std::size_t alignment) {
  return (offset + alignment - 1) / alignment * alignment;
}

void set_default(ParamSpec& row, const scene::Value& value, std::deque<std::string>& texts) {
  if (value.kind == scene::Value::Kind::Text) {
    texts.push_back(value.text);
    row.text = texts.back().c_str();
  }
  if (value.kind == scene::Value::Kind::Boolean) row.fallback[0] = value.boolean ? 1 : 0;
  for (std::size_t i = 0; i < value.numbers.size() && i < row.fallback.size(); ++i)
    row.fallback[i] = static_cast<float>(value.numbers[i]);
}

/// Computes the layout of members in C and in the renderer; members of nested structs become
/// separate members, "outer.inner".
struct Layout {
  UserSpec& spec;
  std::vector<ParamSpec>& rows;
  std::vector<CMember>& members;
  Diagnostics& diagnostics;
  bool in_array = false;
  std::size_t c_offset = 0, offset = 0;

  void add(const scene::ParamDecl& param, const std::string& prefix) {
    const std::string name = prefix + param.name;
    if (param.type == ParamType::Struct) {
      for (const scene::ParamDecl& member : param.members) add(member, name + ".");
      return;
    }
    const bool array = param.type == ParamType::Array;
    if (array && in_array) {
      diagnostics.warning("OR-SDK-010", param.where,
                          fmt::format("\"{}\" of \"{}\" is an array within elements of an array, "
                                      "which is passed to the shader empty",
                                      name, spec.own_name));
      c_offset += 8 + c_size_of_element(param);
      return;
    }
    spec.texts.push_back(name);
    offset = aligned(offset, alignof(void*));
    ParamSpec row{.name = spec.texts.back().c_str(),
                  .type = param.type,
                  .element = param.type,
                  .offset = offset,
                  .declared_default = param.default_value.has_value()};
    CMember member{param.type, c_offset, offset};
    if (param.default_value) set_default(row, *param.default_value, spec.texts);
    if (array) add_elements(param, row, member);
    rows.push_back(row);
    members.push_back(std::move(member));
    c_offset += array ? 8 + members.back().c_stride : c_size(param.type);
    offset += size_of(param.type);
  }

  void add_elements(const scene::ParamDecl& array, ParamSpec& row, CMember& member) {
    scene::ParamDecl element;
    if (!array.members.empty()) element = array.members[0];
    element.name.clear();
    row.element = element.type;
    std::vector<ParamSpec>& element_rows = spec.element_rows.emplace_back();
    Layout inner{spec, element_rows, member.members, diagnostics, true};
    if (element.type == ParamType::Struct)
      for (const scene::ParamDecl& m : element.members) inner.add(m, "");
    else
      inner.add(element, "");
    member.c_stride = inner.c_offset;
    if (element.type == ParamType::Struct) {
      row.members = element_rows;
      row.stride = member.stride = aligned(inner.offset, alignof(void*));
    } else {
      member.stride = size_of(element.type);
    }
  }

  static std::size_t c_size_of_element(const scene::ParamDecl& array) {
    std::size_t bytes = 0;
    if (!array.members.empty() && array.members[0].type == ParamType::Struct)
      for (const scene::ParamDecl& m : array.members[0].members) bytes += c_size(m.type);
    else if (!array.members.empty())
      bytes = c_size(array.members[0].type);
    return bytes;
  }
};

/// Parameters in the syntax of a declaration.
std::string parameter_text(const std::vector<scene::ParamDecl>& parameters) {
  std::string text;
  for (const scene::ParamDecl& p : parameters) {
    if (!text.empty()) text += ", ";
    text += scene::type_name(p.type);
    if (p.type == ParamType::Array) {
      text += ' ' + parameter_text(p.members);
      continue;
    }
    text += fmt::format(" \"{}\"", p.name);
    if (p.type == ParamType::Struct) text += " { " + parameter_text(p.members) + " }";
  }
  return text;
}

}  // namespace

std::size_t begin_of_array(const CMember& array, std::size_t end) {
  const std::size_t first = array.c_offset + 8, size = array.c_stride;
  return first + (std::max(end, first) - first + size - 1) / size * size;
}

std::size_t c_size(ParamType type) {
  switch (type) {
    case ParamType::Color:
      return sizeof(miColor);
    case ParamType::Vector:
      return sizeof(miVector);
    case ParamType::Transform:
      return sizeof(miMatrix);
    case ParamType::Spectrum:
      return sizeof(miSpectrum_para);
    case ParamType::Struct:
      return 0;
    default:
      return 4;
  }
}

miParam_type c_type(ParamType type) {
  switch (type) {
    case ParamType::Boolean:
      return miTYPE_BOOLEAN;
    case ParamType::Integer:
      return miTYPE_INTEGER;
    case ParamType::Scalar:
      return miTYPE_SCALAR;
    case ParamType::String:
      return miTYPE_STRING;
    case ParamType::Color:
      return miTYPE_COLOR;
    case ParamType::Vector:
      return miTYPE_VECTOR;
    case ParamType::Transform:
      return miTYPE_TRANSFORM;
    case ParamType::Shader:
      return miTYPE_SHADER;
    case ParamType::ScalarTexture:
      return miTYPE_SCALAR_TEX;
    case ParamType::ColorTexture:
      return miTYPE_COLOR_TEX;
    case ParamType::VectorTexture:
      return miTYPE_VECTOR_TEX;
    case ParamType::Light:
      return miTYPE_LIGHT;
    case ParamType::Struct:
      return miTYPE_STRUCT;
    case ParamType::Array:
      return miTYPE_ARRAY;
    case ParamType::Material:
      return miTYPE_MATERIAL;
    case ParamType::Geometry:
      return miTYPE_GEOMETRY;
    case ParamType::LightProfile:
      return miTYPE_LIGHTPROFILE;
    case ParamType::Data:
      return miTYPE_DATA;
    case ParamType::Spectrum:
      return miTYPE_SPECTRUM;
  }
  return miTYPE_INVALID;
}

UserSpec::UserSpec(const scene::ShaderDeclaration& declaration, Host& owner,
                   Diagnostics& diagnostics)
    : host(&owner), own_name(declaration.name) {
  name = own_name.c_str();
  library = "user";
  doc = "A user's shader.";
  version = version_of(declaration);
  apply = apply_of(declaration);

  Layout in{*this, rows, members, diagnostics};
  for (const scene::ParamDecl& param : declaration.parameters) in.add(param, "");
  params = rows;
  params_size = aligned(in.offset, alignof(std::max_align_t));
  c_params_size = in.c_offset;
  parameter_text = sdk::parameter_text(declaration.parameters);

  Layout out{*this, result_rows, result_members, diagnostics};
  for (const scene::ParamDecl& param : declaration.results) out.add(param, "");
  if (result_rows.empty()) {
    // The default result type is color.
    scene::ParamDecl color;
    color.type = ParamType::Color;
    out.add(color, "");
  }
  c_result_size = std::max(out.c_offset, sizeof(miColor));
  const bool single = result_rows.size() == 1 && *result_rows[0].name == 0;
  result = single ? result_rows[0].type : ParamType::Struct;
  if (!single) results = result_rows;
  result_size = std::max(aligned(out.offset, alignof(std::max_align_t)), sizeof(Rgba));
  set_roles(*this);
}

}  // namespace oriel::sdk
