/* SPDX-License-Identifier: Apache-2.0 */
/* Memory, locks, messages. */
#include "coverage.h"

static int zero(const char* bytes, size_t n) {
  size_t i;
  for (i = 0; i < n; i++)
    if (bytes[i] != 0) return 0;
  return 1;
}

static void memory(void) {
  char* text;
  char* p = mi_mem_allocate(1000);
  COVER(mi_mem_allocate, p && zero(p, 1000));
  COVER(mi_mem_int_allocate, p && zero(p, 1000));
  memset(p, 7, 1000);
  p = mi_mem_reallocate(p, 5000);
  COVER(mi_mem_reallocate, p && p[999] == 7 && zero(p + 1000, 4000));
  COVER(mi_mem_int_reallocate, p && p[0] == 7 && zero(p + 1000, 4000));
  p = mi_mem_test_reallocate(p, 9000);
  COVER(mi_mem_test_reallocate, p && p[0] == 7 && zero(p + 5000, 4000));
  COVER(mi_mem_int_test_reallocate, p && p[999] == 7);
  COVER(mi_mem_int_test_reallocate, !mi_mem_test_reallocate(p, (size_t)-1) && p[0] == 7);
  mi_mem_release(p);
  mi_mem_release(NULL);
  COVER(mi_mem_release, 1);
  COVER(mi_mem_int_release, 1);
  p = mi_mem_test_allocate(16);
  COVER(mi_mem_test_allocate, p && zero(p, 16));
  COVER(mi_mem_int_test_allocate, p && !mi_mem_test_allocate((size_t)-1));
  mi_mem_release(p);
  text = mi_mem_strdup("a name");
  COVER(mi_mem_strdup, strcmp(text, "a name") == 0);
  COVER(mi_mem_int_strdup, strcmp(text, "a name") == 0);
  mi_mem_release(text);
}

static void locks(miState* state) {
  miLock lock;
  mi_init_lock(&lock);
  COVER(mi_init_lock, lock.p != NULL);
  COVER(mi_trylock, mi_trylock(lock));
  COVER(mi_trylock, !mi_trylock(lock));
  mi_unlock(lock);
  COVER(mi_unlock, mi_trylock(lock));
  mi_unlock(lock);
  mi_lock(lock);
  COVER(mi_lock, !mi_trylock(lock));
  mi_unlock(lock);
  mi_delete_lock(&lock);
  COVER(mi_delete_lock, lock.p == NULL);
  mi_lock(state->global_lock);
  COVER(mi_lock, !mi_trylock(state->global_lock));
  mi_unlock(state->global_lock);
}

static void messages(void) {
  char name[32], cut[6];
  /* What they say is looked for where the program says it. */
  mi_error("covered: %s", "mi_error");
  mi_warning("covered: %s", "mi_warning");
  mi_info("covered: %s", "mi_info");
  mi_progress("covered: %s", "mi_progress");
  mi_debug("covered: %s", "mi_debug");
  mi_vdebug("covered: %s", "mi_vdebug");
  mi_nerror(17, "covered: %s", "mi_nerror");
  mi_nwarning(18, "covered: %s", "mi_nwarning");
  COVER(mi_par_aborted, mi_par_aborted() == 0);
  COVER(mi_string_substitute, mi_string_substitute(name, "$NO_SUCH_VARIABLE\\a\\b", 32) == name);
  COVER(mi_string_substitute, strcmp(name, "/a/b") == 0);
  mi_string_substitute(cut, "too long", 6);
  COVER(mi_string_substitute, strcmp(cut, "too l") == 0);
}

DLLEXPORT miBoolean cover_memory(miColor* result, miState* state, void* paras) {
  static int told = 0;
  memory();
  locks(state);
  if (!told) messages();
  told = 1;
  *result = paint(0, 1, 0);
  return miTRUE;
}
