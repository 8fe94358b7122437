// SPDX-License-Identifier: Apache-2.0
#include "output/output_names.h"

#include <algorithm>
#include <cctype>

#include "runtime/material_outputs.h"

namespace oriel {

const std::vector<std::string>& material_output_names() {
  static const std::vector<std::string> names(kMaterialOutputNames.begin(),
                                              kMaterialOutputNames.end());
  return names;
}

int material_output_index(std::string_view name) {
  const auto& names = material_output_names();
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

int output_of_frame_buffer(std::string_view buffer) {
  // Removing characters from the left finds the longest name first.
  for (std::size_t cut = 0; cut < buffer.size(); ++cut) {
    if (cut > 0 && std::isalpha(static_cast<unsigned char>(buffer[cut - 1]))) continue;
    const int index = material_output_index(buffer.substr(cut));
    if (index >= 0) return index;
  }
  return -1;
}

}  // namespace oriel
