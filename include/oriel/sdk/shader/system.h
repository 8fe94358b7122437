// SPDX-License-Identifier: Apache-2.0
// Memory, locks and messages.
#ifndef ORIEL_SDK_SYSTEM_H
#define ORIEL_SDK_SYSTEM_H

// Conventions
//   Memory is zeroed. Messages are formatted like printf and passed to the renderer's diagnostics.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Used by mi_mem_allocate.
void* mi_mem_int_allocate(const char* file, int line, size_t size);
/// Used by mi_mem_test_allocate.
void* mi_mem_int_test_allocate(const char* file, int line, size_t size);
/// Used by mi_mem_reallocate.
void* mi_mem_int_reallocate(const char* file, int line, void* memory, size_t size);
/// Used by mi_mem_test_reallocate.
void* mi_mem_int_test_reallocate(const char* file, int line, void* memory, size_t size);
/// Used by mi_mem_release.
void mi_mem_int_release(const char* file, int line, void* memory);
/// Used by mi_mem_strdup.
char* mi_mem_int_strdup(const char* file, int line, const char* text);

/// Allocates n zeroed bytes; never NULL, on failure the rendering ends.
#define mi_mem_allocate(n) mi_mem_int_allocate(__FILE__, __LINE__, (size_t)(n))
/// Allocates n zeroed bytes; NULL on failure.
#define mi_mem_test_allocate(n) mi_mem_int_test_allocate(__FILE__, __LINE__, (size_t)(n))
/// Resizes memory p to n bytes, which may move it; p may be NULL.
#define mi_mem_reallocate(p, n) mi_mem_int_reallocate(__FILE__, __LINE__, (p), (size_t)(n))
/// Like mi_mem_reallocate; on failure returns NULL and leaves p unchanged.
#define mi_mem_test_reallocate(p, n) \
  mi_mem_int_test_reallocate(__FILE__, __LINE__, (p), (size_t)(n))
/// Frees memory; NULL is ignored.
#define mi_mem_release(p) mi_mem_int_release(__FILE__, __LINE__, (p))
/// A copy of a text, for functions that take ownership.
#define mi_mem_strdup(s) mi_mem_int_strdup(__FILE__, __LINE__, (s))

/// Creates a lock.
void mi_init_lock(miLock* lock);
/// Deletes a lock.
void mi_delete_lock(miLock* lock);
/// Acquires a lock; blocks until it is free.
void mi_lock(miLock lock);
/// Releases a lock.
void mi_unlock(miLock lock);
/// Acquires a lock if it is free; returns whether it did.
miBoolean mi_trylock(miLock lock);

/// Reports an error and ends the rendering.
void mi_fatal(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Reports an error.
void mi_error(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Reports a warning.
void mi_warning(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Reports information.
void mi_info(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Reports progress.
void mi_progress(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Reports debugging information.
void mi_debug(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Reports verbose debugging information.
void mi_vdebug(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Like mi_fatal, with a message number.
void mi_nfatal(int number, const char* format, ...) ORIEL_PRINTF(2, 3);
/// Like mi_error, with a message number.
void mi_nerror(int number, const char* format, ...) ORIEL_PRINTF(2, 3);
/// Like mi_warning, with a message number.
void mi_nwarning(int number, const char* format, ...) ORIEL_PRINTF(2, 3);
/// Whether the rendering was stopped; long loops should check this and return.
int mi_par_aborted(void);
/// Stops the rendering.
void mi_abort(void);
/// Copies src to dst of max bytes with variables substituted; returns dst.
char* mi_string_substitute(char* dst, const char* src, int max);

#ifdef __cplusplus
}
#endif

#endif
