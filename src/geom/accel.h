// SPDX-License-Identifier: Apache-2.0
// Rays against a world of instanced meshes. The only header through which anyone reaches Embree.
#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "geom/mesh.h"
#include "geom/surface.h"

struct RTCSceneTy;

namespace oriel::geom {

/// Kinds of rays; an instance's mask holds the kinds that meet it, a ray's the kinds it is.
struct RayMask {
  enum : std::uint32_t {
    Camera = 1u << 0,
    Shadow = 1u << 1,             ///< for blockers known to let no light through
    ShadowTransparent = 1u << 2,  ///< for blockers that may let some through
    Reflection = 1u << 3,
    Refraction = 1u << 4,
    Transparency = 1u << 5,
    FinalGather = 1u << 6,  ///< also the diffuse bounces of path tracing
    Probe = 1u << 7,        ///< shaders that feel for the scene: occlusion, round corners
    // What rays of that kind see although it casts no shadow.
    ShadowlessReflection = 1u << 8,
    ShadowlessRefraction = 1u << 9,
    ShadowlessFinalGather = 1u << 10,
    All = 0xffffffffu
  };
};

struct Ray {
  Vec3 org{0, 0, 0};
  float tnear = 0;
  Vec3 dir{0, 0, 0};  ///< any length; t counts in it
  float tfar = std::numeric_limits<float>::infinity();
  std::uint32_t mask = RayMask::All;
  float time = 0;  ///< 0 to 1 from the first to the last step of what moves
};

/// A ray from a surface in direction d.
inline Ray spawn_ray(const SurfacePoint& from, const Vec3& d, std::uint32_t mask) {
  return Ray{from.ray_origin(d), 0, d, std::numeric_limits<float>::infinity(), mask, from.time};
}

/// A ray from a surface to just before `target`, which it reaches at t = 1.
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
  std::uint32_t user = 0;  ///< the caller's own number
  /// local_to_world at equal steps of a ray's time from 0 to 1, at most kMostKeys; empty: it stays.
  std::vector<Mat4> path = {};
  bool operator==(const InstanceDesc&) const = default;
};

/// Bytes that live as long as the acceleration structure.
struct AccelMemory {
  std::size_t meshes = 0, instances = 0, embree = 0;
  std::size_t triangles = 0;  ///< stored, not instanced
  double bytes_per_triangle() const {
    return triangles == 0
               ? 0
               : static_cast<double>(meshes + instances + embree) / static_cast<double>(triangles);
  }
};

/// Owns the meshes of a world and answers rays.
///
/// Model:   a mesh with one instance is carried to world space in place and traced without an
///          instance in between; a mesh with several is built once and instanced, one level deep.
///          An instance whose matrix is singular or not finite is never hit. Curves are always
///          instanced; their pieces are numbered behind the mesh's triangles. Meshes with keys and
///          instances with a path move; the latter are instanced even where they are alone.
///          Of surfaces at the same distance the instance, then the primitive, with the smallest
///          number is hit.
/// Errors:  std::bad_alloc or std::runtime_error from the constructor and commit().
/// Checked: AccelTest.*, RefineHit.*, Motion.*, NextFrame.*
class Accel {
 public:
  /// How rays meet edges. Watertight: no ray passes between two triangles that share an edge, and
  /// hits are the same on every processor. Fast: about a tenth less time for a whole picture; of
  /// rays aimed exactly at an edge one in ten passes, of others practically none, and results
  /// follow the processor's estimates of reciprocals.
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

  MeshId add_mesh(Mesh mesh);
  /// Returns the instance's number: they count from 0 in the order added.
  std::uint32_t add_instance(const InstanceDesc& desc);
  /// Moves an instance at the next commit(), to stay there; false, and nothing changes, for a
  /// singular matrix.
  bool set_transform(std::uint32_t instance, const Mat4& local_to_world,
                     const Mat4& world_to_local);
  /// Changes which rays meet an instance, at the next commit().
  void set_mask(std::uint32_t instance, std::uint32_t mask);
  /// Takes all instances away and keeps the meshes, for the next frame: those that no instance has
  /// at the next commit() are forgotten then, and where the same instances are added again nothing
  /// is built. What comes of the rest is to the last bit what a new Accel would have.
  void begin_again();
  /// A mesh as it was added, for one that was carried to where it no longer is.
  using Remake = std::function<Mesh(MeshId)>;
  /// Builds what was added or changed; needed before the first ray and after every change. Without
  /// `remake` such meshes are carried back, which rounds.
  void commit(const Remake& remake = {});

  // From here on: safe from any thread after commit(). Threads should have denormals flushed.

  /// The nearest hit in (tnear, tfar).
  bool intersect(const Ray& ray, Hit& hit) const;
  /// Whether anything lies in (tnear, tfar).
  bool occluded(const Ray& ray) const;
  void interpolate(const Hit& hit, SurfacePoint& point) const;
  /// Matrices of an instance at a time.
  void placement_at(std::uint32_t instance, float time, Mat4& local_to_world,
                    Mat4& world_to_local) const;

  const Mesh& mesh(MeshId id) const;
  /// Whether the mesh's columns are in world space.
  bool is_baked(MeshId id) const;
  const InstanceDesc& instance(std::uint32_t index) const;
  std::uint32_t instance_count() const;
  Box3 bounds() const;  ///< world, of all instances whatever their masks
  AccelMemory memory() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  RTCSceneTy* scene_ = nullptr;              // impl's, one step nearer for the rays
  const InstanceDesc* instances_ = nullptr;  // as well
};

}  // namespace oriel::geom
