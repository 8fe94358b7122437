// SPDX-License-Identifier: Apache-2.0
// The module oriel_mpi: messages of any size by MPI.
//
// Model:   a message is a header and the data in segments, since MPI counts in int. Nothing blocks
//          while a message is on its way: MPI waits for the other side without sleeping.
#include "mpi/interface.h"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <list>
#include <memory>
#include <vector>

namespace {

constexpr int kHeaderTag = 1, kDataTag = 2;
constexpr std::uint64_t kSegment = std::uint64_t{1} << 30;

struct Header {
  std::int64_t kind;
  std::uint64_t size;
};

/// A message until it is delivered.
struct Sending {
  Header header;
  std::vector<MPI_Request> requests;
  void (*release)(void*);
  void* owner;
};

/// A message that was found, whose data is not received yet.
struct Found {
  int from = 0;
  std::uint64_t size = 0;
};

/// A message whose data is being received.
struct Receiving {
  std::vector<MPI_Request> requests;
};

Found& found_message() {
  static Found message;
  return message;
}

std::list<Sending>& sending() {
  static std::list<Sending> all;
  return all;
}

int begin(int* rank, int* ranks) {
  int level = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level) != MPI_SUCCESS ||
      level < MPI_THREAD_SERIALIZED)
    return 0;
  MPI_Comm_rank(MPI_COMM_WORLD, rank);
  MPI_Comm_size(MPI_COMM_WORLD, ranks);
  return 1;
}

void send(int to, int kind, const void* data, std::uint64_t size, void (*release)(void*),
          void* owner) {
  Sending& message = sending().emplace_back();
  message.header = {kind, size};
  message.release = release;
  message.owner = owner;
  const auto start = [&](const void* bytes, std::uint64_t count, int tag) {
    MPI_Request& request = message.requests.emplace_back();
    MPI_Isend(bytes, static_cast<int>(count), MPI_BYTE, to, tag, MPI_COMM_WORLD, &request);
  };
  message.requests.reserve(2 + size / kSegment);
  start(&message.header, sizeof message.header, kHeaderTag);
  for (std::uint64_t at = 0; at < size; at += kSegment)
    start(static_cast<const char*>(data) + at, std::min(kSegment, size - at), kDataTag);
}

int is_sending() {
  sending().remove_if([](Sending& message) {
    int done = 0;
    MPI_Testall(static_cast<int>(message.requests.size()), message.requests.data(), &done,
                MPI_STATUSES_IGNORE);
    if (done != 0) message.release(message.owner);
    return done != 0;
  });
  return sending().empty() ? 0 : 1;
}

int find(int* from, int* kind, std::uint64_t* size) {
  is_sending();
  int found = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, kHeaderTag, MPI_COMM_WORLD, &found, &status);
  if (found == 0) return 0;
  Header header{};
  MPI_Recv(&header, sizeof header, MPI_BYTE, status.MPI_SOURCE, kHeaderTag, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  found_message() = {status.MPI_SOURCE, header.size};
  *from = status.MPI_SOURCE;
  *kind = static_cast<int>(header.kind);
  *size = header.size;
  return 1;
}

void* begin_receive(void* data) {
  const Found message = found_message();
  auto receiving = std::make_unique<Receiving>();
  for (std::uint64_t at = 0; at < message.size; at += kSegment)
    MPI_Irecv(static_cast<char*>(data) + at,
              static_cast<int>(std::min(kSegment, message.size - at)), MPI_BYTE, message.from,
              kDataTag, MPI_COMM_WORLD, &receiving->requests.emplace_back());
  return receiving.release();
}

int is_received(void* handle) {
  auto* receiving = static_cast<Receiving*>(handle);
  int done = 0;
  MPI_Testall(static_cast<int>(receiving->requests.size()), receiving->requests.data(), &done,
              MPI_STATUSES_IGNORE);
  if (done != 0) std::unique_ptr<Receiving>(receiving).reset();
  return done;
}

void end() { MPI_Finalize(); }

void abort_job(int exit_code) { MPI_Abort(MPI_COMM_WORLD, exit_code); }

}  // namespace

const OrielMpi* oriel_mpi() {
  static const OrielMpi functions = {ORIEL_MPI_VERSION, begin,       send, is_sending, find,
                                     begin_receive,     is_received, end,  abort_job};
  return &functions;
}
