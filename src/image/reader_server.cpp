// SPDX-License-Identifier: Apache-2.0
// The reader process: decodes files that the renderer opened, without access to anything else.
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>

#include "base/sandbox.h"
#include "image/files.h"
#include "image/module.h"
#include "image/reader_protocol.h"

namespace oriel::reader {
namespace {

/// An open file. `path` is where the image library believes it to be.
struct ServedFile {
  std::string path;
  int descriptor = -1;
  std::unique_ptr<PixelSource> source;
};

class Server {
 public:
  Server()
      : arena_(static_cast<std::byte*>(
            mmap(nullptr, kArenaBytes, PROT_READ | PROT_WRITE, MAP_SHARED, kArena, 0))) {
    if (static_cast<void*>(arena_) == MAP_FAILED)
      throw std::runtime_error("the shared memory is missing");
  }

  void run() {
    auto request = std::make_unique<Request>();
    int descriptor = -1;
    while (receive_packet(kSocket, request.get(), sizeof *request, &descriptor)) {
      request->path[kMaxPath - 1] = 0;
      Reply reply;
      try {
        answer(*request, descriptor, reply);
        reply.good = 1;
      } catch (const std::exception& e) {
        std::strncpy(reply.error, e.what(), kMaxError - 1);
      }
      if (!send_packet(kSocket, &reply, sizeof reply)) return;
    }
  }

 private:
  void answer(const Request& r, int descriptor, Reply& reply) {
    switch (r.operation) {
      case Operation::Ready:
        return;
      case Operation::Open: {
        ServedFile& file = files_[++last_];
        file.path = r.path;
        file.descriptor = descriptor;
        grant_file(file.path.c_str(), descriptor);
        try {
          file.source = files_module().open_source(file.path);
        } catch (...) {
          close_file(last_);
          throw;
        }
        reply.id = last_;
        return;
      }
      case Operation::Close:
        return close_file(r.id);
      case Operation::Image:
        grant_file(r.path, descriptor);
        image_ = {};
        image_ = read_image_here(r.path);
        grant_file(nullptr, -1);
        close(descriptor);
        reply.level.width = image_.width, reply.level.height = image_.height;
        reply.level.channels = image_.channels;
        return;
      case Operation::Fetch: {
        const std::size_t row = static_cast<std::size_t>(image_.width) * image_.channels;
        check(r.a >= 0 && r.a <= r.b && r.b <= image_.height &&
              (r.b - r.a) * row * sizeof(float) <= kArenaBytes);
        std::memcpy(arena_, image_.pixels.data() + r.a * row, (r.b - r.a) * row * sizeof(float));
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
    grant_file(file.path.c_str(), file.descriptor);
    PixelLevel level;
    if (!file.source->level(r.subimage, r.miplevel, level))
      throw std::runtime_error("there is no such picture in the file");
    reply.level = level;
    bool good = true;
    if (r.operation == Operation::Rows) {
      const std::size_t bytes = level.row_bytes() * static_cast<std::size_t>(r.b - r.a);
      check(r.a <= r.b && bytes <= kArenaBytes);
      good = file.source->rows(r.subimage, r.miplevel, r.a, r.b, {arena_, bytes});
    } else if (r.operation == Operation::Tile) {
      check(level.tile_bytes() <= kArenaBytes);
      good = file.source->tile(r.subimage, r.miplevel, r.a, r.b, {arena_, level.tile_bytes()});
    }
    if (!good) throw std::runtime_error(file.source->error());
  }

  static void check(bool right) {
    if (!right) throw std::runtime_error("the request is invalid");
  }

  void close_file(int id) {
    const auto found = files_.find(id);
    if (found == files_.end()) return;
    found->second.source.reset();
    close(found->second.descriptor);
    files_.erase(found);
  }

  std::byte* arena_;
  std::map<int, ServedFile> files_;
  int last_ = 0;
  Image image_;
};

}  // namespace

int serve(std::size_t memory_mb) {
  close_range(kArena + 1, ~0u, 0);
  // The renderer ends this process; signals of the terminal do not.
  for (const int number : {SIGINT, SIGHUP, SIGTERM, SIGPIPE}) signal(number, SIG_IGN);
  try {
    files_module().prepare_reading();
    Server server;
    enter_sandbox({memory_mb << 20});
    server.run();
    return 0;
  } catch (const std::exception&) {
    return 1;
  }
}

}  // namespace oriel::reader
