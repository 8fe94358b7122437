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
#include "render_frames.h"

namespace oriel::app {
namespace {

constexpr std::size_t kMaxPortion = 256, kPortionsOfRank = 2;
constexpr std::chrono::milliseconds kBetweenMessages{1};

double cpu_seconds(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

template <class Stream, class Counts>
void visit_rays(Stream& stream, Counts& rays) {
  for (auto* count : {&rays.eye, &rays.reflect, &rays.refract, &rays.gather, &rays.shadow,
                      &rays.probe, &rays.environment})
    stream.value(*count);
}

/// A message with tiles and their pixels.
std::string tiles_message(std::int32_t picture, const std::vector<int>& tiles,
                          const std::string& pixels, const RayCounts& rays) {
  ByteWriter out;
  out.value(picture);
  out.list(tiles);
  visit_rays(out, rays);
  return out.take() + pixels;
}

/// Size of the part of that message before the pixels.
std::size_t head_of_message(std::size_t tiles) { return 4 + 8 + tiles * sizeof(int) + 7 * 8; }

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

bool share_maps(Ranks& ranks, RenderSession& session, const Progressive::Callbacks& callbacks,
                const std::atomic<bool>* cancel) {
  const TemporaryFolder folder;
  const std::string file = folder.file("maps");
  if (ranks.leads()) {
    const bool done = session.can_save() || session.prepare(callbacks, cancel);
    if (!ranks.from_leader(done)) return false;
    CheckpointWriter out(file, {});
    session.save_maps(out);
    out.commit();
    ranks.from_leader(file_text(file));
    return true;
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
  const int tile = queue_.back();
  queue_.pop_back();
  return tile;
}

TileLeader::Portion TileLeader::next_portion(int rank) {
  const std::lock_guard lock(mutex_);
  const std::size_t threads = static_cast<std::size_t>(ranks_.threads_of(rank));
  const std::size_t share = queue_.size() / (2 * static_cast<std::size_t>(ranks_.count()));
  const std::size_t size =
      std::min(std::clamp(share, std::min(threads, kMaxPortion), kMaxPortion), queue_.size());
  Portion portion(queue_.rbegin(), queue_.rbegin() + static_cast<std::ptrdiff_t>(size));
  queue_.resize(queue_.size() - size);
  return portion;
}

void TileLeader::take(const RankMessage& message) {
  if (message.kind != MessageKind::Done) return;
  ByteReader in(message.bytes);
  std::vector<int> tiles;
  RayCounts rays;
  std::int32_t picture = 0;
  in.value(picture);
  if (picture != picture_) return;  // one that ended before
  in.list(tiles);
  visit_rays(in, rays);
  std::vector<Portion>& away = away_[message.from];
  if (away.empty() || away.front() != tiles) throw std::runtime_error("a rank sent other tiles");
  away.erase(away.begin());
  session_.add_tiles(tiles, std::string_view(message.bytes).substr(head_of_message(tiles.size())),
                     rays);
}

void TileLeader::serve(const std::function<bool()>& stops) {
  while (!stops()) {
    bool idle = true;
    while (const auto message = ranks_.receive()) take(*message), idle = false;
    bool waits = false;
    for (int rank = 1; rank < ranks_.count(); ++rank) {
      std::vector<Portion>& away = away_[rank];
      while (away.size() < kPortionsOfRank) {
        Portion portion = next_portion(rank);
        if (portion.empty()) break;
        ranks_.send(rank, MessageKind::Tiles,
                    tiles_message(picture_, portion, session_.pack_tiles(portion), {}));
        away.push_back(std::move(portion));
        idle = false;
      }
      waits |= !away.empty();
    }
    const std::lock_guard lock(mutex_);
    if (!waits && queue_.empty()) return;
    if (idle) std::this_thread::sleep_for(kBetweenMessages);
  }
}

void TileLeader::spread(const std::vector<int>& tiles, const std::function<void(int)>& render_tile,
                        const std::function<bool()>& stops) {
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
    const double begin = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
    while (!stops()) {
      const std::optional<int> tile = next_tile();
      if (!tile) break;
      render_tile(*tile);
    }
    const double used = cpu_seconds(CLOCK_THREAD_CPUTIME_ID) - begin;
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
    ByteReader in(message.bytes);
    std::int32_t picture = 0;
    std::vector<int> tiles;
    in.value(picture);
    in.list(tiles);
    session.unpack_tiles(tiles,
                         std::string_view(message.bytes).substr(head_of_message(tiles.size())));
    const double begin = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
    const RayCounts rays = session.draw_tiles(tiles);
    ranks.add_useful_seconds(cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - begin);
    ranks.send(0, MessageKind::Done,
               tiles_message(picture, tiles, session.pack_tiles(tiles), rays));
    ranks.flush();
  }
}

}  // namespace oriel::app
