// SPDX-License-Identifier: Apache-2.0
// C++ classes for read access to particle maps during rendering.
#ifndef ORIEL_SDK_MAP_ACCESS_H
#define ORIEL_SDK_MAP_ACCESS_H

// Conventions
//   Particle maps are converted to spheres and tubes before rendering, and their fields are not
//   stored. Every query therefore returns a status whose is_ok() is false; other results are 0.

#include "types.h"

#ifdef __cplusplus

namespace mi {
namespace shader {

typedef miUint Map_field_id;

/// Status of a query; always false.
class Map_status {
 public:
  bool is_ok() const { return false; }
  bool is_error() const { return true; }
};

/// A map of a tag.
class Access_map {
 public:
  explicit Access_map(miTag tag) : tag_(tag) {}
  const Access_map* operator->() const { return this; }
  bool is_valid() const { return false; }
  miTag tag() const { return tag_; }

 private:
  miTag tag_;
};

/// The fields of a map.
class Map_declaration {
 public:
  explicit Map_declaration(const Access_map&, Map_status* status = 0) { fail(status); }
  const Map_declaration* operator->() const { return this; }
  /// Index of a named field.
  Map_field_id get_field_id(const char*, Map_status* status = 0) const {
    fail(status);
    return 0;
  }
  /// Type, dimension and scope of a field; the arguments are unchanged.
  template <class Type, class Dimension, class Global>
  Map_status get_field_info(Map_field_id, Type&, Dimension&, Global&) const {
    return Map_status();
  }

 private:
  static void fail(Map_status* status) {
    if (status) *status = Map_status();
  }
};

}  // namespace shader
}  // namespace mi

#endif

#endif
