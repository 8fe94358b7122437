// SPDX-License-Identifier: Apache-2.0
#include "render_attributes.h"

#include <fmt/format.h>

#include <filesystem>

#include "output/picture_metadata.h"
#include "render/indirect_plan.h"
#include "render/session.h"
#include "render_plan.h"

namespace oriel::app {

std::map<std::string, ExrValue> render_attributes(const RenderArguments& a,
                                                  const RenderSession& session) {
  const RenderBudget& b = session.budget();
  const Progress p = session.progress();
  std::map<std::string, ExrValue> m;
  m["software"] = std::string("Oriel " ORIEL_VERSION);
  m["oriel.scene"] = std::filesystem::path(a.scene.path).filename().string();
  m["oriel.indirect"] = std::string(plan_indirect(session.world().options).name());
  m["oriel.seed"] = static_cast<int>(a.seed);
  m["oriel.samples"] = static_cast<float>(p.mean_samples);
  m["oriel.maxSamples"] = static_cast<int>(b.max_samples);
  m["oriel.noiseTarget"] = static_cast<float>(b.noise);
  if (session.film().light_layers() > 0)
    m["oriel.lightGroups"] = fmt::format("{}", fmt::join(session.world().light_layers.names, " "));
  if (p.noise) m["oriel.noise"] = static_cast<float>(*p.noise);
  if (!a.scene.edits.empty()) m["oriel.set"] = fmt::format("{}", fmt::join(a.scene.edits, "; "));
  if (!a.sun.empty()) m["oriel.sun"] = fmt::format("{} north {:.6g}", a.sun, a.north.value_or(0));
  if (const auto date = capture_date(a.timestamps)) {
    m["capDate"] = *date;
    m["utcOffset"] = 0.0f;
  }
  if (a.timestamps) m["oriel.renderSeconds"] = static_cast<float>(p.elapsed);
  return m;
}

}  // namespace oriel::app
