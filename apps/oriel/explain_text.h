// SPDX-License-Identifier: Apache-2.0
// The explanation of a pixel as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "analysis/explain.h"
#include "render/indirect_plan.h"
#include "render/unit_luminance.h"

namespace oriel::app {

/// An explanation with the data that its text refers to.
struct ExplainReport {
  const Explanation& facts;
  const World& world;
  IndirectPlan plan;
  UnitLuminance unit;
};

/// Text of the report. Shares are fractions of the luminance of the pixel, the largest first;
/// shares below 1 % are not listed.
/// Checked: tests/cli/explain_test.cpp
std::string explain_text(const ExplainReport& report);

nlohmann::json explain_json(const ExplainReport& report);

// Names used by both.
std::string instance_name(const World& world, int instance);
std::string light_name(const World& world, int light);
const char* lobe_name(LobeKind kind);
const char* segment_name(PathSegment segment);
/// Name of the material output of an AOV; "other" if there is none.
const char* output_name(Aov aov);
/// The element and shader of a material: "wood (mia_material_x)".
std::string material_name(const Material* material);

}  // namespace oriel::app
