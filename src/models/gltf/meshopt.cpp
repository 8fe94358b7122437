// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/meshopt.h"

#include <meshoptimizer.h>

#include "models/gltf/document.h"

namespace oriel::models::gltf {
namespace {

using Mode = MeshoptStream::Mode;
using Filter = MeshoptStream::Filter;

/// Conditions that the decoder asserts without checking.
bool is_allowed(const MeshoptStream& s) {
  constexpr std::size_t kMaxCount = std::size_t{1} << 31, kMaxStride = 256;
  if (s.count > kMaxCount) return false;
  if (s.mode != Mode::Attributes)
    return (s.stride == 2 || s.stride == 4) && s.filter == Filter::None &&
           (s.mode != Mode::Triangles || s.count % 3 == 0);
  if (s.stride == 0 || s.stride > kMaxStride || s.stride % 4 != 0) return false;
  if (s.filter == Filter::Octahedral) return s.stride == 4 || s.stride == 8;
  return s.filter != Filter::Quaternion || s.stride == 8;
}

}  // namespace

MeshoptStream meshopt_stream(const json& packed, const std::string& what) {
  MeshoptStream stream;
  stream.count = whole(member(packed, "count"), 0);
  stream.stride = whole(member(packed, "byteStride"), 0);
  const std::string mode = words(member(packed, "mode")), filter = words(member(packed, "filter"));
  if (mode == "TRIANGLES")
    stream.mode = Mode::Triangles;
  else if (mode == "INDICES")
    stream.mode = Mode::Indices;
  else if (mode != "ATTRIBUTES")
    throw Unreadable(what + " has an unsupported compression mode");
  if (filter == "OCTAHEDRAL")
    stream.filter = Filter::Octahedral;
  else if (filter == "QUATERNION")
    stream.filter = Filter::Quaternion;
  else if (filter == "EXPONENTIAL")
    stream.filter = Filter::Exponential;
  else if (!filter.empty() && filter != "NONE")
    throw Unreadable(what + " has an unsupported compression filter");
  if (!is_allowed(stream)) throw Unreadable(what + " has inconsistent compression sizes");
  return stream;
}

std::string unpacked(const MeshoptStream& stream, std::string_view data, const std::string& what) {
  std::string bytes(stream.size(), '\0');
  if (bytes.empty()) return bytes;
  const auto* source = reinterpret_cast<const unsigned char*>(data.data());
  int failed = 0;
  if (stream.mode == Mode::Triangles)
    failed =
        meshopt_decodeIndexBuffer(bytes.data(), stream.count, stream.stride, source, data.size());
  else if (stream.mode == Mode::Indices)
    failed =
        meshopt_decodeIndexSequence(bytes.data(), stream.count, stream.stride, source, data.size());
  else
    failed =
        meshopt_decodeVertexBuffer(bytes.data(), stream.count, stream.stride, source, data.size());
  if (failed != 0) throw Unreadable(what + " cannot be decompressed");
  if (stream.filter == Filter::Octahedral)
    meshopt_decodeFilterOct(bytes.data(), stream.count, stream.stride);
  else if (stream.filter == Filter::Quaternion)
    meshopt_decodeFilterQuat(bytes.data(), stream.count, stream.stride);
  else if (stream.filter == Filter::Exponential)
    meshopt_decodeFilterExp(bytes.data(), stream.count, stream.stride);
  return bytes;
}

}  // namespace oriel::models::gltf
