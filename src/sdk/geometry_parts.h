// SPDX-License-Identifier: Apache-2.0
// The parts of an object that geometry shaders make piece by piece: hair, surfaces, particles.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "oriel/sdk/geoshader.h"
#include "scene/object.h"

namespace oriel::sdk {

struct GeometryWork;

/// Hair between mi_api_hair_begin and mi_api_hair_end.
struct HairWork {
  miHair_list list = {};
  scene::Hair hair;
  std::size_t added = 0;  ///< entries that mi_api_hair_hairs_add wrote
  bool adds = false;
  bool open = false;
};

/// A surface between mi_api_surface_begin and mi_api_surface_end.
struct SurfaceWork {
  scene::FreeSurface surface;
  bool open = false;
};

/// What a map holds of each particle, beside its position, or once.
struct MapDeclaration {
  struct Field {
    std::string name;
    bool global = false;
  };
  int dimension = 3;  ///< numbers of a position
  std::vector<Field> fields;
};

/// A field that is not in a declaration yet; behind the miParameter of mi_api_map_*.
struct MapField {
  MapDeclaration::Field field;
  MapField* first = nullptr;  ///< of its list
  MapField* next = nullptr;
};

/// A map of particles between mi_api_map_begin and mi_api_map_end, and what was said before it.
struct MapWork {
  int dimension = 3;  ///< of the next declaration
  bool tubes = false;
  std::map<std::string, std::string> shape_fields;  ///< to fields of the map

  bool open = false, globals_taken = false;
  MapDeclaration declaration;
  std::vector<double> current;               ///< of the field under way
  std::vector<std::vector<double>> values;   ///< of the particle's fields so far
  std::vector<std::vector<double>> globals;  ///< of global fields
  scene::Hair hair;
};

/// The interface owns names that it is given; null is the empty name.
std::string taken(const char* name);

/// The open group of the object under way; null when there is none.
scene::PolygonGroup* open_group();

/// Index of a material in a group's list; kNone for the empty name.
std::uint32_t material_index(scene::PolygonGroup& group, const std::string& name);

/// A statement of the approximation; nothing where the object's own applies.
std::optional<scene::Statement> statement_of(const miApprox& approx, std::string_view kind,
                                             const std::string& name);

}  // namespace oriel::sdk
