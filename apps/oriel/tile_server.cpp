// SPDX-License-Identifier: Apache-2.0
#include "tile_server.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <thread>

#include "base/byte_stream.h"
#include "interrupt.h"
#include "tile_messages.h"

namespace oriel::app {
namespace {

/// While there are tiles, only the end of the picture and signals matter, for which mpirun waits a
/// second.
constexpr std::chrono::milliseconds kLongestWithTiles{128};

class TileServer {
 public:
  TileServer(Ranks& ranks, RenderSession& session) : ranks_(ranks), session_(session) {}

  void run() {
    const double begin = cpu_seconds();
    double for_messages = 0;
    std::exception_ptr failure;
    std::thread messages([&] {
      try {
        serve();
      } catch (...) {
        failure = std::current_exception();
      }
      stop_drawing();
      for_messages = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
    });
    try {
      session_.draw_tiles([this] { return next_tile(); },
                          [this](int tile, const RayCounts& rays) { count(tile, rays); },
                          &stops_drawing_);
    } catch (...) {
      gives_up_ = true;
      messages.join();
      throw;
    }
    messages.join();
    if (failure) std::rethrow_exception(failure);
    ranks_.add_useful_seconds(cpu_seconds() - begin - for_messages);
  }

 private:
  struct Portion {
    TilesHead head;
    std::size_t begun = 0, drawn = 0;
    bool is_begun() const { return begun == head.tiles.size(); }
    bool is_drawn() const { return drawn == head.tiles.size(); }
  };

  void stop_drawing() {
    const std::lock_guard lock(mutex_);
    stops_drawing_ = true;
    tiles_come_.notify_all();
  }

  /// The first portion with tiles that no thread draws.
  std::list<Portion>::iterator portion_with_tiles() {
    return std::find_if(portions_.begin(), portions_.end(),
                        [](const Portion& p) { return !p.is_begun(); });
  }

  /// Waits for a tile. Returns nothing when drawing stops.
  std::optional<int> next_tile() {
    std::unique_lock lock(mutex_);
    tiles_come_.wait(lock,
                     [&] { return stops_drawing_ || portion_with_tiles() != portions_.end(); });
    if (stops_drawing_) return std::nullopt;
    Portion& portion = *portion_with_tiles();
    return portion.head.tiles[portion.begun++];
  }

  void count(int tile, const RayCounts& rays) {
    const std::lock_guard lock(mutex_);
    if (stops_drawing_) return;  // the tile may lack samples
    const auto portion = std::find_if(portions_.begin(), portions_.end(), [tile](const Portion& p) {
      return std::find(p.head.tiles.begin(), p.head.tiles.end(), tile) != p.head.tiles.end();
    });
    portion->head.rays += rays;
    ++portion->drawn;
    if (portion->is_drawn()) portion_is_drawn_.notify_one();
  }

  void serve() {
    LookPause pause;
    while (!gives_up_) {
      bool idle = true;
      while (const auto message = ranks_.receive()) {
        idle = false;
        if (message->kind == MessageKind::EndOfPicture) return;
        if (message->kind == MessageKind::Tiles && !stops_drawing_) take(*message);
      }
      if (interrupted() && !stops_drawing_) {  // rank 0 renders the tiles again
        stop_drawing();
        ranks_.send(0, MessageKind::Interrupted, {});
      }
      idle &= !send_drawn();
      if (!idle || ranks_.is_busy()) pause.reset();
      std::unique_lock lock(mutex_);
      const bool has_tiles = portion_with_tiles() != portions_.end();
      const auto longest = has_tiles ? kLongestWithTiles : LookPause::kLongest;
      portion_is_drawn_.wait_for(lock, pause.next(longest), [this] { return some_are_drawn(); });
    }
  }

  void take(const RankMessage& message) {
    ByteReader in(message.bytes);
    Portion portion;
    portion.head.visit(in);
    TilesHead& head = portion.head;
    session_.unpack_targets(in, head.held);
    session_.unpack_tiles(in, head.tiles);
    head.tiles.insert(head.tiles.begin(), head.held.begin(), head.held.end());
    head.held.clear();
    const std::lock_guard lock(mutex_);
    portions_.push_back(std::move(portion));
    tiles_come_.notify_all();
  }

  bool some_are_drawn() const {
    return std::any_of(portions_.begin(), portions_.end(),
                       [](const Portion& p) { return p.is_drawn(); });
  }

  /// Returns whether there were any.
  bool send_drawn() {
    std::list<Portion> drawn;
    {
      const std::lock_guard lock(mutex_);
      for (auto i = portions_.begin(); i != portions_.end();) {
        const auto portion = i++;
        if (portion->is_drawn()) drawn.splice(drawn.end(), portions_, portion);
      }
    }
    for (Portion& portion : drawn) {
      ByteWriter out;
      portion.head.visit(out);
      session_.pack_tiles(out, portion.head.tiles);
      ranks_.send(0, MessageKind::Done, out.take());
    }
    return !drawn.empty();
  }

  Ranks& ranks_;
  RenderSession& session_;
  std::mutex mutex_;
  std::condition_variable tiles_come_, portion_is_drawn_;
  std::list<Portion> portions_;  ///< in the order of arrival
  std::atomic<bool> stops_drawing_{false}, gives_up_{false};
};

}  // namespace

void serve_tiles(Ranks& ranks, RenderSession& session) {
  ranks.end_start();
  TileServer(ranks, session).run();
}

}  // namespace oriel::app
