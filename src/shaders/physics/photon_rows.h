// SPDX-License-Identifier: Apache-2.0
// Tables of shaders that are accepted in the slot photon and evaluated nowhere.
#pragma once

#include <array>

#include "runtime/param.h"

namespace oriel {

/// The same rows, all ignored for that reason.
template <std::size_t N>
constexpr std::array<ParamSpec, N> ignored_rows(const ParamSpec (&rows)[N], const char* reason) {
  std::array<ParamSpec, N> all{};
  for (std::size_t i = 0; i < N; ++i) {
    all[i] = rows[i];
    all[i].doc = reason;
    all[i].support = Support::Ignored;
  }
  return all;
}

}  // namespace oriel
