// SPDX-License-Identifier: Apache-2.0
// The statements of an options block.
#pragma once

#include "scene/render_options.h"
#include "scene/statement_table.h"

namespace oriel::scene {

/// All rows; string options are last.
const ElementTable<RenderOptions>& option_table();

}  // namespace oriel::scene
