// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/gather_points.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "transport/gather/gather_share.h"
#include "transport/path/path_walk.h"

namespace oriel {
namespace {

/// Default maximum radius as a fraction of the scene's diagonal, and default minimum radius as a
/// fraction of the maximum.
constexpr float kMaxRadius = 0.1f, kMinRadius = 0.03f;
/// Records with a larger error are not used (GatherQuery::accuracy); an estimate.
constexpr float kWorstError = 1;
/// Fraction of a point's rays that is distributed evenly; the others go to strata with contrast.
constexpr float kSpreadShare = 0.5f;

}  // namespace

/// Appends a gather point at each diffuse surface, and continues through mirrors and transparency.
class GatherPointVisitor final : public SurfaceVisitor {
 public:
  explicit GatherPointVisitor(std::vector<GatherPoint>& points) : points_(points) {}

  bool on_surface(Path& path, Closure& closure, const Material& material,
                  ShadingPoint& point) override {
    LobeChoice choice;
    make_ready(closure, point.wo());
    path.choose_lobes(closure, choice, point, path.indirect());
    const std::size_t before = points_.size();
    for (int i = 0; i < closure.count; ++i) {
      const Lobe& lobe = closure.lobes[i];
      const bool emulates = lobe.controls.emulated && lobe.controls.highlights_only;
      if (!is_diffuse(lobe.kind) && !emulates) continue;
      choice.rays[i] = 0;
      if (path.allows(kSendsGatherRays)) add(before, lobe, point);
    }
    choice.share_one_ray(closure.count);
    if (!choice.any) return false;
    float u = path.sampler_.next_1d();
    const int lobe = choose_lobe(closure, choice, u);
    return path.continue_path(closure, choice, material, point, lobe, u);
  }
  bool on_irradiance(const ShadingPoint& point, const Vec3& normal) override {
    points_.push_back({point, normal});
    return true;
  }
  bool visits_rays_of_shaders() const override { return true; }

 private:
  /// Adds a point for the lobe's side of the surface. Lobes of the same side share a point; the
  /// points of this surface begin at index `first`.
  void add(std::size_t first, const Lobe& lobe, const ShadingPoint& point) {
    const Vec3 side = lit_side(lobe);
    const float quality = lobe.kind == LobeKind::Diffuse ? lobe.controls.samples : 1.0f;
    for (std::size_t i = first; i < points_.size(); ++i)
      if (dot(points_[i].normal, side) > 1 - 1e-4f) {
        points_[i].quality = std::max(points_[i].quality, quality);
        return;
      }
    points_.push_back({point, side, quality});
  }

  std::vector<GatherPoint>& points_;
};

void visit_gather_points(const World& world, Vec2 raster, const PathSettings& settings,
                         sampling::Sampler& sampler, RayCounts& counts,
                         std::vector<GatherPoint>& points) {
  PathRecord nothing;
  GatherPointVisitor visitor(points);
  Path(world, raster, settings, nothing, sampler, counts, &visitor).run(world.camera.ray(raster));
}

void visit_gather_ray(const World& world, const GatherPoint& from, const Vec3& direction,
                      const PathSettings& settings, sampling::Sampler& sampler, RayCounts& counts,
                      std::vector<GatherPoint>& points) {
  PathRecord nothing;
  GatherPointVisitor visitor(points);
  Path(world, from.point.raster, settings, nothing, sampler, counts, &visitor)
      .gather_ray(from.point, direction, kInfinity);
}

GatherRadii default_gather_radii(float diagonal) {
  const float max = kMaxRadius * diagonal;
  return {kMinRadius * max, max, false};
}

GatherSettings gather_settings(const scene::RenderOptions& all, const geom::Box3& scene) {
  const scene::FinalGatherOptions& options = all.finalgather;
  GatherSettings s;
  s.rays = std::max(options.rays, 4);
  s.filter = options.filter;
  s.reach = options.falloff_stop;
  s.fades_from = std::min(options.falloff_start, options.falloff_stop);
  s.radii = default_gather_radii(length(scene.max - scene.min));
  s.radii.in_pixels = options.radius_in_pixels && options.max_radius > 0;
  if (options.max_radius > 0) s.radii.max = options.max_radius;
  s.radii.min = options.min_radius > 0 ? options.min_radius : kMinRadius * s.radii.max;
  s.path.further_bounces = rgb(options.secondary_scale);
  using Depth = scene::FinalGatherOptions::Depth;
  const bool by_name = all.indirect != scene::IndirectMethod::Scene;
  if (by_name && !options.depth) return s;
  const Depth depth = options.depth.value_or(Depth{});
  s.path.diffuse_bounces = std::max(0, depth.diffuse);
  s.path.depth_behind = {depth.reflection, depth.refraction, depth.sum};
  return s;
}

GatherQuery gather_query(const scene::FinalGatherOptions& options, const GatherRadii& radii) {
  using Mode = scene::FinalGatherOptions::Mode;
  GatherQuery q;
  q.radii = radii;
  if (options.normal_tolerance > 0) q.min_cosine = math::cos(options.normal_tolerance * kPi / 180);
  q.gradients = options.mode != Mode::StrictRadius;
  if (options.mode == Mode::Automatic) {
    q.by_error = true;
    q.accuracy = kWorstError;
  }
  if (options.mode == Mode::Automatic || options.mode == Mode::Multiframe)
    q.points = std::clamp(options.points, 1, GatherCache::kMaxPoints);
  return q;
}

namespace {

/// Weight of the surface that a gather ray of limited reach hit; the remainder is environment.
float kept_of(const GatherSettings& settings, const PathResult& found) {
  if (!(settings.reach > 0) || found.depth <= settings.fades_from) return 1;
  return linear_fade(found.depth - settings.fades_from, settings.reach - settings.fades_from);
}

Rgb open_sky(const World& world, const Vec3& origin, const Vec3& direction, RayCounts& counts) {
  if (world.environment.empty()) return Rgb(0);
  ++counts.environment;
  return world.light_sampler->environment_radiance({.origin = origin, .direction = direction});
}

Rgb not_negative(const Rgb& c) {
  return Rgb(std::max(0.0f, c.x), std::max(0.0f, c.y), std::max(0.0f, c.z));
}

}  // namespace

namespace {

std::size_t layers_of(const World& world) {
  return world.light_layers.asked() ? world.light_layers.count() : 0;
}

/// Traces the rays of one point and sums them by stratum.
class RayGatherer {
 public:
  RayGatherer(const World& world, const GatherPoint& at, const GatherSettings& settings,
              RayCounts& counts, bool keeps_reads, GatherRays& out)
      : world_(world),
        at_(at),
        settings_(settings),
        counts_(counts),
        layers_(layers_of(world)),
        side_(dot(at.normal, at.point.geometric_normal) < 0 ? -1.0f : 1.0f),
        record_({.light_layers = layers_}),
        out_(out) {
    if (keeps_reads) record_.bounce_reads = &reads_;
  }

  /// One ray; adds its light to the stratum and returns it.
  GatherSample trace(int stratum, sampling::Sampler& stream) {
    record_.reset();
    reads_.of.clear();
    GatherSample s;
    s.direction = out_.hemisphere.direction(stratum, stream.next_2d());
    if (side_ * dot(s.direction, at_.point.geometric_normal) <= 0) return s;
    const float reach = settings_.reach > 0 ? settings_.reach : kInfinity;
    trace_gather_ray(world_, at_.point, s.direction, reach, settings_.path, record_, stream,
                     counts_);
    const float kept = kept_of(settings_, record_);
    s.radiance = record_.radiance;
    LightParts& by_light = record_.by_light;
    if (kept < 1) {
      const Rgb open = open_sky(world_, at_.point.position, s.direction, counts_) * (1 - kept);
      s.radiance = s.radiance * kept + open;
      for (std::size_t i = 0; i < layers_; ++i) by_light.of[i] *= kept;
      if (layers_ > 0) by_light.of[world_.light_layers.environment] += open;
      reads_.scale(0, Rgb(kept));
    }
    if (record_.depth > 0) {
      s.distance = record_.depth;
      s.normal = record_.normal;
    }
    for (std::size_t i = 0; i < layers_; ++i)
      if (is_finite(by_light.of[i]))
        out_.by_light[static_cast<std::size_t>(stratum) * layers_ + i] +=
            not_negative(by_light.of[i]);
    for (const BounceReads::Read& read : reads_.of) out_.reads.push_back({stratum, read});
    out_.complete &= reads_.complete;
    return s;
  }

 private:
  const World& world_;
  const GatherPoint& at_;
  const GatherSettings& settings_;
  RayCounts& counts_;
  std::size_t layers_;
  float side_;
  PathRecord record_;
  BounceReads reads_;
  GatherRays& out_;
};

}  // namespace

GatherRays trace_gather_rays(const World& world, const GatherPoint& at,
                             const GatherSettings& settings, const sampling::Sampler& sampler,
                             RayCounts& counts, bool keeps_reads) {
  sampling::Sampler turn = sampler;
  const std::size_t layers = layers_of(world);
  const int rays =
      std::max(4, static_cast<int>(std::lround(static_cast<float>(settings.rays) * at.quality)));
  const int spread = std::max(4, static_cast<int>(static_cast<float>(rays) * kSpreadShare));
  GatherRays out;
  out.hemisphere = GatherHemisphere::for_rays(at.normal, spread, turn.next_1d());
  const int strata = out.hemisphere.count();
  out.samples.resize(static_cast<std::size_t>(strata));
  out.by_light.assign(static_cast<std::size_t>(strata) * layers, Rgb(0));
  RayGatherer gatherer(world, at, settings, counts, keeps_reads, out);
  for (int i = 0; i < strata; ++i) {
    auto stream =
        sampler.split(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(strata), 0);
    out.samples[static_cast<std::size_t>(i)] = gatherer.trace(i, stream);
  }
  const std::vector<int> more = share_rays(out.samples, out.hemisphere.rings,
                                           out.hemisphere.sectors, std::max(0, rays - strata));
  for (int i = 0; i < strata; ++i) {
    GatherSample& s = out.samples[static_cast<std::size_t>(i)];
    const int n = more[static_cast<std::size_t>(i)];
    for (int j = 0; j < n; ++j) {
      auto stream = sampler.split(static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(n),
                                  static_cast<std::uint32_t>(i + 1));
      s.radiance += gatherer.trace(i, stream).radiance;
    }
    s.radiance /= static_cast<float>(n + 1);
    for (std::size_t k = 0; k < layers; ++k)
      out.by_light[static_cast<std::size_t>(i) * layers + k] /= static_cast<float>(n + 1);
  }
  for (GatherRays::Read& read : out.reads)
    read.of.factor /= static_cast<float>(more[static_cast<std::size_t>(read.stratum)] + 1);
  return out;
}

GatherRecord gathered_record(const World& world, const GatherPoint& at,
                             const GatherSettings& settings, const GatherRays& rays,
                             const GatherCache* coarse) {
  const std::size_t layers = layers_of(world);
  std::vector<GatherSample> samples = rays.samples;
  std::vector<Rgb> shares(layers, Rgb(0));
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t k = 0; k < layers; ++k) shares[k] += rays.by_light[i * layers + k];
  LightParts parts;
  if (coarse)
    for (const GatherRays::Read& read : rays.reads) {
      parts.clear(layers);
      const Rgb e = coarse->irradiance(read.of.records, read.of.position, read.of.normal,
                                       layers > 0 ? parts.data() : nullptr, layers);
      samples[static_cast<std::size_t>(read.stratum)].radiance += read.of.factor * e;
      for (std::size_t k = 0; k < layers; ++k) shares[k] += read.of.factor * parts.of[k];
    }
  GatherRecord record =
      make_gather_record(at.point.position, rays.hemisphere, samples,
                         settings.radii.in_scene(pixel_width(at.point)), settings.filter);
  normalise_shares(shares);
  record.shares = std::move(shares);
  return record;
}

GatherRecord gather_at(const World& world, const GatherPoint& at, const GatherSettings& settings,
                       const sampling::Sampler& sampler, RayCounts& counts) {
  return gathered_record(world, at, settings,
                         trace_gather_rays(world, at, settings, sampler, counts, false));
}

}  // namespace oriel
