// SPDX-License-Identifier: Apache-2.0
#include "render/indirect_plan.h"

namespace oriel {

const char* IndirectPlan::name() const {
  if (gather) return global ? "fg+photons" : "fg";
  if (global) return "photons";
  if (bounces) return "path+cache";
  return indirect ? "path" : "none";
}

IndirectPlan plan_indirect(const scene::RenderOptions& options) {
  using Method = scene::IndirectMethod;
  const Method m = options.indirect;
  IndirectPlan plan;
  plan.by_name = m != Method::Scene;
  if (m == Method::Path || m == Method::PathCache) {
    plan.indirect = true;
    plan.bounces = m == Method::PathCache;
    plan.sharp_caustics = options.caustic.on;
    return plan;
  }
  plan.gather = plan.by_name ? m != Method::Photons : options.finalgather.on;
  plan.global = plan.by_name ? m != Method::FinalGather : options.globillum.on;
  plan.caustic = options.caustic.on;
  plan.indirect = plan.gather || plan.global;
  return plan;
}

}  // namespace oriel
