// SPDX-License-Identifier: Apache-2.0
// The number that users give an element.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/value.h"

namespace oriel::scene {

/// `tag N` among an element's statements, within 32 bits; 0: none is written.
/// Checked: Mattes.* in output/mattes_test.cpp, UserQueries.* in tests/user_shaders
std::uint32_t label_of(const std::vector<Statement>& statements);

}  // namespace oriel::scene
