// SPDX-License-Identifier: Apache-2.0
#include "image/reader_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "base/confined_process.h"
#include "image/reader_protocol.h"

namespace oriel {
namespace {

using reader::kArenaBytes;
using reader::Operation;

Descriptor opened_file(const std::string& path) {
  // Without waiting for the writer of a FIFO.
  Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0)
    throw std::runtime_error(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) throw std::runtime_error("it is not a regular file");
  return file;
}

/// The process had ended before the request; other requests ended it.
struct EndedBefore : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A reader process. Requests are serialised by `mutex`.
class Reader {
 public:
  explicit Reader(const ReaderOptions& options) : options_(options), seconds_(options.seconds) {}

  std::mutex mutex;

  /// Increases with each start; files of earlier processes are closed.
  int generation() const { return generation_; }
  bool is_running() const { return process_ && process_->is_running(); }

  void start_if_needed() {
    if (!is_running()) start();
  }

  /// Errors:  EndedBefore, ProcessEnded; std::runtime_error if the file cannot be read.
  reader::Reply ask(const reader::Request& request, int descriptor = -1) {
    return ask_within(seconds_, request, descriptor);
  }

  const std::byte* arena() const { return process_->memory().data(); }

 private:
  static constexpr double kLeastSeconds = 4;
  /// For a start on a busy machine, which no file delays.
  static constexpr double kStartSeconds = 60;

  reader::Reply ask_within(double seconds, const reader::Request& request, int descriptor) {
    if (!is_running() || !process_->send(&request, sizeof request, descriptor))
      throw EndedBefore("the process that decodes it has ended");
    reader::Reply reply;
    try {
      if (process_->receive(&reply, sizeof reply, seconds) != sizeof reply) {
        process_->end();
        throw ProcessEnded("crashed");
      }
    } catch (const ProcessEnded& e) {
      // So that many files that hang do not add up.
      seconds_ = std::max(seconds_ / 2, std::min(kLeastSeconds, options_.seconds));
      throw ProcessEnded(fmt::format("the process that decodes it {}", e.what()));
    }
    reply.error[reader::kMaxError - 1] = 0;
    if (reply.good != 1) throw std::runtime_error(printable(reply.error));
    return reply;
  }

  /// Text of an untrusted process.
  static std::string printable(const char* text) {
    std::string out(text);
    for (char& c : out)
      if (static_cast<unsigned char>(c) < ' ' || c == 127) c = ' ';
    return out.empty() ? "the image library gives no reason" : out;
  }

  void start() {
    process_.reset();
    process_.emplace(ConfinedOptions{options_.program, kReaderArgument, options_.memory_mb,
                                     kProcessorSeconds, kArenaBytes});
    ++generation_;
    reader::Request ready;
    ask_within(kStartSeconds, ready, -1);
  }

  static constexpr std::size_t kProcessorSeconds = 24 * 3600;

  const ReaderOptions options_;
  double seconds_;  ///< for each request
  int generation_ = 0;
  std::optional<ConfinedProcess> process_;
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
    if (generation_ != reader_.generation() || !reader_.is_running()) return;
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
    reader_.start_if_needed();
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
      if (generation_ != reader_.generation() || !reader_.is_running()) open();
      try {
        f();
      } catch (const EndedBefore&) {
        open();
        f();
      }
      return true;
    } catch (const ProcessEnded& e) {
      failed_ = true;
      error_ = e.what();
    } catch (const std::exception& e) {
      error_ = e.what();
    }
    return false;
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
  reader.start_if_needed();
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
