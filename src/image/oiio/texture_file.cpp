// SPDX-License-Identifier: Apache-2.0
#include "image/oiio/texture_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "image/mip_pyramid.h"
#include "image/oiio/kept_pictures.h"
#include "image/oiio/read_picture.h"
#include "image/oiio/texture_input.h"
#include "image/texture_wrap.h"

namespace oriel::oiio {
namespace {

using System = OIIO::TextureSystem;

/// Maximum number of open texture files: the limit of the process minus a reserve for other files.
int most_open_files() {
  constexpr rlim_t kOthers = 256, kMax = 1 << 20;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return kOthers;
  limit.rlim_cur = std::max(limit.rlim_cur, std::min(limit.rlim_max, kMax));
  setrlimit(RLIMIT_NOFILE, &limit);
  getrlimit(RLIMIT_NOFILE, &limit);
  const rlim_t open = std::min(limit.rlim_cur, kMax);
  return static_cast<int>(open - std::min(kOthers, open / 2));
}

/// Works around a deadlock in OpenImageIO 2.4: to close files beyond its limit, it takes two locks
/// in the opposite order of a thread that opens a file (ImageCacheImpl::check_max_files,
/// ImageCacheFile::open). The limit is therefore as high as possible, and lookups are serialised
/// once more files are in use.
class OpenFiles {
 public:
  int limit() const { return limit_; }
  /// Counts a file that was added to the texture system.
  void add(OIIO::ustring name) {
    const std::lock_guard lock(mutex_);
    names_.insert(name);
    if (static_cast<int>(names_.size()) >= limit_) crowded_.store(true, std::memory_order_relaxed);
  }
  /// A lock to hold while the texture system may open files.
  std::unique_lock<std::mutex> turn() {
    return crowded_.load(std::memory_order_relaxed) ? std::unique_lock(mutex_)
                                                    : std::unique_lock<std::mutex>();
  }

 private:
  const int limit_ = most_open_files();
  std::set<OIIO::ustring> names_;  // a set, because later frames open the same files
  std::atomic<bool> crowded_{false};
  std::mutex mutex_;
};

OpenFiles& open_files() {
  static OpenFiles* const one = new OpenFiles;  // never destroyed, like the texture system
  return *one;
}

/// The only texture system of the process. It is never destroyed, because threads store pointers
/// into it and may end after static destruction.
System& system() {
  static System* const one = [] {
    System* s = System::create(false);
    s->attribute("automip", 1);
    s->attribute("autotile", 64);
    s->attribute("accept_untiled", 1);
    s->attribute("accept_unmipped", 1);
    s->attribute("unassociatedalpha", 1);  // values as stored
    s->attribute("deduplicate", 0);  // do not share tiles of a decoded file with the undecoded one
    s->attribute("max_memory_MB", 1024.0f);
    s->attribute("max_open_files", open_files().limit());
    return s;
  }();
  return *one;
}

System::Perthread* perthread() {
  // The per-thread data is cached, because each query costs a lookup.
  static thread_local System::Perthread* const mine = system().get_perthread_info();
  return mine;
}

OIIO::TextureOpt::Wrap wrap_of(Wrap mode) {
  switch (mode) {
    case Wrap::Periodic:
      return OIIO::TextureOpt::WrapPeriodic;
    case Wrap::Mirror:
      return OIIO::TextureOpt::WrapMirror;
    case Wrap::Black:  // lookups outside are black already, so the filter must not blend in black
    case Wrap::Clamp:
      break;
  }
  return OIIO::TextureOpt::WrapClamp;
}

/// Whether the pixels fill the picture.
bool is_whole(const PixelLevel& l) {
  return l.x == 0 && l.y == 0 && l.width == l.full_width && l.height == l.full_height &&
         l.full_x == 0 && l.full_y == 0;
}

class TextureFile final : public Texture {
 public:
  /// Inputs:  gamma: 1 for pictures that are not decoded; has_levels: the file has coarser levels,
  /// which the tile cache reads.
  TextureFile(std::string path, OIIO::ustring name, float gamma, System::TextureHandle* handle,
              const PixelLevel& level, bool has_levels)
      : path_(std::move(path)), name_(name), gamma_(gamma), handle_(handle), level_(level) {
    width_ = level.full_width;
    height_ = level.full_height;
    channels_ = level.channels;
    read_ = std::min(channels_, 4);
    may_keep_ = is_whole(level) && !has_levels;
  }
  std::uint64_t bytes_to_keep() const override {
    return may_keep_ ? MipPyramid::bytes_of(format()) : 0;
  }
  void keep_pixels() override { keeps_ = may_keep_; }

  Rgba sample(const Vec2& uv, const TextureFootprint& footprint,
              const TextureSampling& how) const override {
    if (const MipPyramid* picture = ready_.load(std::memory_order_acquire))
      return picture->sample(uv, footprint, how);
    const auto u = wrapped(uv.x, how.wrap_u), v = wrapped(uv.y, how.wrap_v);
    if (!u || !v) return Rgba(0, 0, 0, 0);
    if (keeps_) {
      std::call_once(once_, [this] { read(); });
      return kept_ ? kept_->sample(uv, footprint, how) : Rgba(1, 0, 1, 1);
    }
    float c[4] = {0, 0, 0, 0};
    OIIO::TextureOpt options;
    options.swrap = wrap_of(how.wrap_u);
    options.twrap = wrap_of(how.wrap_v);
    options.interpmode = OIIO::TextureOpt::InterpBilinear;
    options.anisotropic = int(std::clamp(how.anisotropy, 1.0f, 64.0f));
    if (how.interpolation == Interpolation::Nearest) {
      options.interpmode = OIIO::TextureOpt::InterpClosest;
      options.mipmode = OIIO::TextureOpt::MipModeNoMIP;
    }

    // The t axis of OpenImageIO starts at the top row.
    const auto turn = open_files().turn();
    const bool good = system().texture(
        handle_, perthread(), options, *u, 1 - *v, bounded_derivative(footprint.dx.x),
        -bounded_derivative(footprint.dx.y), bounded_derivative(footprint.dy.x),
        -bounded_derivative(footprint.dy.y), read_, c);
    return good ? color_of_channels(c, read_) : failed();
  }

  std::string error() const override {
    const std::lock_guard lock(mutex_);
    return error_;
  }

 private:
  PictureFormat format() const {
    return {.width = width_,
            .height = height_,
            .channels = read_,
            .alpha_channel = level_.alpha_channel,
            .bytes = level_.type == OIIO::TypeDesc::UINT8,
            .gamma = gamma_};
  }

  void read() const {
    try {
      kept_ = kept_pictures().find(name_.string());
      if (!kept_) {
        kept_ = read_picture(path_, level_, format());
        kept_pictures().add(name_.string(), kept_, bytes_to_keep(),
                            level_.row_bytes() * static_cast<std::uint64_t>(level_.height));
      }
      ready_.store(kept_.get(), std::memory_order_release);
    } catch (const std::exception& e) {
      fail(e.what());
    }
  }

  void fail(std::string message) const {
    if (failed_.exchange(true, std::memory_order_relaxed)) return;
    const std::lock_guard lock(mutex_);
    error_ = message.empty() ? "its pixels cannot be read" : std::move(message);
  }

  Rgba failed() const {
    // geterror() also clears the message; otherwise each lookup would append to it.
    fail(system().geterror());
    return Rgba(1, 0, 1, 1);
  }

  std::string path_;
  OIIO::ustring name_;  ///< with gamma and time stamp
  float gamma_;
  System::TextureHandle* handle_;
  PixelLevel level_;
  int read_;
  bool may_keep_, keeps_ = false;
  mutable std::once_flag once_;
  mutable std::shared_ptr<const MipPyramid> kept_;
  mutable std::atomic<const MipPyramid*> ready_{nullptr};  ///< kept_, for lookups without call_once
  mutable std::atomic<bool> failed_{false};
  mutable std::mutex mutex_;
  mutable std::string error_;
};

void check_tiles(const PixelLevel& level, std::uint64_t most) {
  const bool tiled = level.tile_width > 0 && level.tile_height > 0;
  const int width = tiled ? level.tile_width : level.width;
  const int height =
      tiled ? level.tile_height : std::clamp(level.strip_rows, 1, std::max(level.height, 1));
  const std::uint64_t bytes = std::uint64_t{sizeof(float)} * static_cast<std::uint64_t>(width) *
                              static_cast<std::uint64_t>(height) *
                              static_cast<std::uint64_t>(level.channels);
  if (bytes <= most) return;
  throw std::runtime_error("its tiles of " + std::to_string(width) + " x " +
                           std::to_string(height) + " pixels take " + std::to_string(bytes) +
                           " bytes each, more than the budget of " + std::to_string(most) +
                           "; --budget texture-tile=" + std::to_string(bytes) + " permits it");
}

}  // namespace

void check_size(long long width, long long height, long long channels) {
  constexpr long long kLargestSide = 1 << 16, kMaxBytes = 1ll << 32;
  if (width < 1 || height < 1 || channels < 1) throw std::runtime_error("its picture is empty");
  if (width > kLargestSide || height > kLargestSide ||
      width * height * std::min(channels, 4ll) * 4 > kMaxBytes)
    throw std::runtime_error("its picture is too large");
}

std::unique_ptr<Texture> open_texture_file(const std::string& path, float gamma,
                                           std::uint64_t most_tile_bytes) {
  // Read the header before the cache does: these error messages are more specific.
  const std::unique_ptr<PixelSource> source = open_source(path);
  PixelLevel level;
  if (!source->level(0, 0, level)) throw std::runtime_error(source->error());
  PixelLevel coarser;
  const bool has_levels = source->level(0, 1, coarser);
  check_size(level.width, level.height, level.channels);
  check_size(level.full_width, level.full_height, 1);
  check_tiles(level, most_tile_bytes);

  const bool decodes = gamma > 0 && gamma != 1 && is_integer(level.type);
  if (!decodes) gamma = 1;
  OIIO::ImageSpec config;
  config.attribute("oriel:path", path);
  config.attribute("oriel:gamma", gamma);
  // The time stamp in the name makes a modified file a different texture. All files have this
  // reader, because the cache would try every format that the image library knows.
  const auto name = OIIO::ustring::fmtformat("{}?oriel_gamma={}&time={}", path, gamma,
                                             OIIO::Filesystem::last_write_time(path));
  system().imagecache()->add_file(name, make_texture_input, &config);
  open_files().add(name);
  const auto turn = open_files().turn();
  System::TextureHandle* handle = system().get_texture_handle(name, perthread());
  if (!handle || !system().good(handle)) {
    const std::string why = system().geterror();
    throw std::runtime_error(why.empty() ? "the image library cannot use it as a texture" : why);
  }
  return std::make_unique<TextureFile>(path, name, gamma, handle, level, has_levels);
}

void set_cache_megabytes(float pictures, float tiles) {
  kept_pictures().set_limit(static_cast<std::uint64_t>(pictures * (1 << 20)));
  system().attribute("max_memory_MB", std::max(16.0f, tiles));
}

TextureStatistics texture_statistics() {
  // Attributes are 32 or 64 bits wide, and a query succeeds only with the right width.
  const auto number = [](const char* name) {
    long long wide = 0;
    if (system().getattribute(name, OIIO::TypeDesc::INT64, &wide)) return std::int64_t{wide};
    int narrow = 0;
    return system().getattribute(name, narrow) ? std::int64_t{narrow} : std::int64_t{0};
  };
  const KeptPictures::Totals kept = kept_pictures().totals();
  return {.files = number("stat:unique_files"),
          .tile_requests = number("stat:find_tile_calls"),
          .tile_misses = number("stat:find_tile_cache_misses"),
          .bytes_read = number("stat:bytes_read") + kept.read,
          .bytes_held = number("stat:cache_memory_used") + kept.held};
}

}  // namespace oriel::oiio
