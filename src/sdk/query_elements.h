// SPDX-License-Identifier: Apache-2.0
// Queries about objects, groups, primitives, and the data attached to them.
#pragma once

#include <cstring>

#include "oriel/sdk/shader.h"

namespace oriel::sdk {

class Host;

// Each function writes the result of a query of its family; returns false if it is unsupported.
bool query_object(miQ_type query, Host& host, miTag tag, void* result);
/// `index` is the index of a group member.
bool query_group(miQ_type query, Host& host, miTag tag, void* result, int index);
bool query_data(miQ_type query, Host& host, miTag tag, void* result);
/// The object at the point of the state.
bool query_primitive(miQ_type query, Host& host, const miState* state, void* result);
/// User data of an instance, object or light; null if there is none.
miTag data_of(Host& host, miTag tag);
/// Members of a light that are only stored in the scene element.
void store_written(Host& host, miTag tag, miLight& out);
/// `tag N` of an instance or object; 0 if there is none.
miUint label_of(Host& host, miTag tag);

/// Writes a result to the memory of the caller; arrays are copied completely.
template <class T>
bool write_result(void* result, const T& value) {
  struct Whole {
    T value;
  };
  std::memcpy(result, &value, sizeof(Whole));
  return true;
}

}  // namespace oriel::sdk
