// SPDX-License-Identifier: Apache-2.0
// A shader call while its parameters are set one by one.
#pragma once

#include <string>
#include <vector>

#include "scene/shader.h"

namespace oriel::sdk {

/// Collects values as they come: scalars of one color or vector, structs and arrays within each
/// other.
///
/// Model:   scalars that follow one parameter_name belong to one value. Elements of an array are
///          separated by new_element; without it each value is an element, and scalars are put
///          together to elements of the declared type.
/// Checked: Declarations.* in tests/user_shaders
class CallWork {
 public:
  explicit CallWork(std::string declared) { use_.type = std::move(declared); }

  const std::string& declared() const { return use_.type; }
  /// The parameter that values are for now, "outer.inner" in structs.
  std::string parameter() const;

  void name(std::string parameter);
  void value(scene::Value value);
  void push(bool is_array);
  /// `width`: scalars that make one element of the array, 1 when it is not known. False: nothing is
  /// open.
  bool pop(std::size_t width);
  /// False outside of an array.
  bool new_element();
  /// The call; what is open is closed.
  scene::ShaderUse finish();

 private:
  struct Open {
    std::string parameter;   ///< of the struct or array in what is around it
    scene::Value value;      ///< Struct or Array
    bool separated = false;  ///< new_element was called
    bool begins = true;      ///< the next value begins an element
  };
  void add_item(Open& array, scene::Value value);

  scene::ShaderUse use_;
  std::string parameter_;
  bool continues_ = false;  ///< a value came since the parameter was named
  std::vector<Open> open_;
};

}  // namespace oriel::sdk
