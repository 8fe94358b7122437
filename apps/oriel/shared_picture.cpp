// SPDX-License-Identifier: Apache-2.0
#include "shared_picture.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/byte_stream.h"
#include "base/checkpoint_file.h"
#include "base/file_text.h"
#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "checkpoint_labels.h"
#include "checkpoints.h"
#include "command.h"
#include "interrupt.h"
#include "render_frames.h"
#include "tile_messages.h"

namespace oriel::app {
namespace {

/// Of the tiles that are left, each rank gets one of kPortionsToTheEnd of its share: the last ones
/// of a rank of half the speed end about when those of the others do (bench/farm_tiles.py).
constexpr std::size_t kMaxPortion = 256, kPortionsOfRank = 2, kPortionsToTheEnd = 8;

}  // namespace

void require_same_session(Ranks& ranks, const RenderArguments& arguments,
                          const RenderSession& session) {
  const CheckpointLabels own =
      labels_of_picture(arguments.scene.path, option_labels(arguments), session);
  const std::vector<std::string> all = ranks.to_leader(
      nlohmann::json(own).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    const auto there = nlohmann::json::parse(all[rank]).get<CheckpointLabels>();
    const std::string difference = label_difference(there, own, false);
    if (!difference.empty())
      throw UserError(fmt::format("rank {} renders another picture: {}", rank, difference));
  }
}

namespace {

/// The ranks as processes that share the work of maps.
class RankShare final : public WorkShare {
 public:
  explicit RankShare(Ranks& ranks) : ranks_(ranks) {}

  bool leads() const override { return ranks_.leads(); }
  bool owns(std::size_t i) const override {
    return i % static_cast<std::size_t>(ranks_.count()) == static_cast<std::size_t>(ranks_.rank());
  }
  std::string from_leader(std::string bytes) override {
    return ranks_.from_leader(std::move(bytes));
  }
  std::vector<std::string> exchange(const std::string& own) override {
    // The last byte: whether the rank was interrupted, which ends the work in all of them.
    const std::vector<std::string> all = ranks_.to_leader(own + (interrupted() ? '1' : '0'));
    ByteWriter out;
    for (const std::string& bytes : all) out.list(std::vector<char>(bytes.begin(), bytes.end()));
    const std::string joined = ranks_.from_leader(out.take());
    std::vector<std::string> result;
    bool ends = false;
    for (ByteReader in(joined); !in.rest().empty();) {
      std::vector<char> bytes;
      in.list(bytes);
      ends |= bytes.empty() || bytes.back() == '1';
      result.emplace_back(bytes.begin(), bytes.empty() ? bytes.end() : bytes.end() - 1);
    }
    if (!ends) return result;
    interrupted() = true;
    return {};
  }

 private:
  Ranks& ranks_;
};

}  // namespace

TileLeader::TileLeader(Ranks& ranks, RenderSession& session, int picture)
    : ranks_(ranks),
      session_(session),
      picture_(picture),
      holder_(static_cast<std::size_t>(
                  TileGrid(session.film().width(), session.film().height()).count()),
              -1),
      begin_(cpu_seconds()) {}

bool share_maps(Ranks& ranks, RenderSession& session, const Progressive::Callbacks& callbacks,
                const std::atomic<bool>* cancel) {
  const TemporaryFolder folder;
  const std::string file = folder.file("maps");
  if (ranks.leads()) {
    const bool done = [&] {
      const UsefulWork work(&ranks);
      const bool saved = session.can_save();
      ranks.from_leader(std::string(saved ? "saved" : "maps"));
      if (saved) return true;
      RankShare share(ranks);
      return session.prepare(callbacks, cancel, &share);
    }();
    if (!ranks.from_leader(done)) return false;
    CheckpointWriter out(file, {});
    session.save_maps(out);
    out.commit();
    ranks.from_leader(file_text(file));
    return true;
  }
  if (ranks.from_leader(std::string()) == "maps") {
    const UsefulWork work(&ranks);
    RankShare share(ranks);
    session.help_prepare(share, &interrupted());
  }
  if (!ranks.from_leader(false)) return false;
  const std::string bytes = ranks.from_leader(std::string());
  std::ofstream(file, std::ios::binary) << bytes;
  CheckpointReader in(file);
  session.read_maps(in);
  return true;
}

bool TileLeader::is_away(int tile) const {
  return std::any_of(away_.begin(), away_.end(), [&](const auto& of_rank) {
    return std::any_of(of_rank.second.begin(), of_rank.second.end(), [&](const Portion& p) {
      return std::find(p.begin(), p.end(), tile) != p.end();
    });
  });
}

std::optional<int> TileLeader::next_tile() {
  const std::lock_guard lock(mutex_);
  if (queue_.empty()) return std::nullopt;
  // Tiles whose pixels another rank has are left to it.
  auto found = std::find_if(queue_.rbegin(), queue_.rend(),
                            [&](int tile) { return holder_[static_cast<std::size_t>(tile)] <= 0; });
  if (found == queue_.rend()) found = queue_.rbegin();
  const int tile = *found;
  queue_.erase(std::next(found).base());
  holder_[static_cast<std::size_t>(tile)] = 0;
  return tile;
}

TileLeader::Portion TileLeader::next_portion(int rank) {
  const std::lock_guard lock(mutex_);
  const std::size_t threads = static_cast<std::size_t>(ranks_.threads_of(rank));
  const std::size_t share =
      queue_.size() / (kPortionsToTheEnd * static_cast<std::size_t>(ranks_.count()));
  const std::size_t size =
      std::min(std::clamp(share, std::min(threads, kMaxPortion), kMaxPortion), queue_.size());
  Portion portion;
  // First the tiles whose pixels the rank has, then others.
  for (const bool held : {true, false})
    for (auto i = queue_.rbegin(); i != queue_.rend() && portion.size() < size; ++i)
      if ((holder_[static_cast<std::size_t>(*i)] == rank) == held) portion.push_back(*i);
  std::erase_if(queue_, [&](int tile) {
    return std::find(portion.begin(), portion.end(), tile) != portion.end();
  });
  return portion;
}

void TileLeader::send(int rank, const Portion& portion) {
  TilesHead head;
  head.picture = picture_;
  for (const int tile : portion)
    (holder_[static_cast<std::size_t>(tile)] == rank ? head.held : head.tiles).push_back(tile);
  ByteWriter out;
  head.visit(out);
  session_.pack_targets(out, head.held);
  session_.pack_tiles(out, head.tiles);
  ranks_.send(rank, MessageKind::Tiles, out.take());
}

void TileLeader::take(const RankMessage& message) {
  // A signal that one rank got ends the render, as if rank 0 had got it.
  if (message.kind == MessageKind::Interrupted) interrupted() = true;
  if (message.kind != MessageKind::Done) return;
  ByteReader in(message.bytes);
  TilesHead head;
  head.visit(in);
  if (head.picture != picture_) return;  // one that ended before
  const std::vector<int>& tiles = head.tiles;
  std::vector<Portion>& away = away_[message.from];
  const auto portion = std::find_if(away.begin(), away.end(), [&](const Portion& p) {
    return std::is_permutation(tiles.begin(), tiles.end(), p.begin(), p.end());
  });
  if (portion == away.end()) throw std::runtime_error("a rank sent other tiles");
  away.erase(portion);
  session_.add_tiles(in, tiles, head.rays);
  const std::lock_guard lock(mutex_);
  for (const int tile : tiles) holder_[static_cast<std::size_t>(tile)] = message.from;
}

void TileLeader::serve(const std::function<bool()>& stops) {
  LookPause pause;
  while (!stops()) {
    bool idle = true;
    while (const auto message = ranks_.receive()) take(*message), idle = false;
    // First those that have nothing to do: at the end of a pass there is not enough for all.
    for (std::size_t most = 1; most <= kPortionsOfRank; ++most)
      for (int rank = 1; rank < ranks_.count(); ++rank) {
        std::vector<Portion>& away = away_[rank];
        if (away.size() >= most) continue;
        Portion portion = next_portion(rank);
        if (portion.empty()) break;
        send(rank, portion);
        away.push_back(std::move(portion));
        idle = false;
      }
    const bool waits =
        std::any_of(away_.begin(), away_.end(), [](const auto& a) { return !a.second.empty(); });
    if (const std::lock_guard lock(mutex_); !waits && queue_.empty()) return;
    if (!idle || ranks_.is_busy()) pause.reset();
    if (idle) pause.wait();
  }
}

void TileLeader::spread(const std::vector<int>& tiles, const std::function<void(int)>& render_tile,
                        const std::function<bool()>& stops) {
  ranks_.end_start();
  queue_.clear();
  std::copy_if(tiles.rbegin(), tiles.rend(), std::back_inserter(queue_),
               [&](int tile) { return !is_away(tile); });
  std::exception_ptr failure;
  std::thread server([&] {
    try {
      serve(stops);
    } catch (...) {
      failure = std::current_exception();
    }
    message_seconds_ += cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
  });
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  parallel_for(threads, [&](std::size_t) {
    while (!stops()) {
      const std::optional<int> tile = next_tile();
      if (!tile) break;
      render_tile(*tile);
    }
  });
  server.join();
  if (failure) std::rethrow_exception(failure);
}

void TileLeader::end() {
  ranks_.add_useful_seconds(cpu_seconds() - begin_ - message_seconds_);
  for (int rank = 1; rank < ranks_.count(); ++rank)
    ranks_.send(rank, MessageKind::EndOfPicture, {});
}

}  // namespace oriel::app
