// SPDX-License-Identifier: Apache-2.0
// A shader call under construction, whose parameters are set one by one.
#pragma once

#include <string>
#include <vector>

#include "scene/shader.h"

namespace oriel::sdk {

/// Collects values in order: scalars of a color or vector, nested structs and arrays.
///
/// Model:   scalars after one parameter_name belong to one value. Elements of an array are
///          separated by new_element. Without it each value is an element, and scalars are grouped
///          to elements of the declared type.
/// Checked: Declarations.* in tests/user_shaders
class CallWork {
 public:
  explicit CallWork(std::string declared) { use_.type = std::move(declared); }

  const std::string& declared() const { return use_.type; }
  /// The parameter that following values belong to, "outer.inner" in structs.
  std::string parameter() const;

  void name(std::string parameter);
  void value(scene::Value value);
  void push(bool is_array);
  /// `width`: number of scalars per element of the array, 1 if unknown. Returns false if no struct
  /// or array is open.
  bool pop(std::size_t width);
  /// Returns false outside of an array.
  bool new_element();
  /// Closes open structs and arrays and returns the call.
  scene::ShaderUse finish();

 private:
  struct Open {
    std::string parameter;   ///< of the struct or array in its parent
    scene::Value value;      ///< Struct or Array
    bool separated = false;  ///< new_element was called
    bool begins = true;      ///< the next value starts an element
  };
  void add_item(Open& array, scene::Value value);

  scene::ShaderUse use_;
  std::string parameter_;
  bool continues_ = false;  ///< a value was added since the parameter was named
  std::vector<Open> open_;
};

}  // namespace oriel::sdk
