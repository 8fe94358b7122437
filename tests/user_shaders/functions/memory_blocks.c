/* SPDX-License-Identifier: Apache-2.0 */
/* Blocks of one size. */
#include "coverage.h"

static void count_block(void* block, void* sum) { *(int*)sum += *(int*)block; }

static void blocks(void) {
  miMemblk* arena = mi_mem_blkcreate(20);
  int *first, *second, i, sum = 0, apart = 1;
  char outside = 0;

  COVER(mi_mem_blkcreate, arena && !mi_mem_blkcreate(0));
  if (!arena) return;
  first = mi_mem_blkallocate(arena);
  COVER(mi_mem_blkallocate, first && first[0] == 0 && first[4] == 0);
  for (i = 0; i < 10000; i++) {
    int* block = mi_mem_blkallocate(arena);
    if (block == first || block[4] != 0) apart = 0;
    block[0] = i;
    block[4] = -1;
  }
  COVER(mi_mem_blkallocate, apart);
  mi_mem_blkenumerate(arena, count_block, &sum);
  COVER(mi_mem_blkenumerate, sum == 10000 / 2 * 9999);
  first[0] = 7;
  mi_mem_blkrelease(arena, first);
  mi_mem_blkrelease(arena, first);    /* twice */
  mi_mem_blkrelease(arena, &outside); /* not its own */
  sum = 0;
  mi_mem_blkenumerate(arena, count_block, &sum);
  second = mi_mem_blkallocate(arena);
  COVER(mi_mem_blkrelease, sum == 10000 / 2 * 9999 && second == first && second[0] == 0 &&
                               mi_mem_blkallocate(arena) != (void*)second);
  mi_mem_blkclear(arena);
  sum = 0;
  mi_mem_blkenumerate(arena, count_block, &sum);
  second = mi_mem_blkallocate(arena);
  COVER(mi_mem_blkclear, sum == 0 && second && second[0] == 0 && second[4] == 0);
  mi_mem_blkdelete(arena);
  mi_mem_blkdelete(NULL);
  COVER(mi_mem_blkdelete, 1);
}

DLLEXPORT miBoolean cover_memory_blocks(miColor* result, miState* state, void* paras) {
  static int told = 0;
  void* memory = mi_mem_allocate(1000);
  const size_t size = mi_mem_getsize(memory);
  COVER(mi_mem_getsize, size >= 1000 && size < 1100 && mi_mem_getsize(NULL) == 0);
  mi_mem_release(memory);
  COVER(mi_mem_check, mi_mem_check());
  if (!told) {
    blocks();
    /* What they say is looked for where the program says it. */
    mi_mem_summary();
    mi_mem_dump(0);
  }
  told = 1;
  *result = paint(0, 1, 0);
  return miTRUE;
}
