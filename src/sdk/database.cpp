// SPDX-License-Identifier: Apache-2.0
// Database elements that user shaders create, modify and delete.
#include "oriel/sdk/shader/database.h"

#include <cstring>

#include "oriel/sdk/shader/system.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "sdk/once.h"
#include "sdk/tags.h"

using namespace oriel::sdk;

extern "C" {

void* mi_db_create(miTag* tag, int type, int size) {
  *tag = miNULLTAG;
  Host* host = current_host();
  // Types are one byte.
  if (!host || type <= miSCENE_NONE || type > 255 || size < 0) {
    mi_error("mi_db_create: cannot create an element of type %d with %d bytes", type, size);
    return nullptr;
  }
  *tag = host->elements().create(type, static_cast<std::size_t>(size));
  if (*tag == miNULLTAG) {
    mi_fatal("out of memory for an element of %d bytes", size);
    return nullptr;
  }
  return host->elements().bytes(*tag);
}

void* mi_db_realloc(miTag tag, int size) {
  Host* host = current_host();
  if (!host || size < 0 || !host->elements().resize(tag, static_cast<std::size_t>(size)))
    return nullptr;
  return host->elements().bytes(tag);
}

void mi_db_delete(miTag tag) {
  Host* host = current_host();
  if (!host || tag == miNULLTAG || host->elements().erase(tag)) return;
  if (kind_of(tag) != TagKind::Element)
    warn_no_effect("mi_db_delete", "elements of the scene cannot be deleted while it is rendered");
}

miTag mi_db_copy(miTag tag) {
  Host* host = current_host();
  // These cannot be resized as blocks of bytes.
  if (!host || kind_of(tag) == TagKind::Function || kind_of(tag) == TagKind::Profile ||
      kind_of(tag) == TagKind::Texture)
    return miNULLTAG;
  const void* from = host->access(tag);
  if (!from) return miNULLTAG;
  const std::size_t size = host->size_of_record(tag);
  const miTag copy = host->elements().create(host->type_of(tag), size);
  if (void* to = host->elements().bytes(copy)) std::memcpy(to, from, size);
  return copy;
}

miBoolean mi_db_isjob(miTag) { return miFALSE; }

void mi_db_dump(void) {
  Host* host = current_host();
  const ShaderElements::Sum sum = host ? host->elements().sum() : ShaderElements::Sum{};
  mi_info("shaders have created %zu elements with %zu bytes", sum.elements, sum.bytes);
}

void mi_db_flush(miTag) {}

}  // extern "C"
