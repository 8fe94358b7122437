// SPDX-License-Identifier: Apache-2.0
// Paths that begin at a light meter in place of the eye: in the air, or on the first surface.
#include "transport/path/irradiance_sensor.h"
#include "transport/path/path_walk.h"

namespace oriel {
namespace {

/// Tells this stream from those of lobes, which number from 0.
constexpr std::uint32_t kMeterBranch = 3000;

}  // namespace

void Path::receive(ShadingPoint& point, bool mapped) {
  static const Material kSensor;
  point.instance = -1;
  point.texture_spaces = 0;
  point.normal = point.geometric_normal;
  point.ray_direction = -point.normal;
  point.ray_origin = point.position + point.normal;
  point.ray_length = 1;
  eye_hit_.eye = way_.left = point.position;
  eye_hit_.pending = false;
  aov_.fixed = true;
  off_maps_ = !mapped;
  Closure white;
  white.add(LobeKind::Diffuse, LobeType::Diffuse, Rgb(1), Frame(point.normal));
  way_.medium.begin_in(volume_around(world_, leave(point, point.normal, kInfinity, mask())));
  if (!shade_vertex(white, kSensor, point)) return;
  ++depth_.vertex;
  walk();
}

/// The irradiance of the eye's first surface, on the side that is seen.
void Path::sense_irradiance(const Closure& closure, const ShadingPoint& point) {
  sampling::Sampler stream = sampler_.split(0, 1, kMeterBranch);
  ShadingPoint above = point;
  PathRecord received({}, record_->user_buffers);
  const bool mapped = closure.any([](const Lobe& lobe) { return is_diffuse(lobe.kind); });
  Path(world_, raster_, settings_, received, stream, counts_).receive(above, mapped);
  record_->irradiance = received.radiance * kPi;
}

Rgb sample_irradiance(const World& world, const IrradianceSensor& sensor,
                      const PathSettings& settings, sampling::Sampler& sampler, RayCounts& counts) {
  ShadingPoint point;
  point.position = sensor.position;
  point.geometric_normal = sensor.normal;
  point.ray_offset = sensor.offset;
  point.world = &world;
  point.time = world.shutter.middle();
  PathRecord received;
  Path(world, point.raster, settings, received, sampler, counts).receive(point, false);
  return received.radiance * kPi;
}

}  // namespace oriel
