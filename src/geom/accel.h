// SPDX-License-Identifier: Apache-2.0
// Ray intersection with a world of instanced meshes. The only header that exposes Embree.
#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "geom/mesh.h"
#include "geom/surface.h"

struct RTCSceneTy;

namespace oriel::geom {

/// Ray types. A ray intersects an instance if their masks share a bit.
struct RayMask {
  enum : std::uint32_t {
    Camera = 1u << 0,
    Shadow = 1u << 1,             ///< for occluders that are known to be opaque
    ShadowTransparent = 1u << 2,  ///< for occluders that may be partly transparent
    Reflection = 1u << 3,
    Refraction = 1u << 4,
    Transparency = 1u << 5,
    FinalGather = 1u << 6,  ///< also used for diffuse bounces of path tracing
    Probe = 1u << 7,  ///< rays of shaders that sample nearby geometry: occlusion, round corners
    // For instances that are visible to this type of ray but cast no shadow.
    ShadowlessReflection = 1u << 8,
    ShadowlessRefraction = 1u << 9,
    ShadowlessFinalGather = 1u << 10,
    All = 0xffffffffu
  };
};

struct Ray {
  Vec3 org{0, 0, 0};
  float tnear = 0;
  Vec3 dir{0, 0, 0};  ///< any length; t is measured in it
  float tfar = std::numeric_limits<float>::infinity();
  std::uint32_t mask = RayMask::All;
  float time = 0;  ///< 0 to 1 from the first to the last motion key
};

/// A ray from a surface in direction d.
inline Ray spawn_ray(const SurfacePoint& from, const Vec3& d, std::uint32_t mask) {
  return Ray{from.ray_origin(d), 0, d, std::numeric_limits<float>::infinity(), mask, from.time};
}

/// A ray from a surface to a point just before `target`, which is at t = 1.
inline Ray spawn_ray_to(const SurfacePoint& from, const Vec3& target, std::uint32_t mask) {
  constexpr float kShort = 1 - 1e-4f;  // pbrt's shadow epsilon
  const Vec3 org = from.ray_origin(target - from.p);
  return Ray{org, 0, target - org, kShort, mask, from.time};
}

enum class MeshId : std::uint32_t {};

struct InstanceDesc {
  MeshId mesh{};
  Mat4 local_to_world, world_to_local;
  std::uint32_t mask = RayMask::All;
  std::uint32_t user = 0;  ///< user data of the caller
  /// local_to_world at equal steps of ray time from 0 to 1, at most kMaxKeys; empty if the
  /// instance does not move.
  std::vector<Mat4> path = {};
  bool operator==(const InstanceDesc&) const = default;
};

/// Memory usage of the acceleration structure in bytes.
struct AccelMemory {
  std::size_t meshes = 0, instances = 0, embree = 0;
  std::size_t triangles = 0;  ///< stored triangles; instances are not counted
  double bytes_per_triangle() const {
    return triangles == 0
               ? 0
               : static_cast<double>(meshes + instances + embree) / static_cast<double>(triangles);
  }
};

/// Decides whether a hit blocks a ray.
class BlockTest {
 public:
  virtual ~BlockTest() = default;
  /// Inputs:  hit: as Embree found it; Accel::refine() makes it exact.
  virtual bool blocks(const Hit& hit) = 0;
};

/// Owns the meshes of a world and intersects rays with them.
///
/// Model:   a mesh with one instance is transformed to world space in place and traced without an
///          instance. A mesh with several instances is built once and instanced, one level deep. An
///          instance with a singular or non-finite matrix is never hit. Curves are always
///          instanced; their pieces are numbered after the triangles of the mesh. Meshes with keys
///          and instances with a path move; the latter are always instanced. If several surfaces
///          have the same distance, the one with the smallest instance index, then primitive index,
///          is hit.
/// Errors:  std::bad_alloc or std::runtime_error from the constructor and commit().
/// Checked: AccelTest.*, RefineHit.*, Motion.*, NextFrame.*
class Accel {
 public:
  /// Handling of edges. Watertight: no ray passes between two triangles that share an edge, and
  /// hits are identical on every processor. Fast: rendering takes about 10 % less time. About one
  /// in ten rays that are aimed exactly at an edge passes through it, other rays practically never
  /// do, and results depend on the processor's reciprocal estimates.
  enum class Edges : std::uint8_t { Watertight, Fast };
#ifdef ORIEL_NATIVE
  static constexpr Edges kDefaultEdges = Edges::Fast;
#else
  static constexpr Edges kDefaultEdges = Edges::Watertight;
#endif

  explicit Accel(Edges edges = kDefaultEdges);
  ~Accel();
  Accel(const Accel&) = delete;
  Accel& operator=(const Accel&) = delete;

  /// Meshes of at least that many triangles get an acceleration structure of their own even if they
  /// have one instance, so that a change of another instance does not rebuild them. Results are the
  /// same; rays take a few percent longer. For scenes that are edited; before the first commit().
  /// Checked: AccelTest.MeshesApartHaveTheSameHits
  void keep_apart(std::size_t least_triangles);

  MeshId add_mesh(Mesh mesh);
  /// Returns the index of the instance: 0, 1, ... in the order of the calls.
  std::uint32_t add_instance(const InstanceDesc& desc);
  /// Sets the transform of an instance and removes its motion path, at the next commit(). Returns
  /// false and changes nothing if the matrix is singular.
  bool set_transform(std::uint32_t instance, const Mat4& local_to_world,
                     const Mat4& world_to_local);
  /// Changes the mask of an instance at the next commit().
  void set_mask(std::uint32_t instance, std::uint32_t mask);
  /// Removes all instances and keeps the meshes, for the next frame. Meshes without an instance at
  /// the next commit() are deleted. If the same instances are added again, nothing is rebuilt.
  /// Results are bit-identical to those of a new Accel.
  void begin_again();
  /// Returns a mesh as it was added, to replace one that was baked with a transform that has
  /// changed.
  using Remake = std::function<Mesh(MeshId)>;
  /// Builds everything that was added or changed; required before the first ray and after every
  /// change. Without `remake`, baked meshes are transformed back, which rounds.
  void commit(const Remake& remake = {});

  // All functions below are thread-safe after commit(). Threads should flush denormals to zero.

  /// Finds the nearest hit in (tnear, tfar).
  bool intersect(const Ray& ray, Hit& hit) const;
  /// Whether there is any hit in (tnear, tfar).
  bool occluded(const Ray& ray) const;
  /// The same, but hits of instances whose mask has a bit of `asked` count only if the test returns
  /// true. It is called for hits in any order, and for no others after one that blocks.
  bool occluded(const Ray& ray, std::uint32_t asked, BlockTest& test) const;
  /// Computes distance, place and normal of a hit that a BlockTest received, as intersect() does.
  void refine(const Ray& ray, Hit& hit) const;
  void interpolate(const Hit& hit, SurfacePoint& point) const;
  /// Matrices of an instance at a given time.
  void placement_at(std::uint32_t instance, float time, Mat4& local_to_world,
                    Mat4& world_to_local) const;

  const Mesh& mesh(MeshId id) const;
  /// Whether the vertex data of the mesh is in world space.
  bool is_baked(MeshId id) const;
  const InstanceDesc& instance(std::uint32_t index) const;
  std::uint32_t instance_count() const;
  Box3 bounds() const;  ///< world space; all instances, regardless of masks
  AccelMemory memory() const;

 private:
  struct Impl;
  struct AskingContext;
  std::unique_ptr<Impl> impl_;
  RTCSceneTy* scene_ = nullptr;  // copy of the pointer in impl_, saves an indirection per ray
  const InstanceDesc* instances_ = nullptr;  // likewise
};

}  // namespace oriel::geom
