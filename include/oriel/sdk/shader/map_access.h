// SPDX-License-Identifier: Apache-2.0
// The C++ classes that read particle maps while a picture is rendered.
#ifndef ORIEL_SDK_MAP_ACCESS_H
#define ORIEL_SDK_MAP_ACCESS_H

// Conventions
//   Particle maps are turned into spheres and tubes before rendering, and their fields are not
//   kept. Every question is therefore answered with a status whose is_ok() is false; other results
//   are 0.

#include "types.h"

#ifdef __cplusplus

namespace mi {
namespace shader {

typedef miUint Map_field_id;

/// Whether a question was answered; always false.
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
  /// Number of the field of that name.
  Map_field_id get_field_id(const char*, Map_status* status = 0) const {
    fail(status);
    return 0;
  }
  /// Type, dimension and scope of a field; the arguments keep their values.
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
