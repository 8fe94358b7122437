// SPDX-License-Identifier: Apache-2.0
// Offset of a parameter in the block of its call.
#include <string_view>

#include "oriel/sdk/shader/lookup.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "sdk/user_spec.h"

namespace oriel::sdk {
namespace {

struct Found {
  ParamType type;
  bool is_array;
  std::size_t offset;
};

std::optional<Found> find(const std::vector<ParamSpec>& rows, const std::vector<CMember>& members,
                          std::string_view name) {
  for (std::size_t i = 0; i < rows.size() && i < members.size(); ++i) {
    const std::string_view row = rows[i].name;
    const bool is_array = rows[i].type == ParamType::Array;
    if (row == name)
      return Found{is_array ? rows[i].element : rows[i].type, is_array, members[i].c_offset};
    // Members of a struct have its name as a prefix; the struct starts at the first one.
    if (row.size() > name.size() && row.starts_with(name) && row[name.size()] == '.')
      return Found{ParamType::Struct, false, members[i].c_offset};
  }
  return std::nullopt;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel::sdk;

extern "C" miBoolean mi_api_parameter_lookup(miParam_type* type, miBoolean* is_array, int* offs,
                                             miTag decl, miBoolean out, const char* name) {
  const Host* host = current_host();
  if (!host || decl == miNULLTAG) return miFALSE;
  const UserSpec* spec = host->declaration(decl);
  if (!spec) spec = host->declaration_named(host->name_of(decl));
  if (!spec) return miFALSE;
  const std::string_view wanted = name ? name : "";
  const auto found = out ? find(spec->result_rows, spec->result_members, wanted)
                         : find(spec->rows, spec->members, wanted);
  if (!found) return miFALSE;
  if (type) *type = c_type(found->type);
  if (is_array) *is_array = found->is_array ? miTRUE : miFALSE;
  if (offs) *offs = static_cast<int>(found->offset);
  return miTRUE;
}
