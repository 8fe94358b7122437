/* SPDX-License-Identifier: Apache-2.0 */
/* The functions of the module oriel_mpi, which alone links to MPI. */
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Changes with this interface; the program refuses other versions. */
#define ORIEL_MPI_VERSION 2u

/** All functions are called by one thread at a time. */
struct OrielMpi {
  uint32_t version;
  /** Joins the processes of the job. Returns 0 if this fails. */
  int (*begin)(int* rank, int* ranks);
  /** Starts to send a message. `release(owner)` is called when the data is not needed any more. */
  void (*send)(int to, int kind, const void* data, uint64_t size, void (*release)(void*),
               void* owner);
  /** Whether messages of send() are not delivered yet; continues their delivery. */
  int (*is_sending)(void);
  /** Whether there is a new message, which begin_receive() then has to receive. */
  int (*find)(int* from, int* kind, uint64_t* size);
  /** Starts to receive the data of the message that find() found. Returns a handle. */
  void* (*begin_receive)(void* data);
  /** Whether the data is complete, after which the handle is invalid; continues the receipt. */
  int (*is_received)(void* handle);
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
