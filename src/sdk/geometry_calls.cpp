// SPDX-License-Identifier: Apache-2.0
// Shader calls made by geometry shaders.
#include "sdk/current.h"
#include "sdk/geometry_work.h"
#include "sdk/host.h"
#include "sdk/made_parts.h"

namespace oriel::sdk {
namespace {

CallWork* open_call() {
  GeometryWork* work = GeometryWork::current();
  return work && !work->elements.calls.empty() ? &work->elements.calls.back() : nullptr;
}

/// The declared parameter that the next values belong to; null if unknown.
const ParamSpec* declared_parameter(const CallWork& call) {
  const Host* host = current_host();
  const ShaderSpec* spec = host ? host->registry().find(call.declared()) : nullptr;
  if (!spec) return nullptr;
  const std::string name = call.parameter();
  for (const ParamSpec& row : spec->params)
    if (name == row.name) return &row;
  return nullptr;
}

std::size_t element_width(const CallWork& call) {
  const ParamSpec* row = declared_parameter(call);
  return row && row->type == ParamType::Array ? number_count(row->element) : 1;
}

/// A string, or the name of an element.
std::string text_of(const CallWork& call, const char* value) {
  const ParamSpec* row = declared_parameter(call);
  if (row && (row->type == ParamType::String || row->element == ParamType::String)) return value;
  return GeometryWork::current()->own_name(value);
}

bool make_value(const CallWork& call, miParam_type type, void* from, scene::Value& value) {
  const auto scalars = [&](std::size_t count) {
    value = made::numbers({static_cast<const miScalar*>(from), count});
  };
  switch (type) {
    case miTYPE_BOOLEAN:
      value = made::boolean(*static_cast<miBoolean*>(from) != miFALSE);
      return true;
    case miTYPE_INTEGER:
      value = made::integer(*static_cast<miInteger*>(from));
      return true;
    case miTYPE_SCALAR:
      scalars(1);
      return true;
    case miTYPE_COLOR:
      scalars(4);
      return true;
    case miTYPE_VECTOR:
      scalars(3);
      return true;
    case miTYPE_TRANSFORM:
      scalars(16);
      return true;
    case miTYPE_STRING:
      value = made::text(text_of(call, static_cast<const char*>(from)));
      return true;
    case miTYPE_STRUCT:
    case miTYPE_ARRAY:
    case miTYPE_SPECTRUM:
    case miTYPE_INVALID:
      return false;
    default:
      value = made::text(made::name_of(*static_cast<miTag*>(from)));
      return !value.text.empty();
  }
}

miTag add_call(const char* name, scene::ShaderList functions) {
  GeometryWork* work = GeometryWork::current();
  scene::ShaderElement element;
  element.name = work->name_for(name);
  element.functions = std::move(functions);
  return work->add(std::move(element));
}

scene::ShaderUse reference_to(const std::string& name) {
  scene::ShaderUse use;
  use.reference = name;
  return use;
}

/// Sets the connection of the parameter.
miBoolean connect(scene::Value::Kind kind, std::string name) {
  CallWork* call = open_call();
  if (!call || name.empty()) return miFALSE;
  scene::Value value;
  value.kind = kind;
  value.text = std::move(name);
  call->value(std::move(value));
  return miTRUE;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_api_function_call(const char* declaration) {
  GeometryWork* work = GeometryWork::current();
  std::string own = taken(declaration);
  if (!work) return miFALSE;
  work->elements.calls.emplace_back(std::move(own));
  return miTRUE;
}

miBoolean mi_api_parameter_name(const char* name) {
  std::string own = taken(name);
  CallWork* call = open_call();
  if (!call) return miFALSE;
  call->name(std::move(own));
  return miTRUE;
}

miBoolean mi_api_parameter_value(miParam_type type, void* value, ...) {
  CallWork* call = open_call();
  scene::Value made;
  if (!call || !value || !make_value(*call, type, value, made)) return miFALSE;
  call->value(std::move(made));
  return miTRUE;
}

miBoolean mi_api_parameter_push(miBoolean is_array) {
  CallWork* call = open_call();
  if (!call) return miFALSE;
  call->push(is_array != miFALSE);
  return miTRUE;
}

miBoolean mi_api_parameter_pop(void) {
  CallWork* call = open_call();
  return call && call->pop(element_width(*call)) ? miTRUE : miFALSE;
}

miBoolean mi_api_new_array_element(void) {
  CallWork* call = open_call();
  return call && call->new_element() ? miTRUE : miFALSE;
}

miBoolean mi_api_parameter_shader(const char* name) {
  const std::string own = taken(name);
  const GeometryWork* work = GeometryWork::current();
  return connect(scene::Value::Kind::Connection, work ? work->own_name(own) : own);
}

miBoolean mi_api_parameter_interface(const char* name) {
  return connect(scene::Value::Kind::Interface, taken(name));
}

miTag mi_api_function_call_end(miTag next) {
  GeometryWork* work = GeometryWork::current();
  if (!work || work->elements.calls.empty()) return miNULLTAG;
  scene::ShaderList functions = {work->elements.calls.back().finish()};
  work->elements.calls.pop_back();
  if (const std::string behind = made::name_of(next); !behind.empty())
    functions.push_back(reference_to(behind));
  return add_call(nullptr, std::move(functions));
}

miTag mi_api_function_append(miTag list, miTag next) {
  GeometryWork* work = GeometryWork::current();
  if (!work || list == next) return list;
  const auto* first = work->scene->get<scene::ShaderElement>(made::name_of(list));
  const auto* second = work->scene->get<scene::ShaderElement>(made::name_of(next));
  if (!first || !second) return first ? list : second ? next : miNULLTAG;
  scene::ShaderElement longer = *first;
  longer.functions.push_back(reference_to(second->name));
  return work->add(std::move(longer));
}

miTag mi_api_function_assign(const char* name) {
  const std::string given = taken(name);
  GeometryWork* work = GeometryWork::current();
  if (!work) return miNULLTAG;
  const std::string own = work->own_name(given);
  return work->scene->get<scene::ShaderElement>(own) ? GeometryWork::tag_of(own) : miNULLTAG;
}

miBoolean mi_api_shader_add(const char* name, miTag call) {
  GeometryWork* work = GeometryWork::current();
  scene::ShaderList list;
  if (work) list = made::shader_list(*work->scene, call);
  if (list.empty() || !name) {
    taken(name);
    return miFALSE;
  }
  return add_call(name, std::move(list)) != miNULLTAG ? miTRUE : miFALSE;
}

}  // extern "C"
