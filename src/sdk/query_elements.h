// SPDX-License-Identifier: Apache-2.0
// Queries about what instances place: objects, groups, primitives, and the data attached to them.
#pragma once

#include <cstring>

#include "oriel/sdk/shader.h"

namespace oriel::sdk {

class Host;

// Each writes the answer to one query of its family; false: it has none.
bool ask_object(miQ_type query, Host& host, miTag tag, void* result);
/// `index` counts the members of a group from 0.
bool ask_group(miQ_type query, Host& host, miTag tag, void* result, int index);
bool ask_data(miQ_type query, Host& host, miTag tag, void* result);
/// The object that the state's point lies on.
bool ask_primitive(miQ_type query, Host& host, const miState* state, void* result);
/// What is attached to an instance, object or light; null: nothing.
miTag data_of(Host& host, miTag tag);
/// Members of a light that only the scene's element knows.
void store_written(Host& host, miTag tag, miLight& out);
/// `tag N` of an instance or object; 0: none.
miUint label_of(Host& host, miTag tag);

/// Writes an answer where the caller wants it; arrays whole.
template <class T>
bool tell(void* result, const T& value) {
  struct Whole {
    T value;
  };
  std::memcpy(result, &value, sizeof(Whole));
  return true;
}

}  // namespace oriel::sdk
