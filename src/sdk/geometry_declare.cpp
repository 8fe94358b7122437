// SPDX-License-Identifier: Apache-2.0
// Shader declarations made by geometry shaders.
#include <algorithm>

#include "sdk/current.h"
#include "sdk/geometry_work.h"
#include "sdk/host.h"
#include "sdk/made_parts.h"
#include "sdk/once.h"

namespace oriel::sdk {
namespace {

ParamType param_type_of(miParam_type type) {
  constexpr ParamType kAll[] = {
      ParamType::Boolean,      ParamType::Integer,       ParamType::Scalar,
      ParamType::String,       ParamType::Color,         ParamType::Vector,
      ParamType::Transform,    ParamType::Shader,        ParamType::ScalarTexture,
      ParamType::ColorTexture, ParamType::VectorTexture, ParamType::Light,
      ParamType::Struct,       ParamType::Array,         ParamType::Material,
      ParamType::Geometry,     ParamType::LightProfile,  ParamType::Data,
      ParamType::Spectrum};
  const auto* found = std::find_if(std::begin(kAll), std::end(kAll),
                                   [&](ParamType own) { return c_type(own) == type; });
  return found == std::end(kAll) ? ParamType::ColorTexture : *found;  // miTYPE_TEX: any texture
}

/// A parameter with all nested ones.
scene::ParamDecl declared_with_children(const miParameter& parameter, int depth = 0) {
  constexpr int kMaxDepth = 64;
  scene::ParamDecl whole = parameter.declared;
  if (depth < kMaxDepth)
    for (const miParameter* child : parameter.children)
      whole.members.push_back(declared_with_children(*child, depth + 1));
  return whole;
}

std::vector<scene::ParamDecl> declared_list(const miParameter* any) {
  std::vector<scene::ParamDecl> list;
  if (any)
    for (const miParameter* p : *any->list) list.push_back(declared_with_children(*p));
  return list;
}

bool same_types(const std::vector<scene::ParamDecl>& a, const std::vector<scene::ParamDecl>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const scene::ParamDecl& x, const scene::ParamDecl& y) {
                      return x.type == y.type && x.name == y.name &&
                             same_types(x.members, y.members);
                    });
}

/// Whether the scene has a shader of that name, which is then kept.
bool exists(const scene::Scene& scene, const scene::ShaderDeclaration& made) {
  if (const auto* known = scene.find_declaration(made.name)) {
    if (!same_types(known->parameters, made.parameters))
      warn_once("OR-SDK-040",
                "a geometry shader declares \"" + made.name +
                    "\" with other parameters than the scene does; those of the scene are used");
    return true;
  }
  const Host* host = current_host();
  return scene.find_phenomenon(made.name) || (host && host->registry().find(made.name));
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miParameter* mi_api_parameter_decl(miParam_type type, const char* name, void*) {
  GeometryWork* work = GeometryWork::current();
  std::string own = taken(name);
  if (!work) return nullptr;
  miParameter& made = work->elements.declaration.parameters.emplace_back();
  made.declared.type = param_type_of(type);
  made.declared.name = std::move(own);
  made.list = std::make_shared<std::vector<miParameter*>>(1, &made);
  return &made;
}

miParameter* mi_api_parameter_append(miParameter* list, miParameter* parm) {
  if (!list || !parm) return parm ? parm : list;
  if (list->list == parm->list) return parm;
  const auto joined = list->list;
  const auto appended = parm->list;
  for (miParameter* p : *appended) {
    joined->push_back(p);
    p->list = joined;
  }
  return parm;
}

miBoolean mi_api_parameter_child(miParameter* parm, miParameter* child) {
  if (!parm || !child) return miFALSE;
  const ParamType type = parm->declared.type;
  if (type != ParamType::Struct && type != ParamType::Array) return miFALSE;
  parm->children = *child->list;
  if (type == ParamType::Array) parm->children.resize(1);
  return miTRUE;
}

miBoolean mi_api_parameter_default(miParam_type type, void* value) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !value || work->elements.declaration.parameters.empty()) return miFALSE;
  std::optional<scene::Value>& current =
      work->elements.declaration.parameters.back().declared.default_value;
  scene::Value next;
  switch (type) {
    case miTYPE_BOOLEAN:
      next = made::boolean(*static_cast<miBoolean*>(value) != miFALSE);
      break;
    case miTYPE_INTEGER:
      next = made::integer(*static_cast<miInteger*>(value));
      break;
    case miTYPE_SCALAR:
      next = made::numbers({static_cast<miScalar*>(value), 1});
      break;
    default:
      return miFALSE;
  }
  if (type == miTYPE_SCALAR && current && current->kind == scene::Value::Kind::Numbers)
    current->numbers.push_back(next.numbers[0]);
  else
    current = std::move(next);
  return miTRUE;
}

miFunction_decl* mi_api_funcdecl_begin(miParameter* result, const char* name, miParameter* list) {
  GeometryWork* work = GeometryWork::current();
  scene::ShaderDeclaration made;
  made.name = taken(name);
  if (!work || made.name.empty()) return nullptr;
  made.results = declared_list(result);
  made.parameters = declared_list(list);
  DeclarationWork& declaration = work->elements.declaration;
  declaration.data = {};
  declaration.declaration.reset();
  if (!exists(*work->scene, made)) declaration.declaration = std::move(made);
  return &declaration.data;
}

void mi_api_funcdecl_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !work->elements.declaration.declaration) return;
  scene::ShaderDeclaration made = std::move(*work->elements.declaration.declaration);
  work->elements.declaration.declaration.reset();
  if (const int version = work->elements.declaration.data.version; version != 0)
    made::say(made.requirements, "version", made::integer(version));
  if (Host* host = current_host()) host->declare(made);
  work->scene->declarations.push_back(std::move(made));
}

}  // extern "C"
