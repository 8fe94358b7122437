// SPDX-License-Identifier: Apache-2.0
#include "base/checkpoint_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace oriel {
namespace {

static_assert(std::endian::native == std::endian::little, "checkpoints are little endian");

constexpr std::uint32_t kCheckpointVersion = 1, kCheckpointByteOrder = 0x01020304;
/// Labels are a few hundred bytes and one line for each file of the scene.
constexpr std::uint64_t kMaxLabelBytes = std::uint64_t{1} << 28;
constexpr std::size_t kCheckpointBlock = std::size_t{1} << 20;

struct CheckpointHeader {
  char magic[8];
  std::uint32_t version, byte_order;
  std::uint64_t labels, body;
  std::uint64_t checksum;
};
static_assert(sizeof(CheckpointHeader) == 40);
/// The checksum is the last number of the header and is not part of itself.
constexpr std::size_t kSummedHeader = offsetof(CheckpointHeader, checksum);

CheckpointHeader checkpoint_header(std::uint64_t labels, std::uint64_t body) {
  CheckpointHeader header{{}, kCheckpointVersion, kCheckpointByteOrder, labels, body, 0};
  std::memcpy(header.magic, kCheckpointMagic.data(), sizeof header.magic);
  return header;
}

std::string bytes_of_labels(const CheckpointLabels& labels) {
  std::string bytes;
  const auto add = [&](const std::string& text) {
    const auto size = static_cast<std::uint32_t>(text.size());
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes += text;
  };
  for (const auto& [name, text] : labels) add(name), add(text);
  return bytes;
}

/// Why a file with this header is no intact checkpoint; empty if it may be one.
std::string header_fault(const CheckpointHeader& header, std::uint64_t size) {
  if (std::string_view(header.magic, sizeof header.magic) != kCheckpointMagic)
    return "it is not a checkpoint of Oriel";
  if (header.byte_order != kCheckpointByteOrder) return "it is damaged or has another byte order";
  if (header.version != kCheckpointVersion)
    return fmt::format("it has format {}, and this program reads format {}", header.version,
                       kCheckpointVersion);
  if (header.labels > kMaxLabelBytes || header.labels > size - sizeof header ||
      header.body != size - sizeof header - header.labels)
    return "it is incomplete or damaged: its size is wrong";
  return {};
}

}  // namespace

CheckpointWriter::CheckpointWriter(const std::string& path, const CheckpointLabels& labels)
    : file_(path) {
  const std::string bytes = bytes_of_labels(labels);
  labels_size_ = bytes.size();
  const CheckpointHeader later{};
  file_.write(&later, sizeof later);
  put(bytes.data(), bytes.size());
}

void CheckpointWriter::put(const void* data, std::size_t size) {
  // In blocks: DurableFile copies what it is given.
  const auto* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const std::size_t part = std::min(size, kCheckpointBlock);
    sum_.add(bytes, part);
    file_.write(bytes, part);
    bytes += part, size -= part;
  }
}

void CheckpointWriter::commit() {
  CheckpointHeader header = checkpoint_header(labels_size_, size() - sizeof header - labels_size_);
  // The header is summed last, since its sizes are known last.
  sum_.add(&header, kSummedHeader);
  header.checksum = sum_.value();
  file_.seek(0);
  file_.write(&header, sizeof header);
  file_.commit();
}

CheckpointReader::CheckpointReader(const std::string& path) {
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0)
    throw CheckpointError(errno == ENOENT ? "there is no such file"
                                          : std::generic_category().message(errno));
  try {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode))
      throw CheckpointError("it is not a regular file");
    size_ = static_cast<std::uint64_t>(status.st_size);
    CheckpointHeader header{};
    if (size_ < sizeof header) throw CheckpointError("it is not a checkpoint of Oriel");
    read(0, &header, sizeof header);
    if (const std::string fault = header_fault(header, size_); !fault.empty())
      throw CheckpointError(fault);
    Checksum64 sum;
    std::string block;
    for (std::uint64_t at = sizeof header; at < size_; at += block.size()) {
      block.resize(std::min<std::uint64_t>(kCheckpointBlock, size_ - at));
      read(at, block.data(), block.size());
      sum.add(block);
    }
    sum.add(&header, kSummedHeader);
    if (sum.value() != header.checksum)
      throw CheckpointError("it is damaged: its checksum is wrong");
    std::string labels(header.labels, '\0');
    read(sizeof header, labels.data(), labels.size());
    read_labels(labels);
    at_ = sizeof header + header.labels;
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

CheckpointReader::~CheckpointReader() { ::close(descriptor_); }

void CheckpointReader::read_labels(const std::string& bytes) {
  std::size_t at = 0;
  const auto next = [&] {
    std::uint32_t size = 0;
    if (bytes.size() - at < sizeof size)
      throw CheckpointError("it is damaged: its labels end early");
    std::memcpy(&size, bytes.data() + at, sizeof size);
    at += sizeof size;
    if (bytes.size() - at < size) throw CheckpointError("it is damaged: its labels end early");
    at += size;
    return bytes.substr(at - size, size);
  };
  while (at < bytes.size()) {
    const std::string name = next();
    labels_[name] = next();
  }
}

void CheckpointReader::read(std::uint64_t at, void* data, std::size_t size) const {
  auto* bytes = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t part = ::pread(descriptor_, bytes, size, static_cast<off_t>(at));
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0)
      throw CheckpointError(part < 0 ? std::generic_category().message(errno) : "it ends early");
    bytes += part;
    at += static_cast<std::uint64_t>(part);
    size -= static_cast<std::size_t>(part);
  }
}

void CheckpointReader::get(void* data, std::size_t size) {
  read(at_, data, size);
  at_ += size;
}

void CheckpointReader::end() const {
  if (at_ != size_) throw CheckpointError("its arrays have other sizes");
}

}  // namespace oriel
