// SPDX-License-Identifier: Apache-2.0
#include "transport/gather/gather_map.h"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <stdexcept>

#include "base/durable_file.h"
#include "base/file_access.h"
#include "transport/gather/gather_cache.h"

namespace oriel {
namespace {

constexpr char kMagic[] = {'O', 'R', 'I', 'E', 'L', 'F', 'G', 'M'};
constexpr std::uint32_t kByteOrder = 0x01020304, kOtherByteOrder = 0x04030201;
constexpr std::uint32_t kVersion = 1;

struct Header {
  char magic[8];
  std::uint32_t byte_order, version, floats, zero;
  std::uint64_t records;
};
static_assert(sizeof(Header) == 32);

/// Calls f for each number of a record, in file order.
template <class Record, class F>
void each_number(Record& r, const F& f) {
  const auto vector = [&](auto& v) {
    f(v.x);
    f(v.y);
    f(v.z);
  };
  vector(r.position);
  vector(r.normal);
  vector(r.irradiance);
  for (auto& v : r.by_position) vector(v);
  for (auto& v : r.by_normal) vector(v);
  f(r.radius);
  f(r.noise);
  f(r.mean_distance);
  f(r.min_distance);
  for (auto& x : r.free) f(x);
  vector(r.incoming.mean);
  for (auto& v : r.incoming.linear) vector(v);
  for (auto& v : r.incoming.quadratic) vector(v);
}
std::uint32_t numbers_of_record() {
  std::uint32_t count = 0;
  const GatherRecord r;
  each_number(r, [&](float) { ++count; });
  return count;
}

/// Source:  Fowler, Noll, Vo; 64 bits, published offset basis and prime.
class Checksum {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3ull;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

void write_records(std::span<const GatherRecord> records, DurableFile& out) {
  Checksum sum;
  const auto write = [&](const void* data, std::size_t size) {
    sum.add(data, size);
    out.write(data, size);
  };
  Header header{{}, kByteOrder, kVersion, numbers_of_record(), 0, records.size()};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  write(&header, sizeof header);
  std::vector<float> numbers;
  for (const GatherRecord& r : records) {
    numbers.clear();
    each_number(r, [&](float x) { numbers.push_back(x); });
    write(numbers.data(), numbers.size() * sizeof(float));
  }
  const std::uint64_t value = sum.value();
  out.write(&value, sizeof value);
}

/// Returns why the header is rejected; empty if it is valid.
std::string refusal(const Header& h, std::uint64_t size, std::uint64_t most) {
  if (std::memcmp(h.magic, kMagic, sizeof kMagic) != 0)
    return "is not a final gather map of Oriel (other renderers' maps cannot be read)";
  if (h.byte_order == kOtherByteOrder) return "was written on a machine of other byte order";
  if (h.byte_order != kByteOrder) return "is damaged";
  if (h.version != kVersion)
    return fmt::format("has version {}, this program reads version {}", h.version, kVersion);
  if (h.records > most) return fmt::format("claims more than {} points", most);
  const std::uint64_t record = std::uint64_t{h.floats} * sizeof(float);
  if (h.floats != numbers_of_record() || h.zero != 0 ||
      size != sizeof(Header) + h.records * record + sizeof(std::uint64_t))
    return "is damaged: its size does not match its header";
  return {};
}

/// Fills `records`; returns an error text, or empty.
std::string read_records(const std::string& path, std::uint64_t most,
                         std::vector<GatherRecord>& records) {
  const OpenFile file = open_regular(path);
  if (!file) return "could not be read: " + file.reason();
  std::ifstream in(file.descriptor_path(), std::ios::binary);
  Checksum sum;
  const auto read = [&](void* data, std::size_t bytes) {
    in.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes));
    return static_cast<std::size_t>(in.gcount()) == bytes;
  };
  Header header{};
  const bool whole = read(&header, sizeof header);
  if (std::string why = refusal(header, file.size(), most); !why.empty()) return why;
  if (!whole) return "is damaged: it ends early";
  sum.add(&header, sizeof header);

  // The count is bounded by the file size here.
  records.resize(header.records);
  std::vector<float> numbers(header.floats);
  const std::size_t bytes = numbers.size() * sizeof(float);
  bool usable = true;
  for (GatherRecord& r : records) {
    if (!read(numbers.data(), bytes)) return "is damaged: it ends early";
    sum.add(numbers.data(), bytes);
    const float* next = numbers.data();
    each_number(r, [&](float& x) { x = *next++; });
    usable = usable && GatherCache::usable(r);
  }
  std::uint64_t expected = 0;
  if (!read(&expected, sizeof expected)) return "is damaged: it ends early";
  if (expected != sum.value()) return "is damaged: its checksum is wrong";
  return usable ? "" : "holds points that cannot be";
}

}  // namespace

bool save_gather_map(std::span<const GatherRecord> records, const std::string& path,
                     Diagnostics& diagnostics) {
  const auto failed = [&](const std::string& why) {
    diagnostics.error("OR-TR-101", {},
                      fmt::format("final gather map '{}' could not be written: {}", path, why));
    return false;
  };
  if (records.size() > kMaxGatherRecords)
    return failed(fmt::format("it has more than {} points", kMaxGatherRecords));
  try {
    const std::string fault =
        own_file_fault(path, {kMagic, sizeof kMagic}, "final gather map of Oriel");
    if (!fault.empty()) return failed(fault);
    DurableFile out(path);
    write_records(records, out);
    out.commit();
  } catch (const std::runtime_error& e) {
    return failed(e.what());
  }
  return true;
}

std::optional<std::vector<GatherRecord>> load_gather_map(const std::string& path,
                                                         Diagnostics& diagnostics,
                                                         std::uint64_t most) {
  std::vector<GatherRecord> records;
  const std::string why = read_records(path, most, records);
  if (why.empty()) return records;
  diagnostics.warning("OR-TR-102", {}, fmt::format("final gather map '{}' {}", path, why),
                      "the points are gathered anew");
  return std::nullopt;
}

}  // namespace oriel
