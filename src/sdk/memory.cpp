// SPDX-License-Identifier: Apache-2.0
// Memory functions of shaders: always zero-initialised, also after growth. Blocks are compatible
// with malloc and free.
#include <malloc.h>

#include <cstdlib>
#include <cstring>
#include <string_view>

#include "oriel/sdk/shader/memory_blocks.h"
#include "oriel/sdk/shader/system.h"

namespace {

// The bytes after the requested size are also zero, so that a block can grow into them. Blocks of
// malloc itself have undefined bytes there.

void clear_from(void* memory, std::size_t begin) {
  const std::size_t end = malloc_usable_size(memory);
  if (end > begin) std::memset(static_cast<char*>(memory) + begin, 0, end - begin);
}

void* allocate(std::size_t size) {
  return std::calloc(1, size > 0 ? size : 1);  // large blocks are zero pages of the system
}

void* resize(void* memory, std::size_t size) {
  if (!memory) return allocate(size);
  if (size == 0) {
    std::free(memory);
    return nullptr;
  }
  const std::size_t old_size = malloc_usable_size(memory);
  void* const moved = std::realloc(memory, size);
  if (moved) clear_from(moved, size < old_size ? size : old_size);
  return moved;
}

/// mi_fatal does not return while a shader runs. Otherwise the process cannot continue anyway.
void* required(void* memory, std::size_t size, const char* file, int line) {
  if (memory) return memory;
  mi_fatal("out of memory for %zu bytes (%s:%d)", size, file, line);
  std::abort();
}

}  // namespace

void* mi_mem_int_test_allocate(const char* /*file*/, int /*line*/, size_t size) {
  return allocate(size);
}

void* mi_mem_int_allocate(const char* file, int line, size_t size) {
  return required(allocate(size), size, file, line);
}

void* mi_mem_int_test_reallocate(const char* /*file*/, int /*line*/, void* memory, size_t size) {
  return resize(memory, size);
}

void* mi_mem_int_reallocate(const char* file, int line, void* memory, size_t size) {
  void* const moved = resize(memory, size);
  if (!moved && memory && size == 0) return nullptr;
  return required(moved, size, file, line);
}

void mi_mem_int_release(const char* /*file*/, int /*line*/, void* memory) { std::free(memory); }

char* mi_mem_int_strdup(const char* file, int line, const char* text) {
  const std::string_view from = text ? text : "";
  auto* copy = static_cast<char*>(mi_mem_int_allocate(file, line, from.size() + 1));
  std::memcpy(copy, from.data(), from.size());
  return copy;
}

size_t mi_mem_getsize(const void* memory) {
  return memory ? malloc_usable_size(const_cast<void*>(memory)) : 0;
}
