// SPDX-License-Identifier: Apache-2.0
#include "image/reader_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "image/reader_protocol.h"

namespace oriel {
namespace {

using reader::kArenaBytes;
using reader::Operation;

/// Closes a descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    const Descriptor before(std::exchange(number_, std::exchange(other.number_, -1)));
    return *this;
  }
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  int get() const { return number_; }

 private:
  int number_;
};

Descriptor opened_file(const std::string& path) {
  // Without waiting for the writer of a FIFO.
  Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0)
    throw std::runtime_error(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) throw std::runtime_error("it is not a regular file");
  return file;
}

/// A reader process. Requests are serialised by `mutex`.
class Reader {
 public:
  explicit Reader(const ReaderOptions& options) : options_(options) {}
  ~Reader() { end(); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  std::mutex mutex;

  /// Increases with each start; files of earlier processes are closed.
  int generation() const { return generation_; }

  void start_if_needed() {
    if (process_ <= 0) start();
  }

  /// Throws std::runtime_error if the file cannot be read or the process ended.
  reader::Reply ask(const reader::Request& request, int descriptor = -1) {
    start_if_needed();
    reader::Reply reply;
    if (!reader::send_packet(socket_.get(), &request, sizeof request, descriptor)) fail("ended");
    pollfd ready{socket_.get(), POLLIN, 0};
    int count = -1;
    do count = poll(&ready, 1, static_cast<int>(options_.seconds * 1000));
    while (count < 0 && errno == EINTR);
    if (count == 0) fail(fmt::format("took more than {} s", options_.seconds));
    if (!reader::receive_packet(socket_.get(), &reply, sizeof reply)) fail("crashed");
    reply.error[reader::kMaxError - 1] = 0;
    if (!reply.good) throw std::runtime_error(printable(reply.error));
    return reply;
  }

  const std::byte* arena() const { return arena_; }
  pid_t process() const { return process_; }

 private:
  /// Text of an untrusted process.
  static std::string printable(const char* text) {
    std::string out(text);
    for (char& c : out)
      if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
    return out.empty() ? "the image library gives no reason" : out;
  }

  [[noreturn]] void fail(const std::string& what) {
    end();
    throw std::runtime_error("the process that decodes it " + what);
  }

  void start() {
    int sockets[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets) != 0)
      throw std::runtime_error("no reader process can be started");
    Descriptor ours(sockets[0]), theirs(sockets[1]);
    Descriptor memory(memfd_create("oriel-pixels", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (memory.get() < 0 || ftruncate(memory.get(), kArenaBytes) != 0 ||
        // A process that shrinks the memory would crash this one.
        fcntl(memory.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) != 0)
      throw std::runtime_error("no reader process can be started: shared memory is missing");
    void* const arena = mmap(nullptr, kArenaBytes, PROT_READ, MAP_SHARED, memory.get(), 0);
    if (arena == MAP_FAILED) throw std::runtime_error("no memory for a reader process");
    arena_ = static_cast<const std::byte*>(arena);
    spawn(theirs.get(), memory.get());
    theirs = Descriptor();  // so that the end of the process is noticed
    socket_ = std::move(ours);
    ++generation_;
    reader::Request ready;
    ask(ready);
  }

  void spawn(int socket, int memory) {
    // The numbers may be those of the targets.
    const Descriptor high_socket(fcntl(socket, F_DUPFD_CLOEXEC, 64));
    const Descriptor high_memory(fcntl(memory, F_DUPFD_CLOEXEC, 64));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, high_socket.get(), reader::kSocket);
    posix_spawn_file_actions_adddup2(&actions, high_memory.get(), reader::kArena);
    std::string words[] = {options_.program, kReaderArgument, std::to_string(options_.memory_mb)};
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    pid_t process = 0;
    const int failed =
        posix_spawn(&process, options_.program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0)
      throw std::runtime_error(
          fmt::format("no reader process can be started: {}", std::strerror(failed)));
    process_ = process;
  }

  void end() {
    socket_ = Descriptor();
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
    process_ = 0;
    if (arena_) munmap(const_cast<std::byte*>(arena_), kArenaBytes);
    arena_ = nullptr;
  }

  const ReaderOptions options_;
  std::atomic<pid_t> process_ = 0;
  int generation_ = 0;
  Descriptor socket_;
  const std::byte* arena_ = nullptr;
};

struct Pool {
  std::vector<std::unique_ptr<Reader>> readers;
  std::atomic<std::size_t> next = 0;
};
std::atomic<Pool*> pool = nullptr;

Reader& next_reader() {
  Pool& all = *pool.load();
  return *all.readers[all.next++ % all.readers.size()];
}

void set_path(reader::Request& request, const std::string& path) {
  if (path.size() >= reader::kMaxPath) throw std::runtime_error("its path is too long");
  path.copy(request.path, path.size());
}

/// Throws unless the sizes are within the limits of textures, whatever the process replied.
void check_level(const PixelLevel& l) {
  constexpr int kMaxSide = 1 << 16, kMaxChannels = 1024;
  // Of OIIO::TypeDesc: UINT8 to INT64, HALF, FLOAT, DOUBLE.
  constexpr int kTypeBytes[] = {0, 0, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
  const auto side = [](int size) { return size >= 1 && size <= kMaxSide; };
  const auto place = [](int at) { return at > -(1 << 24) && at < 1 << 24; };
  const bool right = side(l.width) && side(l.height) && side(l.full_width) && side(l.full_height) &&
                     place(l.x) && place(l.y) && place(l.full_x) && place(l.full_y) &&
                     l.tile_width >= 0 && l.tile_width <= kMaxSide && l.tile_height >= 0 &&
                     l.tile_height <= kMaxSide && (l.tile_width > 0) == (l.tile_height > 0) &&
                     l.channels >= 1 && l.channels <= kMaxChannels && l.alpha_channel >= -1 &&
                     l.alpha_channel < l.channels && l.type >= 2 && l.type <= 12 &&
                     l.type_bytes == kTypeBytes[l.type] && l.row_bytes() <= kArenaBytes &&
                     l.tile_bytes() <= kArenaBytes;
  if (!right) throw std::runtime_error("its picture has an unsupported size or type");
}

class IsolatedSource final : public PixelSource {
 public:
  IsolatedSource(Reader& reader, std::string path) : reader_(reader), path_(std::move(path)) {
    const std::lock_guard lock(reader_.mutex);
    open();
  }
  ~IsolatedSource() override {
    const std::lock_guard lock(reader_.mutex);
    if (generation_ != reader_.generation() || !reader_.process()) return;
    try {
      reader_.ask(request(Operation::Close, 0, 0));
    } catch (const std::exception&) {  // it has ended, so the file is closed
    }
  }

  bool level(int subimage, int miplevel, PixelLevel& level) override {
    return guarded([&] {
      level = reader_.ask(request(Operation::Level, subimage, miplevel)).level;
      check_level(level);
    });
  }

  bool rows(int subimage, int miplevel, int y_begin, int y_end, std::span<std::byte> out) override {
    return guarded([&] {
      const auto count = static_cast<std::size_t>(y_end - y_begin);
      if (count == 0 || out.size() % count != 0) throw std::runtime_error("no rows");
      const std::size_t row = out.size() / count;
      const int step = static_cast<int>(std::max<std::size_t>(kArenaBytes / row, 1));
      for (int y = y_begin; y < y_end; y += step) {
        const int end = std::min(y + step, y_end);
        const std::size_t bytes = static_cast<std::size_t>(end - y) * row;
        if (bytes > kArenaBytes) throw std::runtime_error("its rows are too long");
        reader_.ask(request(Operation::Rows, subimage, miplevel, y, end));
        std::memcpy(out.data() + static_cast<std::size_t>(y - y_begin) * row, reader_.arena(),
                    bytes);
      }
    });
  }

  bool tile(int subimage, int miplevel, int x, int y, std::span<std::byte> out) override {
    return guarded([&] {
      if (out.size() > kArenaBytes) throw std::runtime_error("its tiles are too large");
      reader_.ask(request(Operation::Tile, subimage, miplevel, x, y));
      std::memcpy(out.data(), reader_.arena(), out.size());
    });
  }

  std::string error() const override { return error_; }

 private:
  void open() {
    reader::Request opening;
    opening.operation = Operation::Open;
    set_path(opening, path_);
    const Descriptor file = opened_file(path_);
    id_ = reader_.ask(opening, file.get()).id;
    generation_ = reader_.generation();
  }

  /// Calls f(), which asks the process. A file whose decoder ended the process is not read again;
  /// other files of that process are opened again.
  template <class F>
  bool guarded(F&& f) {
    const std::lock_guard lock(reader_.mutex);
    try {
      if (failed_) throw std::runtime_error(error_);
      if (generation_ != reader_.generation() || !reader_.process()) open();
      f();
      return true;
    } catch (const std::exception& e) {
      error_ = e.what();
      if (!reader_.process()) failed_ = true;
      return false;
    }
  }

  reader::Request request(Operation operation, int subimage, int miplevel, int a = 0,
                          int b = 0) const {
    reader::Request r;
    r.operation = operation;
    r.id = id_, r.subimage = subimage, r.miplevel = miplevel, r.a = a, r.b = b;
    return r;
  }

  Reader& reader_;
  const std::string path_;
  int id_ = 0, generation_ = -1;
  bool failed_ = false;
  std::string error_;
};

}  // namespace

void isolate_readers(const ReaderOptions& options) {
  auto made = std::make_unique<Pool>();
  constexpr unsigned kMaxProcesses = 8;
  const int count =
      options.processes > 0
          ? options.processes
          : static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, kMaxProcesses));
  for (int i = 0; i < count; ++i) made->readers.push_back(std::make_unique<Reader>(options));
  {
    // An error is reported here, not for every file.
    const std::lock_guard lock(made->readers[0]->mutex);
    made->readers[0]->start_if_needed();
  }
  // Never destroyed: textures may be closed until the end of the process.
  pool = made.release();
}

bool readers_are_isolated() { return pool.load() != nullptr; }

std::unique_ptr<PixelSource> open_isolated(const std::string& path) {
  return std::make_unique<IsolatedSource>(next_reader(), path);
}

Image read_image_isolated(const std::string& path) {
  Reader& reader = next_reader();
  const Descriptor file = opened_file(path);
  reader::Request request;
  request.operation = Operation::Image;
  set_path(request, path);
  const std::lock_guard lock(reader.mutex);
  const PixelLevel size = reader.ask(request, file.get()).level;
  constexpr std::int64_t kMaxSide = 1 << 16, kMaxFloats = std::int64_t{1} << 30;
  if (size.width < 1 || size.width > kMaxSide || size.height < 1 || size.height > kMaxSide ||
      size.channels < 1 || size.channels > 4 ||
      std::int64_t{size.width} * size.height * size.channels > kMaxFloats)
    throw std::runtime_error("its picture has an unsupported size");
  Image image(size.width, size.height, size.channels);
  const std::size_t row = static_cast<std::size_t>(size.width) *
                          static_cast<std::size_t>(size.channels) * sizeof(float);
  const int step = static_cast<int>(kArenaBytes / row);
  request = {};
  request.operation = Operation::Fetch;
  for (request.a = 0; request.a < size.height; request.a = request.b) {
    request.b = std::min(request.a + step, size.height);
    reader.ask(request);
    std::memcpy(reinterpret_cast<std::byte*>(image.pixels.data()) +
                    static_cast<std::size_t>(request.a) * row,
                reader.arena(), static_cast<std::size_t>(request.b - request.a) * row);
  }
  return image;
}

}  // namespace oriel
