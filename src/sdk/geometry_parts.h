// SPDX-License-Identifier: Apache-2.0
// Parts of an object under construction by a geometry shader: hair, surfaces, particles.
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

/// State between mi_api_hair_begin and mi_api_hair_end.
struct HairWork {
  miHair_list list = {};
  scene::Hair hair;
  std::size_t added = 0;  ///< entries written by mi_api_hair_hairs_add
  bool adds = false;
  bool open = false;
};

/// State between mi_api_surface_begin and mi_api_surface_end.
struct SurfaceWork {
  scene::FreeSurface surface;
  bool open = false;
};

/// Fields of a particle map in addition to the position, per particle or global.
struct MapDeclaration {
  struct Field {
    std::string name;
    bool global = false;
  };
  int dimension = 3;  ///< components of a position
  std::vector<Field> fields;
};

/// A field before it is added to a declaration; passed as miParameter in mi_api_map_*.
struct MapField {
  MapDeclaration::Field field;
  MapField* first = nullptr;  ///< first field of the list
  MapField* next = nullptr;
};

/// State between mi_api_map_begin and mi_api_map_end, and preceding settings.
struct MapWork {
  int dimension = 3;  ///< for the next declaration
  bool tubes = false;
  std::map<std::string, std::string> shape_fields;  ///< shape attribute to field name

  bool open = false, globals_taken = false;
  MapDeclaration declaration;
  std::vector<double> current;               ///< of the current field
  std::vector<std::vector<double>> values;   ///< fields of the particle so far
  std::vector<std::vector<double>> globals;  ///< values of global fields
  scene::Hair hair;
};

/// Copies and frees a name, which the interface owns; null is the empty name.
std::string taken(const char* name);

/// The open group of the current object; null if there is none.
scene::PolygonGroup* open_group();

/// Index of a material in the list of a group; kNone for the empty name.
std::uint32_t material_index(scene::PolygonGroup& group, const std::string& name);

/// A statement of the approximation; unset if that of the object applies.
std::optional<scene::Statement> statement_of(const miApprox& approx, std::string_view kind,
                                             const std::string& name);

}  // namespace oriel::sdk
