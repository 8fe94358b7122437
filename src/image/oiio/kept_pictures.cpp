// SPDX-License-Identifier: Apache-2.0
#include "image/oiio/kept_pictures.h"

#include <algorithm>
#include <utility>

namespace oriel::oiio {

void KeptPictures::set_limit(std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  limit_ = bytes;
  make_room();
}

KeptPictures::Picture KeptPictures::find(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& e) { return e.name == name; });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.end(), entries_, found);
  return found->picture;
}

void KeptPictures::add(const std::string& name, Picture picture, std::uint64_t bytes,
                       std::uint64_t read) {
  const std::lock_guard lock(mutex_);
  entries_.push_back({name, std::move(picture), bytes});
  bytes_ += bytes;
  read_ += read;
  make_room();
}

KeptPictures::Totals KeptPictures::totals() const {
  const std::lock_guard lock(mutex_);
  return {static_cast<std::int64_t>(bytes_), static_cast<std::int64_t>(read_)};
}

void KeptPictures::make_room() {
  for (auto entry = entries_.begin(); entry != entries_.end() && bytes_ > limit_;) {
    const bool used = entry->picture.use_count() > 1;
    if (!used) bytes_ -= entry->bytes;
    entry = used ? std::next(entry) : entries_.erase(entry);
  }
}

KeptPictures& kept_pictures() {
  static auto* const pictures = new KeptPictures;  // never destroyed, like the texture system
  return *pictures;
}

}  // namespace oriel::oiio
