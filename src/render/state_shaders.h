// SPDX-License-Identifier: Apache-2.0
// The options' state shaders around each sample of the picture.
#pragma once

#include <span>

#include "runtime/world.h"
#include "transport/path/path.h"

namespace oriel {

/// Calls the world's state shaders at a moment of a sample; they may change its colour and the user
/// frame buffers it leaves.
///
/// Model:   every sample is a state of its own: its init and exit stand right around the sample's.
/// Source:  the public manual's page on state shaders.
/// Checked: UserState.* in tests/user_shaders/state_test.cpp
void call_state_shaders(const World& world, Vec2 raster, EyeSample::Moment moment,
                        PathResult& sample, std::span<Rgba> buffers);

}  // namespace oriel
