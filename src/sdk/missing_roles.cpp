// SPDX-License-Identifier: Apache-2.0
#include "sdk/missing_roles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::sdk {
namespace {

class RoleCheck {
 public:
  RoleCheck(const scene::Scene& scene, const Host& host, Diagnostics& diagnostics)
      : scene_(scene), host_(host), diagnostics_(diagnostics) {}

  void check(const scene::ShaderList& list, const char* role) {
    for (const scene::ShaderUse& use : list) check(use, role);
  }

 private:
  void check(const scene::ShaderUse& use, const char* role) {
    if (use.interface) return;
    if (use.reference.empty()) return check(use.type, use.where, role);
    if (const auto* element = scene_.get<scene::ShaderElement>(use.reference))
      for (const scene::ShaderUse& function : element->functions)
        if (!function.interface && function.reference.empty())
          check(function.type, use.where, role);
  }

  void check(const std::string& type, SourceLocation where, const char* role) {
    if (scene_.find_phenomenon(type) || host_.registry().find(type)) return;
    if (!reported_.insert(role + type).second) return;
    const auto& absent = host_.absent_libraries();
    diagnostics_.error(
        "OR-SDK-006", where,
        fmt::format("the {} shader \"{}\" is missing: no loaded library contains it, and {} "
                    "{} missing; the picture is rendered without it",
                    role, type, fmt::join(absent, ", "), absent.size() == 1 ? "is" : "are"),
        "name the folder of its library with --shader-path; `oriel shader-build` builds the "
        "library "
        "from sources");
  }

  const scene::Scene& scene_;
  const Host& host_;
  Diagnostics& diagnostics_;
  std::set<std::string> reported_;
};

}  // namespace

void report_missing_roles(const scene::Scene& scene, const scene::RenderCommand& command,
                          const scene::Camera* camera, bool lens, bool output, const Host& host,
                          Diagnostics& diagnostics) {
  if (host.absent_libraries().empty()) return;
  RoleCheck roles(scene, host, diagnostics);
  if (camera && lens) roles.check(camera->lens, "lens");
  if (camera && output)
    for (const scene::Output& one : camera->outputs) roles.check(one.shaders, "output");
  if (const auto* options = scene.get<scene::Options>(command.options))
    roles.check(options->state, "state");
}

}  // namespace oriel::sdk
