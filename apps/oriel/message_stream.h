// SPDX-License-Identifier: Apache-2.0
// Messages of an interactive session to the program that started it, on a pipe.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <thread>

#include "interactive/picture.h"

namespace oriel::app {

/// Writes messages in a thread of its own, so that a slow reader never delays the renderer.
///
/// Model:   a message is its length (4 bytes, little-endian) and its bytes: JSON, or a strip of
///          pixels as in docs/dev/studio-protocol.md. While the reader is slow, newer pictures and
///          states replace those that wait; other messages are kept in order.
/// Checked: InteractiveCommand.* in tests/cli
class MessageStream {
 public:
  explicit MessageStream(int descriptor);
  /// Waits for the message that is being written; the others are dropped.
  ~MessageStream();
  MessageStream(const MessageStream&) = delete;
  MessageStream& operator=(const MessageStream&) = delete;

  void send(const nlohmann::json& message);
  void show(std::shared_ptr<const interactive::Picture> picture);
  /// A state replaces an older one that was not written. It follows the pictures before it.
  void state(const nlohmann::json& message);

 private:
  void run();
  bool write_message(const std::string& bytes) const;

  int descriptor_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::string> texts_;
  std::string state_;
  std::shared_ptr<const interactive::Picture> picture_;
  std::uint32_t frames_ = 0;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace oriel::app
