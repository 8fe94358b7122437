// SPDX-License-Identifier: Apache-2.0
// The sensors that the options of `oriel measure` define.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geom/mesh.h"
#include "transport/path/irradiance_sensor.h"

namespace oriel::app {

struct PlaceArguments {
  std::vector<std::string> points;  ///< --at X,Y,Z
  std::string grid;                 ///< ORIGIN:U:V[:NUxNV]
  std::string plane;                ///< z=0.85
  std::string spacing, inset;       ///< lengths; empty = not given
  std::string normal;               ///< X,Y,Z; empty = the plane's, else 0,0,1
  std::optional<float> meters_per_unit;
};

/// Sensors row by row, in the order of a plan: columns along the first edge, rows from the far end
/// of the second edge to the near one. Single points have no columns and rows.
struct Places {
  std::vector<IrradianceSensor> sensors;
  int columns = 0, rows = 0;
  float spacing[2] = {0, 0};  ///< along both edges, scene units
};

/// Inputs:  scene: the bounding box, which limits --plane.
/// Errors:  UsageError that names the option.
Places find_places(const PlaceArguments& arguments, const geom::Box3& scene);

/// "x,y,z". Errors: UsageError that begins with `option`.
Vec3 parse_vector(const std::string& option, const std::string& text);

}  // namespace oriel::app
