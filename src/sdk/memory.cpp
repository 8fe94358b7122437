// SPDX-License-Identifier: Apache-2.0
// Memory of shaders: filled with zeros, whatever way it grew.
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>

#include "oriel/sdk/shader/memory_blocks.h"
#include "oriel/sdk/shader/system.h"

namespace {

/// Stands before each piece, so that one that grows knows what is new.
struct alignas(std::max_align_t) Head {
  std::size_t size;
};

Head* head_of(void* memory) { return static_cast<Head*>(memory) - 1; }

void* piece(Head* head, std::size_t old_size, std::size_t size) {
  if (!head) return nullptr;
  head->size = size;
  auto* memory = reinterpret_cast<char*>(head + 1);
  if (size > old_size) std::memset(memory + old_size, 0, size - old_size);
  return memory;
}

bool fits(std::size_t size) {
  return size < std::numeric_limits<std::size_t>::max() - sizeof(Head);
}

void* grow(void* memory, std::size_t size) {
  if (!fits(size)) return nullptr;
  const std::size_t old_size = memory ? head_of(memory)->size : 0;
  auto* head =
      static_cast<Head*>(std::realloc(memory ? head_of(memory) : nullptr, sizeof(Head) + size));
  return piece(head, old_size, size);
}

/// mi_fatal does not return where a shader runs. Where none does, nobody could go on either.
void* required(void* memory, std::size_t size, const char* file, int line) {
  if (memory) return memory;
  mi_fatal("no memory for %zu bytes (%s:%d)", size, file, line);
  std::abort();
}

}  // namespace

void* mi_mem_int_test_allocate(const char* /*file*/, int /*line*/, size_t size) {
  // calloc gets large pieces from the system already zeroed.
  if (!fits(size)) return nullptr;
  auto* head = static_cast<Head*>(std::calloc(1, sizeof(Head) + size));
  return piece(head, size, size);
}

void* mi_mem_int_allocate(const char* file, int line, size_t size) {
  return required(mi_mem_int_test_allocate(file, line, size), size, file, line);
}

void* mi_mem_int_test_reallocate(const char* /*file*/, int /*line*/, void* memory, size_t size) {
  return grow(memory, size);
}

void* mi_mem_int_reallocate(const char* file, int line, void* memory, size_t size) {
  return required(grow(memory, size), size, file, line);
}

void mi_mem_int_release(const char* /*file*/, int /*line*/, void* memory) {
  if (memory) std::free(head_of(memory));
}

char* mi_mem_int_strdup(const char* file, int line, const char* text) {
  const std::string_view from = text ? text : "";
  auto* copy = static_cast<char*>(mi_mem_int_allocate(file, line, from.size() + 1));
  std::memcpy(copy, from.data(), from.size());
  return copy;
}

size_t mi_mem_getsize(const void* memory) {
  return memory ? head_of(const_cast<void*>(memory))->size : 0;
}
