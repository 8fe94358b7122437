// SPDX-License-Identifier: Apache-2.0
// The guide of a picture's paths.
#pragma once

#include "render/integrator.h"
#include "transport/direction_guide.h"
#include "transport/gather/gather_bounces.h"
#include "transport/path/path.h"

namespace oriel {

/// A guide for the diffuse bounces of a picture's paths, from the light at the points of coarse
/// records. Empty if the picture has so few paths that a guide costs more than it saves, if pilot
/// paths show no gain, or if cancelled.
///
/// Inputs:  settings: of the paths, without guide; coarse: records of the scene, if they exist;
///          without points they are computed.
/// Checked: Guiding.*, GuidedPictures.* in tests/cross_method
DirectionGuide learn_directions(const World& world, const IntegratorPreparation& p,
                                const PathSettings& settings, const Bounces& coarse);

}  // namespace oriel
