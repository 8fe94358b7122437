// SPDX-License-Identifier: Apache-2.0
// How does a shader keep many blocks of one size, and what does it learn about memory?
#ifndef ORIEL_SDK_MEMORY_BLOCKS_H
#define ORIEL_SDK_MEMORY_BLOCKS_H

// Conventions
//   Blocks are filled with zeros. An arena may be used by several threads at once.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Blocks of one size; opaque.
typedef struct miMemblk miMemblk;

/// A new arena of blocks of so many bytes, 1 to 1048576; NULL: not possible.
miMemblk* mi_mem_blkcreate(int size);
/// Ends an arena and all its blocks.
void mi_mem_blkdelete(miMemblk* arena);
/// A block; never NULL, the rendering ends instead.
void* mi_mem_blkallocate(miMemblk* arena);
/// Gives a block back; what is no block of the arena is ignored.
void mi_mem_blkrelease(miMemblk* arena, void* block);
/// Gives all blocks back; the arena stays.
void mi_mem_blkclear(miMemblk* arena);
/// Calls back for each block that is in use, in no certain order.
void mi_mem_blkenumerate(miMemblk* arena, void (*callback)(void* block, void* arg), void* arg);
/// Whether memory is in order, as far as Oriel can know: miTRUE.
miBoolean mi_mem_check(void);
/// Tells how much memory the program uses.
void mi_mem_summary(void);
/// As mi_mem_summary; memory is not counted by module.
void mi_mem_dump(int module);
/// Bytes of memory from mi_mem_allocate or its kin, at least those asked for; 0 for NULL.
size_t mi_mem_getsize(const void* memory);

#ifdef __cplusplus
}
#endif

#endif
