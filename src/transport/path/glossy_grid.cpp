// SPDX-License-Identifier: Apache-2.0
#include "transport/path/glossy_grid.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "base/parallel.h"
#include "transport/path/path_walk.h"
#include "transport/shadow.h"

namespace oriel {
namespace {

/// Grid points whose normals differ by more than this cosine (26 degrees) see other things. A
/// guess.
constexpr float kSameWay = 0.9f;
/// Most points along one side of a look-up.
constexpr int kMaxNeighbours = 64;

}  // namespace

/// Fills a grid point at the first surface of its ray: traces the interpolated lobes with weight 1.
class GridPointVisitor final : public SurfaceVisitor {
 public:
  GridPointVisitor(int density, GridPoint& point) : density_(density), out_(point) {}

  bool on_surface(Path& path, Closure& closure, const Material& material,
                  ShadingPoint& point) override {
    LobeChoice choice;
    make_ready(closure, point.wo());
    path.choose_lobes(closure, choice, point, path.indirect());
    for (int i = 0; i < closure.count; ++i) {
      const LobeControls& controls = closure.lobes[i].controls;
      if (choice.rays[i] > 0 && controls.interpolate && controls.grid_density == density_)
        trace_lobe(path, closure, i, material, point);
    }
    return false;
  }

 private:
  void trace_lobe(Path& path, const Closure& closure, int i, const Material& material,
                  ShadingPoint& point) {
    Closure alone = closure;
    for (int k = 0; k < alone.count; ++k) alone.lobes[k].weight = Rgb(k == i ? 1.0f : 0.0f);
    const Lobe& lobe = alone.lobes[i];
    const auto rays =
        is_delta(lobe.kind) ? 1u : std::max(1u, static_cast<std::uint32_t>(lobe.controls.samples));
    LobeChoice only;
    only.any = true;
    only.rays[i] = static_cast<float>(rays);
    const bool refracts = transmits(lobe.kind);
    PathRecord seen({}, path.record_->user_buffers);
    seen.alpha = 1;
    for (std::uint32_t j = 0; j < rays; ++j) {
      Path branch = path;
      branch.visitor_ = nullptr;
      branch.eye_hit_.alpha_open = true;
      branch.record_ = &seen;
      branch.sampler_ = path.sampler_.split(j, rays, static_cast<std::uint32_t>(i));
      // Reflecting lobes show lights without a visible shape by their highlights; refracting lobes
      // include them here.
      branch.from_.lights.environment = {};
      if (refracts) {
        std::construct_at(&branch.from_.lights, path.world_, point, alone);
        branch.from_.lights.environment = branch.environment_chances(material);
        branch.light_.throughput = Rgb(1 / static_cast<float>(rays));
        branch.take_direct(alone, only, point, true);
        branch.light_.throughput = Rgb(1);
      }
      branch.from_.point = &point;
      branch.from_.shadows = receives_shadows(path.world_, point);
      branch.from_.visible = branch.from_.invisible = {1, 0};
      if (branch.continue_path(alone, only, material, point, i, branch.sampler_.next_1d(),
                               refracts)) {
        ++branch.depth_.vertex;
        branch.walk();
      }
    }
    out_.instance = point.instance;
    out_.material = &material;
    out_.normal = point.normal;
    (refracts ? out_.refraction : out_.reflection) = seen.radiance;
    if (refracts) out_.alpha = seen.alpha;
  }

  int density_;
  GridPoint& out_;
};

float GlossyGrid::resolution(int density) {
  constexpr std::array<float, kDensities> kResolution = {2,        1,        1 / 2.0f,
                                                         1 / 3.0f, 1 / 4.0f, 1 / 5.0f};
  return kResolution[static_cast<std::size_t>(std::clamp(density, 0, kDensities - 1))];
}

int GlossyGrid::width(int density) const {
  return grids_.empty() ? 0 : grids_[static_cast<std::size_t>(density)].width;
}
int GlossyGrid::height(int density) const {
  return grids_.empty() ? 0 : grids_[static_cast<std::size_t>(density)].height;
}

namespace {

/// Numbers of a grid point in checkpoints: instance, material, which values there are; normal,
/// reflection, refraction, alpha.
constexpr std::size_t kGridIntegers = 3, kGridFloats = 10;
constexpr std::int32_t kHasReflection = 1, kHasRefraction = 2;

/// Size along a side of the picture.
int grid_size(int pixels, float resolution) {
  return static_cast<int>(std::ceil(static_cast<float>(pixels) * resolution));
}

}  // namespace

void GlossyGrid::save(CheckpointWriter& out, const World& world) const {
  out.value(static_cast<std::uint8_t>(grids_.size()));
  for (const Grid& grid : grids_) {
    std::vector<std::int32_t> integers;
    std::vector<float> floats;
    integers.reserve(grid.points.size() * kGridIntegers);
    floats.reserve(grid.points.size() * kGridFloats);
    for (const GridPoint& p : grid.points) {
      const std::ptrdiff_t material = p.material ? p.material - world.materials.data() : -1;
      const Rgb reflection = p.reflection.value_or(Rgb(0)),
                refraction = p.refraction.value_or(Rgb(0));
      integers.insert(integers.end(),
                      {p.instance, static_cast<std::int32_t>(material),
                       (p.reflection ? kHasReflection : 0) | (p.refraction ? kHasRefraction : 0)});
      floats.insert(floats.end(),
                    {p.normal.x, p.normal.y, p.normal.z, reflection.x, reflection.y, reflection.z,
                     refraction.x, refraction.y, refraction.z, p.alpha});
    }
    out.list(integers);
    out.list(floats);
  }
}

void GlossyGrid::restore(CheckpointReader& in, const World& world) {
  const auto require = [](bool condition) {
    if (!condition) throw CheckpointError("its grids of reflections are invalid");
  };
  std::uint8_t count = 0;
  in.value(count);
  require(count == 0 || count == kDensities);
  grids_.assign(count, {});
  for (int d = 0; d < count; ++d) {
    std::vector<std::int32_t> integers;
    std::vector<float> floats;
    in.list(integers);
    in.list(floats);
    Grid& grid = grids_[static_cast<std::size_t>(d)];
    if (integers.empty() && floats.empty()) continue;
    grid.width = grid_size(world.camera.width, resolution(d));
    grid.height = grid_size(world.camera.height, resolution(d));
    grid.points.resize(static_cast<std::size_t>(grid.width) *
                       static_cast<std::size_t>(grid.height));
    require(integers.size() == grid.points.size() * kGridIntegers &&
            floats.size() == grid.points.size() * kGridFloats);
    for (std::size_t i = 0; i < grid.points.size(); ++i) {
      GridPoint& p = grid.points[i];
      const std::int32_t* n = &integers[i * kGridIntegers];
      const float* f = &floats[i * kGridFloats];
      require(n[1] < static_cast<std::int64_t>(world.materials.size()));
      p.instance = n[0];
      if (n[1] >= 0) p.material = &world.materials[static_cast<std::size_t>(n[1])];
      p.normal = Vec3(f[0], f[1], f[2]);
      if ((n[2] & kHasReflection) != 0) p.reflection = Rgb(f[3], f[4], f[5]);
      if ((n[2] & kHasRefraction) != 0) p.refraction = Rgb(f[6], f[7], f[8]);
      p.alpha = f[9];
    }
  }
}

GlossyGrid::GlossyGrid(const World& world, const PathSettings& paths, std::uint32_t seed,
                       RayCounts& counts) {
  unsigned wanted = 0;
  // All nodes: shaders of materials may call other shaders that have grids.
  for (const auto& node : world.nodes)
    if (node->spec().material.grids) wanted |= node->spec().material.grids(*node);
  if (!wanted) return;
  grids_.resize(kDensities);
  std::mutex mutex;
  for (int d = 0; d < kDensities; ++d) {
    if (!(wanted & (1u << d))) continue;
    Grid& grid = grids_[static_cast<std::size_t>(d)];
    const float f = resolution(d);
    grid.width = grid_size(world.camera.width, f);
    grid.height = grid_size(world.camera.height, f);
    grid.points.resize(static_cast<std::size_t>(grid.width) *
                       static_cast<std::size_t>(grid.height));
    parallel_for(static_cast<std::size_t>(grid.height), [&](std::size_t row) {
      const int y = static_cast<int>(row);
      RayCounts mine;
      for (int x = 0; x < grid.width; ++x) {
        const Vec2 raster((static_cast<float>(x) + 0.5f) / f, (static_cast<float>(y) + 0.5f) / f);
        sampling::Sampler sampler(x, y, 0, seed + 0x9d1du + static_cast<std::uint32_t>(d));
        PathRecord nothing;
        const std::size_t at =
            row * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(x);
        GridPointVisitor visitor(d, grid.points[at]);
        Path(world, raster, paths, nothing, sampler, mine, &visitor).run(world.camera.ray(raster));
      }
      const std::lock_guard lock(mutex);
      counts += mine;
    });
  }
}

std::optional<GlossyGrid::Smooth> GlossyGrid::look_up(std::optional<Rgb> GridPoint::*value,
                                                      Vec2 raster, int density, int n, int instance,
                                                      const Material& material,
                                                      const Vec3& normal) const {
  if (grids_.empty()) return std::nullopt;
  const int d = std::clamp(density, 0, kDensities - 1);
  const Grid& grid = grids_[static_cast<std::size_t>(d)];
  n = std::clamp(n, 1, kMaxNeighbours);
  // In units of grid points, whole numbers at the points.
  const float f = resolution(d);
  const Vec2 at(raster.x * f - 0.5f, raster.y * f - 0.5f);
  const float radius = 0.5f * static_cast<float>(n);
  const auto first = [&](float a) { return static_cast<int>(std::ceil(a - radius)); };
  const auto tent = [&](float distance) {
    return n == 1 ? 1.0f : std::max(0.0f, 1 - std::abs(distance) / radius);
  };
  Smooth sum;
  float weight = 0;
  for (int j = first(at.y); j < first(at.y) + n; ++j)
    for (int i = first(at.x); i < first(at.x) + n; ++i) {
      if (i < 0 || j < 0 || i >= grid.width || j >= grid.height) continue;
      const GridPoint& p =
          grid.points[static_cast<std::size_t>(j) * static_cast<std::size_t>(grid.width) +
                      static_cast<std::size_t>(i)];
      if (p.instance != instance || p.material != &material || !(p.*value) ||
          dot(p.normal, normal) < kSameWay)
        continue;
      const float w = tent(static_cast<float>(i) - at.x) * tent(static_cast<float>(j) - at.y);
      sum.light += *(p.*value) * w;
      sum.alpha += p.alpha * w;
      weight += w;
    }
  if (weight <= 0) return std::nullopt;
  return Smooth{sum.light / weight, sum.alpha / weight};
}

}  // namespace oriel
