// SPDX-License-Identifier: Apache-2.0
// What arguments of a render mean.
#pragma once

#include "render_frames.h"

namespace oriel::app {

/// Errors:  UsageError, UserError that name the argument.
RenderPlan render_plan(const RenderArguments& arguments);

}  // namespace oriel::app
