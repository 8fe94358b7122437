// SPDX-License-Identifier: Apache-2.0
// The reader process: decodes files that the renderer opened, without access to anything else.
#include <signal.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>

#include "base/confined_process.h"
#include "base/packet.h"
#include "image/files.h"
#include "image/module.h"
#include "image/reader_protocol.h"

namespace oriel::reader {
namespace {

/// An open file. `path` is where the image library believes it to be.
struct ServedFile {
  std::string path;
  Descriptor descriptor;
  std::unique_ptr<PixelSource> source;  // closed before the descriptor
};

class Server {
 public:
  explicit Server(const ConfinedSide& side) : socket_(side.socket), arena_(side.memory) {
    if (arena_.size() < kArenaBytes) throw std::runtime_error("the shared memory is too small");
  }

  void run() {
    auto request = std::make_unique<Request>();
    Descriptor descriptor;
    while (receive_packet(socket_, request.get(), sizeof *request, &descriptor) ==
           sizeof *request) {
      request->path[kMaxPath - 1] = 0;
      Reply reply;
      try {
        answer(*request, std::move(descriptor), reply);
        reply.good = 1;
      } catch (const std::exception& e) {
        std::strncpy(reply.error, e.what(), kMaxError - 1);
      }
      if (!send_packet(socket_, &reply, sizeof reply)) return;
    }
  }

 private:
  void answer(const Request& r, Descriptor descriptor, Reply& reply) {
    switch (r.operation) {
      case Operation::Ready:
        return;
      case Operation::Open: {
        ServedFile& file = files_[++last_];
        file.path = r.path;
        file.descriptor = std::move(descriptor);
        grant_file(file.path.c_str(), file.descriptor.get());
        try {
          file.source = files_module().open_source(file.path);
        } catch (...) {
          files_.erase(last_);
          throw;
        }
        reply.id = last_;
        return;
      }
      case Operation::Close:
        files_.erase(r.id);
        return;
      case Operation::Image:
        grant_file(r.path, descriptor.get());
        image_ = {};
        image_ = read_image_here(r.path);
        grant_file(nullptr, -1);
        reply.level.width = image_.width, reply.level.height = image_.height;
        reply.level.channels = image_.channels;
        return;
      case Operation::Fetch: {
        const std::size_t row = static_cast<std::size_t>(image_.width) * image_.channels;
        check(r.a >= 0 && r.a <= r.b && r.b <= image_.height &&
              (r.b - r.a) * row * sizeof(float) <= kArenaBytes);
        std::memcpy(arena_.data(), image_.pixels.data() + r.a * row,
                    (r.b - r.a) * row * sizeof(float));
        if (r.b == image_.height) image_ = {};
        return;
      }
      default:
        return answer_source(r, reply);
    }
  }

  void answer_source(const Request& r, Reply& reply) {
    const auto found = files_.find(r.id);
    check(found != files_.end());
    ServedFile& file = found->second;
    grant_file(file.path.c_str(), file.descriptor.get());
    PixelLevel level;
    if (!file.source->level(r.subimage, r.miplevel, level))
      throw std::runtime_error("there is no such picture in the file");
    reply.level = level;
    bool good = true;
    if (r.operation == Operation::Rows) {
      const std::size_t bytes = level.row_bytes() * static_cast<std::size_t>(r.b - r.a);
      check(r.a <= r.b && bytes <= kArenaBytes);
      good = file.source->rows(r.subimage, r.miplevel, r.a, r.b, arena_.first(bytes));
    } else if (r.operation == Operation::Tile) {
      check(level.tile_bytes() <= kArenaBytes);
      good = file.source->tile(r.subimage, r.miplevel, r.a, r.b, arena_.first(level.tile_bytes()));
    }
    if (!good) throw std::runtime_error(file.source->error());
  }

  static void check(bool right) {
    if (!right) throw std::runtime_error("the request is invalid");
  }

  const int socket_;
  const std::span<std::byte> arena_;
  std::map<int, ServedFile> files_;
  int last_ = 0;
  Image image_;
};

}  // namespace

int serve(const SandboxLimits& limits) {
  // The renderer ends this process; signals of the terminal do not.
  for (const int number : {SIGINT, SIGHUP, SIGTERM, SIGPIPE}) signal(number, SIG_IGN);
  try {
    files_module().prepare_reading();
    Server server(confined_side());
    enter_sandbox(limits);
    server.run();
    return 0;
  } catch (const std::exception&) {
    return 1;
  }
}

}  // namespace oriel::reader
