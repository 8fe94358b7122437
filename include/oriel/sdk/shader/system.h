// SPDX-License-Identifier: Apache-2.0
// How does a shader get memory and locks, and tell something?
#ifndef ORIEL_SDK_SYSTEM_H
#define ORIEL_SDK_SYSTEM_H

// Conventions
//   Memory is filled with zeros. Messages are printf-like and go to the renderer's diagnostics.

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Behind mi_mem_allocate.
void* mi_mem_int_allocate(const char* file, int line, size_t size);
/// Behind mi_mem_test_allocate.
void* mi_mem_int_test_allocate(const char* file, int line, size_t size);
/// Behind mi_mem_reallocate.
void* mi_mem_int_reallocate(const char* file, int line, void* memory, size_t size);
/// Behind mi_mem_test_reallocate.
void* mi_mem_int_test_reallocate(const char* file, int line, void* memory, size_t size);
/// Behind mi_mem_release.
void mi_mem_int_release(const char* file, int line, void* memory);
/// Behind mi_mem_strdup.
char* mi_mem_int_strdup(const char* file, int line, const char* text);

/// n bytes of 0; never NULL, the rendering ends instead.
#define mi_mem_allocate(n) mi_mem_int_allocate(__FILE__, __LINE__, (size_t)(n))
/// n bytes of 0, or NULL.
#define mi_mem_test_allocate(n) mi_mem_int_test_allocate(__FILE__, __LINE__, (size_t)(n))
/// Memory p as n bytes, moved if need be; p may be NULL.
#define mi_mem_reallocate(p, n) mi_mem_int_reallocate(__FILE__, __LINE__, (p), (size_t)(n))
/// As mi_mem_reallocate; NULL, and p as it was, when there is none.
#define mi_mem_test_reallocate(p, n) \
  mi_mem_int_test_reallocate(__FILE__, __LINE__, (p), (size_t)(n))
/// Gives memory back; NULL is nothing.
#define mi_mem_release(p) mi_mem_int_release(__FILE__, __LINE__, (p))
/// A copy of a text, as the geometry API takes over.
#define mi_mem_strdup(s) mi_mem_int_strdup(__FILE__, __LINE__, (s))

/// Makes a lock.
void mi_init_lock(miLock* lock);
/// Ends a lock.
void mi_delete_lock(miLock* lock);
/// Waits for a lock and takes it.
void mi_lock(miLock lock);
/// Gives a lock back.
void mi_unlock(miLock lock);
/// Takes a lock if it is free; whether it did.
miBoolean mi_trylock(miLock lock);

/// Tells an error and ends the rendering.
void mi_fatal(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Tells an error.
void mi_error(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Tells a warning.
void mi_warning(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Tells something.
void mi_info(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Tells how far something is.
void mi_progress(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Tells something for finding faults.
void mi_debug(const char* format, ...) ORIEL_PRINTF(1, 2);
/// Tells even more for finding faults.
void mi_vdebug(const char* format, ...) ORIEL_PRINTF(1, 2);
/// As mi_fatal, with a number.
void mi_nfatal(int number, const char* format, ...) ORIEL_PRINTF(2, 3);
/// As mi_error, with a number.
void mi_nerror(int number, const char* format, ...) ORIEL_PRINTF(2, 3);
/// As mi_warning, with a number.
void mi_nwarning(int number, const char* format, ...) ORIEL_PRINTF(2, 3);
/// Whether the rendering was stopped: long loops ask and leave.
int mi_par_aborted(void);
/// Stops the rendering.
void mi_abort(void);
/// Copies src to dst of max bytes with the renderer's variables put in; dst.
char* mi_string_substitute(char* dst, const char* src, int max);

#ifdef __cplusplus
}
#endif

#endif
