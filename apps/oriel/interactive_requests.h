// SPDX-License-Identifier: Apache-2.0
// The requests of `oriel interactive`, see docs/dev/interactive-protocol.md.
#pragma once

#include <memory>
#include <string>

namespace oriel::interactive {
struct SceneSource;
struct LoopSettings;
}  // namespace oriel::interactive

namespace oriel::app {

/// Reads requests and posts them to a session; writes replies, states and pictures.
///
/// Model:   every request is answered by a reply or an error. After the final picture follows the
///          denoised one, if requested.
/// Checked: InteractiveCommand.* in tests/cli
class InteractiveRequests {
 public:
  InteractiveRequests(interactive::SceneSource source, const interactive::LoopSettings& settings,
                      int output);
  ~InteractiveRequests();
  InteractiveRequests(const InteractiveRequests&) = delete;
  InteractiveRequests& operator=(const InteractiveRequests&) = delete;

  /// One line of JSON.
  void handle(const std::string& line);

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace oriel::app
