// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_ray_marcher.h"

#include <algorithm>
#include <cmath>

#include "runtime/shader_node.h"

namespace oriel {
namespace {

struct MibRayMarcherParams {
  ShaderRef shader;
  float distance;
  int num, subdiv;
  Rgba contrast;
};

constexpr int kDefaultSteps = 4;
/// Maximum number of initial points, to limit the time per ray.
constexpr int kMaxSteps = 4096;
constexpr int kMaxSubdivisions = 16;
/// Maximum number of points of one ray.
constexpr int kMaxEvaluations = 1 << 16;

constexpr ParamSpec kMibRayMarcherRows[] = {
    {ORIEL_PARAM(MibRayMarcherParams, shader), .doc = "Shader evaluated at each sample point.",
     .declared_default = false},
    {ORIEL_PARAM(MibRayMarcherParams, distance), .min = 0, .unit = "scene units",
     .doc = "Maximum distance of sample points; 0 = unlimited.", .declared_default = false},
    {ORIEL_PARAM(MibRayMarcherParams, num), .min = 0,
     .doc = "Initial number of sample points, including the ends; 0 = by distance, or 4.",
     .declared_default = false},
    {ORIEL_PARAM(MibRayMarcherParams, subdiv), .min = 0, .max = kMaxSubdivisions,
     .doc = "Maximum number of subdivisions of an interval.", .declared_default = false},
    {ORIEL_PARAM(MibRayMarcherParams, contrast),
     .doc = "Difference of neighbours above which an interval is subdivided.",
     .declared_default = false},
};

class March {
 public:
  March(const MibRayMarcherParams& p, const ShadingPoint& end)
      : p_(p), place_(end), subdiv_(std::clamp(p.subdiv, 0, kMaxSubdivisions)) {
    place_.normal = place_.geometric_normal = -end.ray_direction;
    place_.texture_spaces = 0;
    place_.dpdx = place_.dpdy = place_.dpdu = place_.dpdv = Vec3(0);
    place_.ray_offset = 0;
    place_.instance = -1;
  }

  Rgb sum(float length) {
    int places = p_.num > 0 ? std::max(2, p_.num) : p_.distance > 0 ? 2 : kDefaultSteps;
    if (p_.distance > 0) {
      const float steps = std::ceil(std::min(length / p_.distance, float{kMaxSteps}));
      places = std::max(places, static_cast<int>(steps) + 1);
    }
    places = std::min(places, kMaxSteps);
    const float step = length / static_cast<float>(places - 1);
    Rgb total(0), before = at(0);
    for (int i = 1; i < places; ++i) {
      const float t = step * static_cast<float>(i);
      const Rgb here = at(t);
      total += between(t - step, before, t, here, subdiv_);
      before = here;
    }
    return total;
  }

 private:
  Rgb at(float t) {
    place_.position = place_.ray_origin + place_.ray_direction * t;
    place_.ray_length = t;
    ++asked_;
    return rgb(p_.shader.node->color(place_));
  }
  bool differ(const Rgb& a, const Rgb& b) const {
    const Rgb limit = rgb(p_.contrast);
    for (int k = 0; k < 3; ++k)
      if (std::abs(a[k] - b[k]) > limit[k]) return true;
    return false;
  }
  Rgb between(float t0, const Rgb& c0, float t1, const Rgb& c1, int left) {
    if (left == 0 || asked_ >= kMaxEvaluations || !differ(c0, c1))
      return (c0 + c1) * ((t1 - t0) / 2);
    const float t = (t0 + t1) / 2;
    const Rgb c = at(t);
    return between(t0, c0, t, c, left - 1) + between(t, c, t1, c1, left - 1);
  }

  const MibRayMarcherParams& p_;
  ShadingPoint place_;
  int subdiv_;
  int asked_ = 0;
};

Rgb march(const Call& call) {
  const auto& p = call.as<MibRayMarcherParams>();
  const float length = call.point.ray_length;
  if (!p.shader.node || !(length > 0) || std::isinf(length)) return Rgb(0);
  return March(p, call.point).sum(length);
}

}  // namespace

const ShaderSpec kMibRayMarcher = {
    .name = "mib_ray_marcher",
    .library = "base",
    .apply = kApplyMaterial | kApplyTexture | kApplyVolume,
    .doc = "Shader accumulated along a ray.",
    .params = kMibRayMarcherRows,
    .params_size = sizeof(MibRayMarcherParams),
    .value =
        [](const Call& call, void* result) {
          const Rgb c = march(call);
          *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, 1);
        },
    .volume =
        {
            .evaluate =
                [](const Call& call) {
                  return VolumeValue{Rgb(1), march(call)};
                },
        },
};

}  // namespace oriel
