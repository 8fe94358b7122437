// SPDX-License-Identifier: Apache-2.0
// An explanation of a pixel in words, and as data for machines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "analysis/explain.h"
#include "render/indirect_plan.h"
#include "render/unit_luminance.h"

namespace oriel::app {

/// An explanation and what its words need beside it.
struct ExplainReport {
  const Explanation& facts;
  const World& world;
  IndirectPlan plan;
  UnitLuminance unit;
};

/// Paragraphs, lines of at most 100 characters where names allow. Shares are of the pixel's
/// luminance, sorted; those below a hundredth are left out.
/// Checked: tests/cli/explain_test.cpp
std::string explain_text(const ExplainReport& report);

nlohmann::json explain_json(const ExplainReport& report);

// Words that both use.
std::string instance_name(const World& world, int instance);
std::string lamp_name(const World& world, int light);
const char* lobe_name(LobeKind kind);
const char* segment_name(PathSegment way);
/// The output of materials that a component is, "other" for what belongs to none.
const char* output_name(Aov component);
/// The element and shader of a material: "wood (mia_material_x)".
std::string material_name(const Material* material);

}  // namespace oriel::app
