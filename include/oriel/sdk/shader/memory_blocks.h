// SPDX-License-Identifier: Apache-2.0
// Arenas of equally sized blocks, and memory statistics.
#ifndef ORIEL_SDK_MEMORY_BLOCKS_H
#define ORIEL_SDK_MEMORY_BLOCKS_H

// Conventions
//   Blocks are zeroed. Arenas are thread-safe.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// An arena; opaque.
typedef struct miMemblk miMemblk;

/// Creates an arena of blocks with a size of 1 to 1048576 bytes; NULL on failure.
miMemblk* mi_mem_blkcreate(int size);
/// Deletes an arena and all of its blocks.
void mi_mem_blkdelete(miMemblk* arena);
/// Allocates a block; never NULL, on failure the rendering ends.
void* mi_mem_blkallocate(miMemblk* arena);
/// Frees a block; pointers that are not blocks of the arena are ignored.
void mi_mem_blkrelease(miMemblk* arena, void* block);
/// Frees all blocks; the arena can be used again.
void mi_mem_blkclear(miMemblk* arena);
/// Calls back for each allocated block, in any order.
void mi_mem_blkenumerate(miMemblk* arena, void (*callback)(void* block, void* arg), void* arg);
/// Checks the heap, as far as possible: always miTRUE.
miBoolean mi_mem_check(void);
/// Reports the memory usage of the program.
void mi_mem_summary(void);
/// Like mi_mem_summary; memory is not counted per module.
void mi_mem_dump(int module);
/// Size of memory from mi_mem_allocate and similar functions, at least the requested size; 0 for
/// NULL.
size_t mi_mem_getsize(const void* memory);

#ifdef __cplusplus
}
#endif

#endif
