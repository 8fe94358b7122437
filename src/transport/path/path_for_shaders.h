// SPDX-License-Identifier: Apache-2.0
// Rays, irradiance and other materials that shaders ask for while a path shades a surface.
#pragma once

#include <span>

#include "runtime/tracer.h"
#include "sampling/sampler.h"
#include "transport/path/aov.h"

namespace oriel {

class Path;
struct PathRecord;

/// Paths that continue from a vertex of another path and return what they see, unweighted. They
/// have records of their own: the shader decides how their light counts.
/// Checked: RayNodes.* in tests/analytic/materials/ray_nodes_test.cpp
class PathForShaders {
 public:
  explicit PathForShaders(const Path& path) : path_(path) {}

  // See runtime/tracer.h.
  Tracer::Depth depth() const;
  Tracer::Seen trace(const ShadingPoint& point, const Tracer::SubRay& ray,
                     const sampling::Sampler& stream) const;
  Rgb irradiance(const ShadingPoint& point, const Vec3& normal, sampling::Sampler stream) const;
  /// Inputs:  aovs: where to write the AOVs of the result; may be null.
  Rgba shade(const NodeList& surface, ShadingPoint& point, AovValues* aovs,
             const sampling::Sampler& stream) const;
  /// Those of the sample, if the path is still what the eye or its mirrors see; else none.
  std::span<Rgba> user_buffers() const;
  float time() const;

 private:
  Path sub_path(const sampling::Sampler& stream, PathRecord& record) const;

  const Path& path_;
};

}  // namespace oriel
