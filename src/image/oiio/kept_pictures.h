// SPDX-License-Identifier: Apache-2.0
// Pictures in memory that textures share, also those of later frames.
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "image/mip_pyramid.h"

namespace oriel::oiio {

/// Keeps pictures that no texture uses any more until others need their memory, the oldest first.
/// Thread-safe. Checked: FileTexture.TheNextSystemFindsPicturesInMemory
class KeptPictures {
 public:
  using Picture = std::shared_ptr<const MipPyramid>;

  void set_limit(std::uint64_t bytes);
  /// The picture of that name; null if it is not in memory.
  Picture find(const std::string& name);
  /// Inputs:  bytes: of its memory; read: uncompressed size of the pixels in the file.
  void add(const std::string& name, Picture picture, std::uint64_t bytes, std::uint64_t read);
  /// Memory of all pictures, and the size of what was read so far.
  struct Totals {
    std::int64_t held, read;
  };
  Totals totals() const;

 private:
  struct Entry {
    std::string name;
    Picture picture;
    std::uint64_t bytes;
  };
  void make_room();

  mutable std::mutex mutex_;
  std::list<Entry> entries_;  ///< the one found last at the end
  std::uint64_t bytes_ = 0, read_ = 0, limit_ = 0;
};

/// The pictures of the process.
KeptPictures& kept_pictures();

}  // namespace oriel::oiio
