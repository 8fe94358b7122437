// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/buffers.h"

#include <fmt/format.h>

#include <filesystem>

#include "models/gltf/meshopt.h"
#include "models/gltf/uri.h"

namespace oriel::models::gltf {

namespace fs = std::filesystem;

std::size_t Buffers::most_bytes(std::size_t content_size) {
  // Limits of the decompressed size. The factor is a guess: meshoptimizer's codec expands at most
  // 64 times.
  constexpr std::size_t kAnyFile = std::size_t{256} << 20, kTimes = 100;
  constexpr std::size_t kBinaryForm = 0xf0000000;  // sizes in the result have 32 bits
  return std::min(kAnyFile + kTimes * content_size, kBinaryForm);
}

void Buffers::spend(std::size_t bytes) {
  if (bytes > left_) throw Unreadable("its decompressed size exceeds the limit");
  left_ -= bytes;
}

std::string Buffers::load(std::size_t index) {
  const json& written = at(member(document_.root, "buffers"), index);
  if (!written.is_object()) throw Unreadable(fmt::format("buffer {} does not exist", index));
  const std::string uri = words(member(written, "uri"));
  if (uri.empty()) throw Unreadable(fmt::format("buffer {} has no data", index));
  if (uri.substr(0, 5) == "data:") {
    auto data = data_of(uri);
    if (!data) throw Unreadable(fmt::format("the data of buffer {} is not valid base64", index));
    return std::move(data->bytes);
  }
  const std::string name = file_name(uri, folder_, files_);
  OpenFile file = files_.open((fs::path(folder_) / name).string(), FileUse::Asset);
  if (file.fault() == OpenFile::Fault::Missing)
    throw Unreadable(fmt::format("file \"{}\" does not exist in the folder of the model", name));
  if (!file) {
    const std::string hint = file.hint().empty() ? "" : "; " + file.hint();
    throw Unreadable(fmt::format("buffer \"{}\" is not read: {}{}", name, file.reason(), hint));
  }
  const std::size_t length =
      std::min<std::size_t>(file.size(), whole(member(written, "byteLength"), 0));
  spend(length);
  std::string bytes = file.read(length);
  if (bytes.size() < length) throw Unreadable(fmt::format("\"{}\" cannot be read", name));
  return bytes;
}

std::string_view Buffers::buffer(std::size_t index) {
  const json& written = at(member(document_.root, "buffers"), index);
  if (index == 0 && !document_.binary.empty() && written.is_object() && !written.contains("uri"))
    return document_.binary;
  const auto known = buffers_.find(index);
  return known != buffers_.end() ? known->second
                                 : buffers_.emplace(index, load(index)).first->second;
}

std::string Buffers::excess(std::size_t size, std::size_t index, const std::string& what) const {
  const json& written = at(member(document_.root, "buffers"), index);
  const std::string uri = words(member(written, "uri"));
  const std::size_t length = whole(member(written, "byteLength"), 0);
  if (uri.empty() || uri.starts_with("data:") || size >= length)
    return fmt::format("{} exceeds buffer {}", what, index);
  return fmt::format("\"{}\" is truncated: {} of {} bytes", uri, size, length);
}

std::string_view Buffers::part(const json& view, const std::string& what) {
  const auto index = whole(member(view, "buffer")), length = whole(member(view, "byteLength"));
  if (!index || !length) throw Unreadable(what + " has no buffer or length");
  const std::size_t offset = whole(member(view, "byteOffset"), 0);
  const std::string_view all = buffer(*index);
  if (offset > all.size() || *length > all.size() - offset)
    throw Unreadable(excess(all.size(), *index, what));
  return all.substr(offset, *length);
}

std::string_view Buffers::view(std::size_t index) {
  const std::string what = fmt::format("buffer view {}", index);
  const json& written = at(member(document_.root, "bufferViews"), index);
  if (!written.is_object()) throw Unreadable(what + " does not exist");
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    const json& packed = extension(written, name);
    if (!packed.is_object()) continue;
    const auto known = unpacked_.find(index);
    if (known != unpacked_.end()) return known->second;
    const MeshoptStream stream = meshopt_stream(packed, what);
    spend(stream.size());
    return unpacked_.emplace(index, unpacked(stream, part(packed, what), what)).first->second;
  }
  return part(written, what);
}

}  // namespace oriel::models::gltf
