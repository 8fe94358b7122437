// SPDX-License-Identifier: Apache-2.0
#include "base/durable_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace oriel {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = 1 << 16;
/// File names have at most 255 bytes; the rest is for the random part.
constexpr std::size_t kMaxStemBytes = 200;

std::string reason_of(int error) { return std::generic_category().message(error); }

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// Flushes the entry of a renamed file. Some file systems do not support this for folders, and a
/// folder may be writable but not readable.
int flush_folder(const std::string& target) {
  const int folder = ::open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return 0;
  const int error = ::fsync(folder) == 0 ? 0 : errno;
  ::close(folder);
  return error == EIO || error == ENOSPC || error == EDQUOT ? error : 0;
}

}  // namespace

std::string target_fault(const std::string& path) {
  if (fs::path(path).filename().empty()) return "the path is a folder";
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return {};
  if (S_ISREG(status.st_mode)) return {};
  if (S_ISDIR(status.st_mode)) return "the path is a folder";
  if (S_ISLNK(status.st_mode)) return "it is a symbolic link; remove it or name the file itself";
  return "it is a pipe or a device; name a regular file";
}

DurableFile::DurableFile(const std::string& target, mode_t permissions) : target_(target) {
  if (const std::string fault = target_fault(target); !fault.empty())
    throw std::runtime_error(fault);
  const std::string name = fs::path(target).filename().string();
  constexpr std::size_t kMaxNameBytes = 255;
  if (name.size() > kMaxNameBytes) throw std::runtime_error(reason_of(ENAMETOOLONG));
  do {
    std::uint64_t random = 0;
    if (::getrandom(&random, sizeof random, 0) != sizeof random)
      throw std::runtime_error("there are no random numbers");
    temporary_ =
        (folder_of(target) / fmt::format(".{}.{:016x}", name.substr(0, kMaxStemBytes), random))
            .string();
    descriptor_ =
        ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, permissions);
  } while (descriptor_ < 0 && errno == EEXIST);
  if (descriptor_ < 0) throw std::runtime_error(reason_of(errno));
}

DurableFile::~DurableFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void DurableFile::fail(int error) {
  failure_ = reason_of(error);
  throw std::runtime_error(failure_);
}

void DurableFile::check() const {
  if (!failure_.empty()) throw std::runtime_error(failure_);
}

void DurableFile::write(const void* data, std::size_t size) {
  check();
  buffer_.append(static_cast<const char*>(data), size);
  if (buffer_.size() >= kBufferBytes) flush();
}

void DurableFile::flush() {
  check();
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written =
        ::pwrite(descriptor_, rest.data(), rest.size(), static_cast<off_t>(position_));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(written < 0 ? errno : EIO);
    position_ += static_cast<std::uint64_t>(written);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void DurableFile::seek(std::uint64_t position) {
  if (position == this->position()) return;
  flush();
  position_ = position;
}

void DurableFile::commit() {
  flush();
  if (::fsync(descriptor_) != 0) fail(errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (const std::string fault = target_fault(target_); !fault.empty()) {
    failure_ = fault;
    check();
  }
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  if (const int error = flush_folder(target_); error != 0) fail(error);
}

void write_durably(const std::string& path, std::string_view content, mode_t permissions) try {
  DurableFile file(path, permissions);
  file.write(content);
  file.commit();
} catch (const std::runtime_error& e) {
  throw std::runtime_error(fmt::format("cannot write '{}': {}", path, e.what()));
}

std::string own_file_fault(const std::string& path, std::string_view magic, std::string_view kind) {
  if (fs::path(path).filename().string().starts_with('.'))
    return "names that begin with a dot are not allowed; choose another name";
  const std::string before = first_bytes(path, magic.size());
  if (before.empty() || before == magic) return {};
  return fmt::format("it exists and is not a {}; remove it or choose another name", kind);
}

std::string first_bytes(const std::string& path, std::size_t count) {
  const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return {};
  struct stat status {};
  std::string bytes(count, '\0');
  ssize_t size = 0;
  if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode))
    size = ::pread(file, bytes.data(), count, 0);
  ::close(file);
  bytes.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return bytes;
}

}  // namespace oriel
