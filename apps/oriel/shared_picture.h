// SPDX-License-Identifier: Apache-2.0
// One picture that several ranks render.
#pragma once

#include <map>
#include <mutex>
#include <vector>

#include "ranks.h"
#include "render/session.h"

namespace oriel::app {

struct RenderArguments;

/// Refuses ranks whose session differs from that of rank 0 in scene, files or settings.
/// Errors:  UserError in rank 0 that names the rank and the difference.
void require_same_session(Ranks& ranks, const RenderArguments& arguments,
                          const RenderSession& session);

/// Computes what the session needs before the picture, unless a checkpoint contained it. Final
/// gather points are divided among the ranks; all else is computed by rank 0 and copied to the
/// others. Returns false if cancelled.
bool share_maps(Ranks& ranks, RenderSession& session, const Progressive::Callbacks& callbacks,
                const std::atomic<bool>* cancel);

/// Hands out tiles in rank 0, which renders as well.
///
/// Model:   tiles with most samples first, in portions that become smaller toward the end of a
///          pass. Every rank has one portion more than it renders, so that it does not wait for
///          messages. The pixels of a tile are sent with the tile, unless the rank rendered them in
///          the pass before, and return with all their samples: the film depends on no order. If
///          the render pauses or is cancelled, tiles of other ranks count as not rendered until
///          they return.
/// Checked: Mpi.* in tests/faults
class TileLeader {
 public:
  /// Inputs:  picture: another number for each picture of the job.
  TileLeader(Ranks& ranks, RenderSession& session, int picture);
  /// For Progressive::Callbacks::spread.
  void spread(const std::vector<int>& tiles, const std::function<void(int)>& render_tile,
              const std::function<bool()>& stops);
  /// After the picture: other ranks wait for the next one. All but messages was useful work.
  void end();

 private:
  using Portion = std::vector<int>;
  std::optional<int> next_tile();
  Portion next_portion(int rank);
  void send(int rank, const Portion& portion);
  void serve(const std::function<bool()>& stops);
  void take(const RankMessage& message);
  bool is_away(int tile) const;

  Ranks& ranks_;
  RenderSession& session_;
  std::int32_t picture_;
  std::mutex mutex_;
  std::vector<int> queue_;                    ///< tiles, the next one last
  std::vector<int> holder_;                   ///< of each tile: the rank that has its pixels
  std::map<int, std::vector<Portion>> away_;  ///< portions of each rank
  double begin_;                              ///< processor time before the picture
  double message_seconds_ = 0;                ///< processor time of the thread for messages
};

}  // namespace oriel::app
