// SPDX-License-Identifier: Apache-2.0
// The phrases of an explanation.
#pragma once

#include <string>
#include <vector>

#include "explain_text.h"

namespace oriel::app {

std::string text_of(const Rgb& colour);
std::string text_of(const Vec3& place);

/// ", reddish" where a colour is one; empty for greys.
std::string tint(const Rgb& colour);

std::string lobe_words(const ExplainedLobe& lobe);

/// "direct light of lamp". Inputs: environment: the source is that.
std::string light_words(Aov part, const std::string& source, bool environment);

/// "; 38 % of what it sends there is shadowed, most by wall"; empty where nothing is.
std::string shadow_words(const ExplainReport& report, const ExplainedSurface& surface,
                         const std::string& source);

/// By what indirect light is known where maps speak for it; empty for paths.
std::string map_words(const ExplainedSurface& surface);

/// "reflection of wall (material plaster), 3.2 away".
std::string seen_words(const World& world, const ExplainedSurface& surface);

/// Lights that were asked and bring nothing, each with the reason.
std::vector<std::string> lost_lights(const ExplainReport& report, const ExplainedSurface& surface);

/// Numbers that a shader's constants are, "film_iso 100, f_number 8".
std::string constants_of(const ShaderNode& node);

/// Variance of the luminance, channels taken as alike.
double noise_of_mean(const Rgb& variance);

/// What the noise of a part comes from and what helps.
std::string noise_advice(const ExplainReport& report, Aov part);

}  // namespace oriel::app
