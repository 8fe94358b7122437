// SPDX-License-Identifier: Apache-2.0
// The processes that render one picture together, connected by MPI.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
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
  void wait();
  void reset() { next_ = kShortest; }

 private:
  static constexpr std::chrono::milliseconds kShortest{1}, kLongest{16};
  std::chrono::milliseconds next_ = kShortest;
};

/// Work of a rank.
struct RankWork {
  double useful_seconds = 0;  ///< CPU time of maps, samples and pictures, as in one process
  double start_seconds = 0;   ///< CPU time of the process before its first sample
  double seconds = 0;         ///< CPU time of the process
  std::uint64_t memory = 0;   ///< bytes at most
};

/// Processor time of this process so far.
double process_seconds();

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
  /// Messages that receive() returns first.
  void put_back(std::deque<RankMessage> messages);
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
  Ranks() = default;
  void greet();

  const OrielMpi* mpi_ = nullptr;
  int rank_ = 0, count_ = 1;
  std::vector<int> threads_;
  std::deque<RankMessage> waiting_;
  RankWork work_;
  bool finished_ = false;
};

/// Counts the processor time of a block as useful work of a rank. Inputs:  ranks: may be null.
class UsefulWork {
 public:
  explicit UsefulWork(Ranks* ranks) : ranks_(ranks), begin_(ranks ? process_seconds() : 0) {}
  ~UsefulWork() {
    if (ranks_) ranks_->add_useful_seconds(process_seconds() - begin_);
  }
  UsefulWork(const UsefulWork&) = delete;
  UsefulWork& operator=(const UsefulWork&) = delete;

 private:
  Ranks* ranks_;
  double begin_;
};

}  // namespace oriel::app
