// SPDX-License-Identifier: Apache-2.0
// Whether parameters of the running shader differ from their declared defaults.
#include "oriel/sdk/shader/parameter_set.h"

#include <algorithm>
#include <cstring>

#include "oriel/sdk/shader/vector.h"
#include "sdk/context.h"
#include "sdk/host.h"
#include "sdk/user_spec.h"

namespace oriel::sdk {
namespace {

std::size_t offset_in(const UserInstance& shader, const void* parameter) {
  return static_cast<std::size_t>(static_cast<const std::byte*>(parameter) -
                                  static_cast<const std::byte*>(shader.parameters));
}

/// Whether the members of a colour or shorter value differ from their declared defaults.
bool numbers_differ(const ParamSpec& row, const float* values, std::size_t count) {
  std::array<float, 4> usual = row.fallback;
  // The default alpha of a declared colour is 1.
  if (count == 4 && row.declared_default && usual[3] == 0) usual[3] = 1;
  return !std::equal(values, values + count, usual.begin());
}

bool matrix_differs(const miScalar* m) {
  miMatrix identity;
  mi_matrix_ident(identity);
  return !std::equal(identity, identity + 16, m);
}

bool value_differs(const Host& host, const ParamSpec& row, const void* value) {
  const auto read = [&]<class T>(T number) {
    std::memcpy(&number, value, sizeof number);
    return number;
  };
  switch (row.type) {
    case ParamType::Boolean:
      return (read(miBoolean{}) != 0) != (row.fallback[0] != 0);
    case ParamType::Integer:
      return read(miInteger{}) != static_cast<miInteger>(row.fallback[0]);
    case ParamType::Scalar:
      return numbers_differ(row, static_cast<const float*>(value), 1);
    case ParamType::Vector:
      return numbers_differ(row, static_cast<const float*>(value), 3);
    case ParamType::Color:
      return numbers_differ(row, static_cast<const float*>(value), 4);
    case ParamType::Transform:
      return matrix_differs(static_cast<const miScalar*>(value));
    case ParamType::String:
      return host.text(read(miTag{})) != std::string_view(row.text ? row.text : "");
    case ParamType::Spectrum:
      return false;  // its values are not passed to shaders
    default:
      return read(miTag{}) != miNULLTAG;
  }
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel::sdk;

extern "C" {

miBoolean oriel_parameter_is_connected(const miState* state, const void* parameter) {
  const UserInstance* shader = context(state).shader;
  if (!shader || !parameter) return miFALSE;
  const std::size_t offset = offset_in(*shader, parameter);
  const auto& all = shader->connections;
  return std::any_of(all.begin(), all.end(),
                     [&](const CConnection& c) { return c.c_offset == offset; })
             ? miTRUE
             : miFALSE;
}

miBoolean oriel_parameter_is_set(const miState* state, const void* parameter) {
  const UserInstance* shader = context(state).shader;
  if (!shader || !parameter) return miFALSE;
  if (oriel_parameter_is_connected(state, parameter)) return miTRUE;
  const std::size_t offset = offset_in(*shader, parameter);
  const UserSpec& spec = *shader->spec;
  for (std::size_t i = 0; i < spec.members.size() && i < spec.rows.size(); ++i) {
    const CMember& member = spec.members[i];
    if (member.type == oriel::ParamType::Array) {
      // i_name, n_name and name are consecutive.
      if (offset < member.c_offset || offset > member.c_offset + 8) continue;
      int count = 0;
      const auto* values = static_cast<const std::byte*>(shader->parameters);
      std::memcpy(&count, values + member.c_offset + 4, sizeof count);
      return count > 0 ? miTRUE : miFALSE;
    }
    if (member.c_offset == offset)
      return value_differs(*spec.host, spec.rows[i], parameter) ? miTRUE : miFALSE;
  }
  return miFALSE;
}

}  // extern "C"
