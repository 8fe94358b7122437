// SPDX-License-Identifier: Apache-2.0
// Arenas of equally sized blocks, and memory statistics of shaders.
#include "oriel/sdk/shader/memory_blocks.h"

#include <malloc.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <vector>

#include "oriel/sdk/shader/system.h"

namespace {

constexpr std::size_t kMaxBlock = std::size_t{1} << 20;
constexpr std::size_t kPage = std::size_t{1} << 16;

}  // namespace

struct miMemblk {
  explicit miMemblk(std::size_t wanted)
      : stride((wanted + alignof(std::max_align_t) - 1) / alignof(std::max_align_t) *
               alignof(std::max_align_t)),
        blocks_a_page(std::max<std::size_t>(kPage / stride, 1)) {}

  /// Several blocks in one allocation.
  struct Page {
    std::unique_ptr<std::byte[]> bytes;
    std::vector<bool> used;
  };
  const std::size_t stride;
  const std::size_t blocks_a_page;
  std::mutex mutex;
  std::map<const std::byte*, Page> pages;  ///< by start address
  std::vector<std::byte*> free;

  void* take() {
    const std::lock_guard lock(mutex);
    if (free.empty()) add_page();
    std::byte* block = free.back();
    free.pop_back();
    mark(block, true);
    std::memset(block, 0, stride);
    return block;
  }

  void give_back(void* memory) {
    const std::lock_guard lock(mutex);
    auto* block = static_cast<std::byte*>(memory);
    if (mark(block, false)) free.push_back(block);
  }

  std::vector<void*> in_use() {
    const std::lock_guard lock(mutex);
    std::vector<void*> all;
    for (const auto& [begin, page] : pages)
      for (std::size_t i = 0; i < blocks_a_page; ++i)
        if (page.used[i]) all.push_back(page.bytes.get() + i * stride);
    return all;
  }

 private:
  void add_page() {
    Page page{std::make_unique<std::byte[]>(blocks_a_page * stride),
              std::vector<bool>(blocks_a_page)};
    std::byte* begin = page.bytes.get();
    free.reserve((pages.size() + 1) * blocks_a_page);  // so that freeing a block needs no memory
    pages.emplace(begin, std::move(page));
    for (std::size_t i = blocks_a_page; i-- > 0;) free.push_back(begin + i * stride);
  }

  /// Returns false if the address is not a block or already has that mark.
  bool mark(const std::byte* block, bool used) {
    auto after = pages.upper_bound(block);
    if (after == pages.begin()) return false;
    auto& [begin, page] = *--after;
    const auto offset = static_cast<std::size_t>(block - begin);
    if (offset % stride != 0 || offset / stride >= blocks_a_page) return false;
    if (page.used[offset / stride] == used) return false;
    page.used[offset / stride] = used;
    return true;
  }
};

extern "C" {

miMemblk* mi_mem_blkcreate(int size) {
  if (size < 1 || static_cast<std::size_t>(size) > kMaxBlock) {
    mi_error("mi_mem_blkcreate: cannot create blocks of %d bytes", size);
    return nullptr;
  }
  return std::make_unique<miMemblk>(static_cast<std::size_t>(size)).release();
}

void mi_mem_blkdelete(miMemblk* arena) { const std::unique_ptr<miMemblk> gone(arena); }

void* mi_mem_blkallocate(miMemblk* arena) {
  void* block = nullptr;
  try {
    if (arena) block = arena->take();
  } catch (const std::bad_alloc&) {
  }
  if (!block) mi_fatal(arena ? "out of memory for a block" : "mi_mem_blkallocate: null arena");
  return block;
}

void mi_mem_blkrelease(miMemblk* arena, void* block) {
  if (arena && block) arena->give_back(block);
}

void mi_mem_blkclear(miMemblk* arena) {
  if (!arena) return;
  for (void* block : arena->in_use()) arena->give_back(block);
}

void mi_mem_blkenumerate(miMemblk* arena, void (*callback)(void* block, void* arg), void* arg) {
  if (!arena || !callback) return;
  for (void* block : arena->in_use()) callback(block, arg);
}

// The allocator checks itself and aborts the program on errors.
miBoolean mi_mem_check(void) { return miTRUE; }

void mi_mem_summary(void) {
  const struct mallinfo2 all = mallinfo2();
  mi_info("memory in use: %zu bytes in small pieces, %zu bytes in large ones", all.uordblks,
          all.hblkhd);
}

void mi_mem_dump(int /*module*/) { mi_mem_summary(); }

}  // extern "C"
