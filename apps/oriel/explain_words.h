// SPDX-License-Identifier: Apache-2.0
// The phrases of an explanation.
#pragma once

#include <string>
#include <vector>

#include "explain_text.h"

namespace oriel::app {

std::string text_of(const Rgb& colour);
std::string text_of(const Vec3& place);

/// The hue as ", reddish"; empty for greys.
std::string tint(const Rgb& colour);

std::string lobe_words(const ExplainedLobe& lobe);

/// "direct light of key_light". Inputs: environment: whether the source is the environment.
std::string light_words(Aov part, const std::string& source, bool environment);

/// "; 38 % shadowed, mostly by wall"; empty if nothing is shadowed.
std::string shadow_words(const ExplainReport& report, const ExplainedSurface& surface,
                         const std::string& source);

/// Number of gather points and photons of the indirect light; empty for path tracing.
std::string map_words(const ExplainedSurface& surface);

/// "reflection of wall (material plaster), 3.2 away".
std::string seen_words(const World& world, const ExplainedSurface& surface);

/// Sampled lights without contribution, each with the reason.
std::vector<std::string> lost_lights(const ExplainReport& report, const ExplainedSurface& surface);

/// The constant parameters of a shader, "film_iso 100, f_number 8".
std::string constants_of(const ShaderNode& node);

/// Variance of the luminance, assuming fully correlated channels.
double noise_of_mean(const Rgb& variance);

/// Cause of the noise of an AOV, and how to reduce it.
std::string noise_advice(const ExplainReport& report, Aov part);

}  // namespace oriel::app
