// SPDX-License-Identifier: Apache-2.0
// Arenas of blocks of one size, and what shaders learn about memory.
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

constexpr std::size_t kMostBlock = std::size_t{1} << 20;
constexpr std::size_t kPage = std::size_t{1} << 16;

}  // namespace

struct miMemblk {
  explicit miMemblk(std::size_t wanted)
      : stride((wanted + alignof(std::max_align_t) - 1) / alignof(std::max_align_t) *
               alignof(std::max_align_t)),
        blocks_a_page(std::max<std::size_t>(kPage / stride, 1)) {}

  /// Many blocks in one piece of memory.
  struct Page {
    std::unique_ptr<std::byte[]> bytes;
    std::vector<bool> used;
  };
  const std::size_t stride;
  const std::size_t blocks_a_page;
  std::mutex mutex;
  std::map<const std::byte*, Page> pages;  ///< by where they begin
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
    free.reserve((pages.size() + 1) * blocks_a_page);  // so that giving back needs no memory
    pages.emplace(begin, std::move(page));
    for (std::size_t i = blocks_a_page; i-- > 0;) free.push_back(begin + i * stride);
  }

  /// False: that is no block, or it is marked so already.
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
  if (size < 1 || static_cast<std::size_t>(size) > kMostBlock) {
    mi_error("mi_mem_blkcreate: no blocks of %d bytes can be made", size);
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
  if (!block) mi_fatal(arena ? "no memory for a block" : "mi_mem_blkallocate: there is no arena");
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

// The allocator checks itself, and ends the program where it finds a fault.
miBoolean mi_mem_check(void) { return miTRUE; }

void mi_mem_summary(void) {
  const struct mallinfo2 all = mallinfo2();
  mi_info("memory in use: %zu bytes in small pieces, %zu bytes in large ones", all.uordblks,
          all.hblkhd);
}

void mi_mem_dump(int /*module*/) { mi_mem_summary(); }

}  // extern "C"
