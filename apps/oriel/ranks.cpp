// SPDX-License-Identifier: Apache-2.0
#include "ranks.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "base/byte_stream.h"
#include "checkpoint_labels.h"
#include "command.h"
#include "mpi/interface.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

/// Bytes of messages that are received at the same time, unless one is larger.
constexpr std::uint64_t kMostArriving = std::uint64_t{64} << 20;

int number_in_environment(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : 0;
}

/// Processes of the job; 0 if this is none of a job that MPI knows.
int processes_of_job() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const int count = number_in_environment(name); count > 0) return count;
  // PMIx names no size; under srun it is that of the step.
  if (std::getenv("PMIX_RANK")) return std::max(number_in_environment("SLURM_STEP_NUM_TASKS"), 1);
  return 0;
}

/// srun without a plugin for MPI starts processes that do not know of each other.
void require_known_step() {
  const int tasks = number_in_environment("SLURM_STEP_NUM_TASKS");
  if (tasks > 1)
    throw UserError(
        fmt::format("srun started {} processes that would each render the whole picture; start "
                    "them with srun --mpi=pmix, or one process with srun -n 1",
                    tasks));
}

const OrielMpi* load_module() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::string reason = "it is not installed";
  for (const fs::path& folder : {program, program.parent_path() / "lib" / "oriel"}) {
    const fs::path file = folder / "oriel_mpi.so";
    if (!fs::exists(file, error)) continue;
    // Global: Open MPI loads plugins that need its symbols.
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (!library) {
      reason = dlerror();
      continue;
    }
    const auto get = reinterpret_cast<const OrielMpi* (*)()>(dlsym(library, "oriel_mpi"));
    if (get && get()->version == ORIEL_MPI_VERSION) return get();
    reason = fmt::format("'{}' belongs to another version", file.string());
  }
  throw UserError(fmt::format(
      "this process is one of several of an MPI job, and the module oriel_mpi.so cannot be used: "
      "{}; start one process, or build Oriel with libopenmpi-dev",
      reason));
}

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown host";
}

}  // namespace

double cpu_seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

std::unique_ptr<Ranks> Ranks::join() {
  const int processes = processes_of_job();
  if (processes == 0) require_known_step();
  if (processes <= 1) return nullptr;
  std::unique_ptr<Ranks> ranks(new Ranks);
  ranks->finished_ = true;  // until there is a job to leave
  const OrielMpi* mpi = load_module();
  if (!mpi->begin(&ranks->rank_, &ranks->count_))
    throw UserError("MPI cannot be started with several threads");
  ranks->mpi_ = mpi;
  ranks->finished_ = false;
  if (ranks->count_ != processes)
    throw UserError(
        fmt::format("the job has {} processes, of which MPI knows {}; start them with "
                    "mpirun or srun --mpi=pmix",
                    processes, ranks->count_));
  try {
    ranks->greet();
  } catch (const UserError& e) {
    // Before the job ends, and with it this process.
    fmt::print(stderr, "oriel: {}\n", e.what());
    mpi->abort(kExitFailed);
    throw;
  }
  return ranks;
}

void Ranks::greet() {
  const int threads = tbb::this_task_arena::max_concurrency();
  const std::vector<std::string> programs = to_leader(program_label());
  const std::vector<std::string> hosts = to_leader(host_name());
  const std::vector<std::string> sizes = to_leader(std::to_string(threads));
  for (std::size_t i = 0; i < programs.size(); ++i) {
    if (programs[i] != programs[0])
      throw UserError(fmt::format("rank {} on {} is {}, and rank 0 on {} is {}", i, hosts[i],
                                  shown_label(programs[i]), hosts[0], programs[0]));
    threads_.push_back(std::max(std::atoi(sizes[i].c_str()), 1));
  }
}

Ranks::~Ranks() {
  if (!finished_) mpi_->abort(kExitFailed);
}

void Ranks::send(int to, MessageKind kind, std::string bytes) {
  begin_send(to, kind, std::make_shared<const std::string>(std::move(bytes)));
}

void Ranks::begin_send(int to, MessageKind kind, SharedBytes bytes) {
  auto owner = std::make_unique<SharedBytes>(std::move(bytes));
  const std::string& data = **owner;
  const auto release = [](void* delivered) {
    const std::unique_ptr<SharedBytes> ends(static_cast<SharedBytes*>(delivered));
  };
  mpi_->send(to, static_cast<int>(kind), data.data(), data.size(), release, owner.release());
}

void Ranks::flush() {
  while (mpi_->is_sending()) LookPause().wait();
}

bool Ranks::is_busy() { return mpi_->is_sending() != 0 || !arriving_.empty(); }

std::optional<RankMessage> Ranks::receive() {
  RankMessage found;
  int kind = 0;
  std::uint64_t size = 0, bytes = 0;
  for (const Arriving& a : arriving_) bytes += a.message.bytes.size();
  for (; bytes < kMostArriving && mpi_->find(&found.from, &kind, &size) != 0; bytes += size) {
    RankMessage& message = arriving_.emplace_back().message;
    message.from = found.from;
    message.kind = static_cast<MessageKind>(kind);
    message.bytes.resize(size);
    arriving_.back().handle = mpi_->begin_receive(message.bytes.data());
  }
  // No message overtakes one of the same rank.
  std::set<int> late;
  for (auto i = arriving_.begin(); i != arriving_.end(); ++i) {
    if (late.contains(i->message.from)) continue;
    if (mpi_->is_received(i->handle) != 0) {
      RankMessage message = std::move(i->message);
      arriving_.erase(i);
      return message;
    }
    late.insert(i->message.from);
  }
  return std::nullopt;
}

RankMessage Ranks::wait() {
  LookPause pause;
  while (true) {
    if (auto message = receive()) return std::move(*message);
    if (is_busy()) pause.reset();
    pause.wait();
  }
}

std::string Ranks::from_leader(std::string words) {
  if (leads()) {
    const auto shared = std::make_shared<const std::string>(words);
    for (int to = 1; to < count_; ++to) begin_send(to, MessageKind::Word, shared);
    return words;
  }
  while (true) {
    RankMessage message = wait();
    if (message.kind == MessageKind::Word) return std::move(message.bytes);
  }
}

std::vector<std::string> Ranks::to_leader(const std::string& words) {
  if (!leads()) {
    send(0, MessageKind::Hello, words);
    flush();
    from_leader(std::string());  // so that the next words do not overtake these
    return {};
  }
  std::vector<std::string> all(static_cast<std::size_t>(count_));
  all[0] = words;
  for (int missing = count_ - 1; missing > 0;) {
    RankMessage message = wait();
    if (message.kind != MessageKind::Hello) continue;  // of the picture before
    all[static_cast<std::size_t>(message.from)] = std::move(message.bytes);
    --missing;
  }
  from_leader(std::string());
  return all;
}

void Ranks::end_start() {
  if (work_.start_seconds == 0) work_.start_seconds = cpu_seconds();
}

std::vector<RankWork> Ranks::finish() {
  work_.seconds = cpu_seconds();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  work_.memory = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
  ByteWriter own;
  own.value(work_.useful_seconds);
  own.value(work_.start_seconds);
  own.value(work_.seconds);
  own.value(work_.memory);
  std::vector<RankWork> all;
  for (const std::string& bytes : to_leader(own.take())) {
    ByteReader in(bytes);
    RankWork& work = all.emplace_back();
    in.value(work.useful_seconds);
    in.value(work.start_seconds);
    in.value(work.seconds);
    in.value(work.memory);
  }
  flush();
  mpi_->end();
  finished_ = true;
  return all;
}

}  // namespace oriel::app
