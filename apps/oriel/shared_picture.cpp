// SPDX-License-Identifier: Apache-2.0
#include "shared_picture.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/byte_stream.h"
#include "base/file_text.h"
#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "checkpoint_labels.h"
#include "command.h"
#include "interrupt.h"
#include "render_frames.h"

namespace oriel::app {
namespace {

constexpr std::size_t kMaxPortion = 256, kPortionsOfRank = 2;

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

/// Tiles and their pixels, as messages carry them.
struct TilesMessage {
  std::int32_t picture = 0;
  std::vector<int> held;   ///< tiles whose pixels the receiver has: their targets are sent
  std::vector<int> tiles;  ///< other tiles
  RayCounts rays;
  std::string targets, pixels;

  std::string bytes() const {
    ByteWriter out;
    out.value(picture);
    out.list(held);
    out.list(tiles);
    visit_counts(out, rays);
    out.value(std::uint64_t{targets.size()});
    return out.take() + targets + pixels;
  }
};

/// Its beginning and its data, which refers to the message.
struct ReceivedTiles {
  TilesMessage head;
  std::string_view targets, pixels;
};

ReceivedTiles read_tiles(const std::string& bytes) {
  ReceivedTiles received;
  TilesMessage& head = received.head;
  ByteReader in(bytes);
  in.value(head.picture);
  in.list(head.held);
  in.list(head.tiles);
  visit_counts(in, head.rays);
  std::uint64_t targets = 0;
  in.value(targets);
  const std::string_view data = in.rest();
  received.targets = data.substr(0, static_cast<std::size_t>(targets));
  received.pixels = data.substr(received.targets.size());
  return received;
}

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
              -1) {}

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
  const std::size_t share = queue_.size() / (2 * static_cast<std::size_t>(ranks_.count()));
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
  TilesMessage message;
  message.picture = picture_;
  for (const int tile : portion)
    (holder_[static_cast<std::size_t>(tile)] == rank ? message.held : message.tiles)
        .push_back(tile);
  message.targets = session_.pack_targets(message.held);
  message.pixels = session_.pack_tiles(message.tiles);
  ranks_.send(rank, MessageKind::Tiles, message.bytes());
}

void TileLeader::take(const RankMessage& message) {
  // A signal that one rank got ends the render, as if rank 0 had got it.
  if (message.kind == MessageKind::Interrupted) interrupted() = true;
  if (message.kind != MessageKind::Done) return;
  const ReceivedTiles received = read_tiles(message.bytes);
  if (received.head.picture != picture_) return;  // one that ended before
  const std::vector<int>& tiles = received.head.tiles;
  std::vector<Portion>& away = away_[message.from];
  if (away.empty() ||
      !std::is_permutation(tiles.begin(), tiles.end(), away.front().begin(), away.front().end()))
    throw std::runtime_error("a rank sent other tiles");
  away.erase(away.begin());
  session_.add_tiles(tiles, received.pixels, received.head.rays);
  const std::lock_guard lock(mutex_);
  for (const int tile : tiles) holder_[static_cast<std::size_t>(tile)] = message.from;
}

void TileLeader::serve(const std::function<bool()>& stops) {
  LookPause pause;
  while (!stops()) {
    bool idle = true;
    while (const auto message = ranks_.receive()) take(*message), idle = false;
    bool waits = false;
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      std::vector<Portion>& away = away_[rank];
      while (away.size() < kPortionsOfRank) {
        Portion portion = next_portion(rank);
        if (portion.empty()) break;
        send(rank, portion);
        away.push_back(std::move(portion));
        idle = false;
      }
      waits |= !away.empty();
    }
    if (const std::lock_guard lock(mutex_); !waits && queue_.empty()) return;
    if (idle)
      pause.wait();
    else
      pause.reset();
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
  });
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  parallel_for(threads, [&](std::size_t) {
    const double begin = thread_seconds();
    while (!stops()) {
      const std::optional<int> tile = next_tile();
      if (!tile) break;
      render_tile(*tile);
    }
    const double used = thread_seconds() - begin;
    const std::lock_guard lock(mutex_);
    ranks_.add_useful_seconds(used);
  });
  server.join();
  if (failure) std::rethrow_exception(failure);
}

void TileLeader::end() {
  for (int rank = 1; rank < ranks_.count(); ++rank)
    ranks_.send(rank, MessageKind::EndOfPicture, {});
}

void serve_tiles(Ranks& ranks, RenderSession& session) {
  ranks.end_start();
  std::deque<RankMessage> waiting;
  while (true) {
    if (waiting.empty()) waiting.push_back(ranks.wait());
    while (auto message = ranks.receive()) waiting.push_back(std::move(*message));
    // The end of an interrupted picture overtakes its tiles.
    const auto end = std::find_if(waiting.begin(), waiting.end(), [](const RankMessage& m) {
      return m.kind == MessageKind::EndOfPicture;
    });
    if (end != waiting.end()) {
      waiting.erase(waiting.begin(), end + 1);
      return ranks.put_back(std::move(waiting));
    }
    const RankMessage message = std::move(waiting.front());
    waiting.pop_front();
    if (message.kind != MessageKind::Tiles) continue;
    const ReceivedTiles received = read_tiles(message.bytes);
    session.unpack_targets(received.head.held, received.targets);
    session.unpack_tiles(received.head.tiles, received.pixels);
    TilesMessage answer;
    answer.picture = received.head.picture;
    answer.tiles = received.head.held;
    answer.tiles.insert(answer.tiles.end(), received.head.tiles.begin(), received.head.tiles.end());
    {
      const UsefulWork work(&ranks);
      answer.rays = session.draw_tiles(answer.tiles, &interrupted());
    }
    if (interrupted()) {  // the tiles lack samples; rank 0 renders them again
      ranks.send(0, MessageKind::Interrupted, {});
      ranks.flush();
      continue;
    }
    answer.pixels = session.pack_tiles(answer.tiles);
    ranks.send(0, MessageKind::Done, answer.bytes());
    ranks.flush();
  }
}

}  // namespace oriel::app
