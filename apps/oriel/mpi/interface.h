/* SPDX-License-Identifier: Apache-2.0 */
/* The functions of the module oriel_mpi, which alone links to MPI. */
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Changes with this interface; the program refuses other versions. */
#define ORIEL_MPI_VERSION 1u

/** All functions are called by one thread at a time. */
struct OrielMpi {
  uint32_t version;
  /** Joins the processes of the job. Returns 0 if this fails. */
  int (*begin)(int* rank, int* ranks);
  /** Starts to send a message; the data is copied. */
  void (*send)(int to, int kind, const void* data, uint64_t size);
  /** Whether messages of send() are not delivered yet; continues their delivery. */
  int (*is_sending)(void);
  /** Receives a message if there is one; the data is valid until the next call. Returns 0 if there
      is none. */
  int (*receive)(int* from, int* kind, const void** data, uint64_t* size);
  /** Leaves the job together with all other processes. */
  void (*end)(void);
  /** Ends the processes of the job. */
  void (*abort)(int exit_code);
};

/** The only symbol of the module. */
const struct OrielMpi* oriel_mpi(void);

#ifdef __cplusplus
}
#endif
