// SPDX-License-Identifier: Apache-2.0
// Paths that begin at a light meter in place of the eye: in the air, or on the first surface.
#include "transport/light_meter.h"
#include "transport/path_walk.h"

namespace oriel {
namespace {

/// Tells this stream from those of lobes, which number from 0.
constexpr std::uint32_t kMeterBranch = 3000;

}  // namespace

void Path::receive(ShadingPoint& point, bool mapped) {
  static const Material kMeter;
  point.instance = -1;
  point.texture_spaces = 0;
  point.normal = point.geometric_normal;
  point.ray_direction = -point.normal;
  point.ray_origin = point.position + point.normal;
  point.ray_length = 1;
  eye_ = left_ = point.position;
  first_ = false;
  parted_ = true;
  off_maps_ = !mapped;
  Closure white;
  white.add(LobeKind::Diffuse, Channel::Diffuse, Rgb(1), Frame(point.normal));
  medium_.begin_in(volume_around(world_, leave(point, point.normal, kInfinity, mask())));
  if (!gather(white, kMeter, point)) return;
  ++vertex_;
  walk();
}

/// The irradiance of the eye's first surface, on the side that is seen.
void Path::meter(const Closure& closure, const ShadingPoint& point) {
  PathSettings settings = settings_;
  settings.outputs = nullptr;
  settings.by_light = nullptr;
  settings.witness = nullptr;
  settings.meters = false;
  sampling::Sampler stream = sampler_.split(0, 1, kMeterBranch);
  ShadingPoint above = point;
  PathResult received;
  const bool mapped = closure.any([](const Lobe& lobe) { return is_diffuse(lobe.kind); });
  Path(world_, raster_, settings, stream, counts_, received).receive(above, mapped);
  result_->irradiance = received.radiance * kPi;
}

Rgb sample_irradiance(const World& world, const LightMeter& meter, const PathSettings& settings,
                      sampling::Sampler& sampler, RayCounts& counts) {
  ShadingPoint point;
  point.position = meter.position;
  point.geometric_normal = meter.normal;
  point.ray_offset = meter.offset;
  point.world = &world;
  point.time = world.shutter.middle();
  PathResult received;
  Path(world, point.raster, settings, sampler, counts, received).receive(point, false);
  return received.radiance * kPi;
}

}  // namespace oriel
