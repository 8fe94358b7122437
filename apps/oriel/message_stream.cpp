// SPDX-License-Identifier: Apache-2.0
#include "message_stream.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <utility>

#include "studio/json_values.h"
#include "studio/wire.h"

namespace oriel::app {
namespace {

bool write_bytes(int descriptor, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

MessageStream::MessageStream(int descriptor)
    : descriptor_(descriptor), thread_([this] { run(); }) {}

MessageStream::~MessageStream() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void MessageStream::send(const nlohmann::json& message) {
  {
    const std::scoped_lock lock(mutex_);
    texts_.push_back(studio::dumped(message));
  }
  wake_.notify_all();
}

void MessageStream::show(std::shared_ptr<const interactive::Picture> picture) {
  {
    const std::scoped_lock lock(mutex_);
    picture_ = std::move(picture);
  }
  wake_.notify_all();
}

void MessageStream::state(const nlohmann::json& message) {
  {
    const std::scoped_lock lock(mutex_);
    state_ = studio::dumped(message);
  }
  wake_.notify_all();
}

bool MessageStream::write_message(const std::string& bytes) const {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  const std::array<char, 4> head = {
      static_cast<char>(size & 255), static_cast<char>(size >> 8 & 255),
      static_cast<char>(size >> 16 & 255), static_cast<char>(size >> 24 & 255)};
  return write_bytes(descriptor_, head.data(), head.size()) &&
         write_bytes(descriptor_, bytes.data(), bytes.size());
}

void MessageStream::run() {
  for (;;) {
    std::deque<std::string> texts;
    std::string state;
    std::shared_ptr<const interactive::Picture> picture;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock,
                 [this] { return ending_ || !texts_.empty() || !state_.empty() || picture_; });
      if (ending_) return;
      texts.swap(texts_);
      state.swap(state_);
      picture.swap(picture_);
    }
    bool is_open = true;
    for (const std::string& text : texts) is_open = is_open && write_message(text);
    if (picture)
      for (const auto& strip : studio::wire_strips(*picture, ++frames_))
        is_open = is_open && write_message(*strip);
    if (!state.empty()) is_open = is_open && write_message(state);
    if (!is_open) return;
  }
}

}  // namespace oriel::app
