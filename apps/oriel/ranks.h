// SPDX-License-Identifier: Apache-2.0
// The processes that render one picture together, connected by MPI.
#pragma once

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

struct OrielMpi;

namespace oriel::app {

/// Messages between ranks.
enum class MessageKind : int { Hello, Word, Tiles, Done, Interrupted, EndOfPicture };

struct RankMessage {
  int from = 0;
  MessageKind kind{};
  std::string bytes;
};

/// Pauses between looks for messages, longer the longer none comes: a look uses some microseconds
/// of the processor.
class LookPause {
 public:
  static constexpr std::chrono::milliseconds kShortest{2}, kLongest{32};
  std::chrono::milliseconds next(std::chrono::milliseconds longest = kLongest) {
    const auto pause = std::min(next_, longest);
    next_ = 2 * pause;
    return pause;
  }
  void wait() { std::this_thread::sleep_for(next()); }
  void reset() { next_ = kShortest; }

 private:
  std::chrono::milliseconds next_ = kShortest;
};

/// Work of a rank.
struct RankWork {
  double useful_seconds = 0;  ///< CPU time of maps, samples and pictures, as in one process
  double start_seconds = 0;   ///< CPU time of the process before its first sample
  double seconds = 0;         ///< CPU time of the process
  std::uint64_t memory = 0;   ///< bytes at most
};

/// Processor time so far: CLOCK_PROCESS_CPUTIME_ID of this process, CLOCK_THREAD_CPUTIME_ID of this
/// thread.
double cpu_seconds(clockid_t clock = CLOCK_PROCESS_CPUTIME_ID);

/// The ranks of this job. Rank 0 leads: it reads and writes all files of the render.
///
/// Model:   waiting processes sleep between looks for messages, since MPI would use the processor.
/// Errors:  UserError if processes differ in program or version. If the object is destroyed before
///          finish(), all processes of the job end with status 1.
/// Checked: Mpi.* in tests/faults
class Ranks {
 public:
  /// Joins the job. Null if this process is not one of several of a job.
  /// Errors:  UserError if it is, and cannot join.
  static std::unique_ptr<Ranks> join();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }
  bool leads() const { return rank_ == 0; }
  /// Threads of a rank that renders for rank 0.
  int threads_of(int rank) const { return threads_[static_cast<std::size_t>(rank)]; }

  void send(int to, MessageKind kind, std::string bytes);
  /// Waits until all messages are delivered.
  void flush();
  std::optional<RankMessage> receive();
  /// Whether messages are on their way to or from this rank.
  bool is_busy();
  /// Waits for a message.
  RankMessage wait();
  /// The words of rank 0, in every rank.
  std::string from_leader(std::string words);
  bool from_leader(bool decision) { return from_leader(std::string(decision ? "1" : "0")) == "1"; }
  /// In rank 0 the words of all ranks, in order of ranks; elsewhere nothing.
  std::vector<std::string> to_leader(const std::string& words);
  /// Notes that this rank is ready to draw samples.
  void end_start();
  /// Adds to the work of this rank.
  void add_useful_seconds(double seconds) { work_.useful_seconds += seconds; }

  /// Leaves the job at the end of the render. Returns the work of all ranks in rank 0.
  std::vector<RankWork> finish();

 private:
  using SharedBytes = std::shared_ptr<const std::string>;

  Ranks() = default;
  void greet();
  void begin_send(int to, MessageKind kind, SharedBytes bytes);

  const OrielMpi* mpi_ = nullptr;
  int rank_ = 0, count_ = 1;
  std::vector<int> threads_;
  struct Arriving {
    RankMessage message;
    void* handle;
  };
  std::list<Arriving> arriving_;  ///< in the order of their headers
  RankWork work_;
  bool finished_ = false;
};

/// Counts the processor time of a block as useful work of a rank. Inputs:  ranks: may be null.
class UsefulWork {
 public:
  explicit UsefulWork(Ranks* ranks) : ranks_(ranks), begin_(ranks ? cpu_seconds() : 0) {}
  ~UsefulWork() {
    if (ranks_) ranks_->add_useful_seconds(cpu_seconds() - begin_);
  }
  UsefulWork(const UsefulWork&) = delete;
  UsefulWork& operator=(const UsefulWork&) = delete;

 private:
  Ranks* ranks_;
  double begin_;
};

}  // namespace oriel::app
