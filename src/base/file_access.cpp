// SPDX-License-Identifier: Apache-2.0
#include "base/file_access.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>

namespace oriel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNotRegular = "it is not a regular file";

/// Without symbolic links; empty after an error.
std::string resolved(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path.empty() ? fs::path(".") : fs::path(path), error);
  if (error) return {};
  std::string text = fs::weakly_canonical(whole, error).string();
  if (error) return {};
  while (text.size() > 1 && text.back() == '/') text.pop_back();  // of a folder that is missing
  return text;
}

/// Files of these file systems are regular by their type, but the kernel makes their content.
bool is_of_kernel(int descriptor) {
  constexpr long kConfigfs = 0x62656570;
  constexpr long kKernel[] = {
      PROC_SUPER_MAGIC,   SYSFS_MAGIC,         DEBUGFS_MAGIC,  TRACEFS_MAGIC,  SECURITYFS_MAGIC,
      CGROUP_SUPER_MAGIC, CGROUP2_SUPER_MAGIC, BPF_FS_MAGIC,   PSTOREFS_MAGIC, EFIVARFS_MAGIC,
      SELINUX_MAGIC,      DEVPTS_SUPER_MAGIC,  BINFMTFS_MAGIC, NSFS_MAGIC,     kConfigfs};
  struct statfs about {};
  return ::fstatfs(descriptor, &about) == 0 &&
         std::find(std::begin(kKernel), std::end(kKernel), long{about.f_type}) != std::end(kKernel);
}

std::string path_of(int descriptor) {
  std::error_code error;
  return fs::read_symlink(fmt::format("/proc/self/fd/{}", descriptor), error).string();
}

}  // namespace

bool lies_below(std::string_view path, std::string_view folder) {
  if (folder.empty() || !path.starts_with(folder)) return false;
  return folder.back() == '/' || path.size() == folder.size() || path[folder.size()] == '/';
}

bool is_url(std::string_view name) {
  const std::size_t colon = name.find("://");
  if (colon == name.npos) return false;
  std::size_t begin = colon;
  while (begin > 0 && (std::isalnum(static_cast<unsigned char>(name[begin - 1])) != 0 ||
                       std::string_view("+.-").find(name[begin - 1]) != std::string_view::npos))
    --begin;
  return colon - begin > 1;  // a drive letter is none
}

OpenFile OpenFile::failed(Fault fault, std::string reason, std::string hint) {
  OpenFile file;
  file.fault_ = fault;
  file.reason_ = std::move(reason);
  file.hint_ = std::move(hint);
  return file;
}

OpenFile OpenFile::received(Descriptor descriptor, std::string path) {
  struct stat about {};
  if (!descriptor || ::fstat(descriptor.get(), &about) != 0 || !S_ISREG(about.st_mode))
    return failed(Fault::NotRegular, kNotRegular);
  OpenFile file;
  file.descriptor_ = std::move(descriptor);
  file.fault_ = Fault::None;
  file.size_ = static_cast<std::uint64_t>(about.st_size);
  file.path_ = std::move(path);
  return file;
}

std::string OpenFile::descriptor_path() const {
  std::string path = fmt::format("/proc/self/fd/{}", descriptor());
  return ::access(path.c_str(), R_OK) == 0 ? path : path_;
}

std::string OpenFile::read(std::size_t most) {
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  std::string content;
  while (content.size() < most) {
    const std::size_t used = content.size();
    const std::size_t left = size_ > used ? static_cast<std::size_t>(size_ - used) : kChunk;
    content.resize(used + std::min(most - used, left));
    const ssize_t got = ::read(descriptor(), content.data() + used, content.size() - used);
    if (got < 0 && errno == EINTR) {
      content.resize(used);
      continue;
    }
    content.resize(used + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got <= 0) break;
  }
  return content;
}

OpenFile open_regular(const std::string& path) {
  using Fault = OpenFile::Fault;
  const auto unreadable = [](int error) {
    return OpenFile::failed(Fault::Missing, std::generic_category().message(error));
  };
  struct stat about {};
  // Opening a device may have effects, so its kind is examined before.
  if (::stat(path.c_str(), &about) != 0) return unreadable(errno);
  if (S_ISDIR(about.st_mode)) return OpenFile::failed(Fault::NotRegular, "it is a folder");
  if (!S_ISREG(about.st_mode)) return OpenFile::failed(Fault::NotRegular, kNotRegular);
  Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (!descriptor) return unreadable(errno);
  if (is_of_kernel(descriptor.get())) return OpenFile::failed(Fault::NotRegular, kNotRegular);
  std::string name = path_of(descriptor.get());
  if (name.empty()) name = resolved(path);  // no /proc
  return OpenFile::received(std::move(descriptor), std::move(name));
}

FileAccess FileAccess::by(Opener opener) {
  FileAccess access;
  access.opener_ = std::move(opener);
  return access;
}

void FileAccess::permit(const std::string& path) {
  if (opener_) return;
  std::string folder = resolved(path);
  if (!folder.empty() &&
      std::find(permitted_.begin(), permitted_.end(), folder) == permitted_.end())
    permitted_.push_back(std::move(folder));
}

bool FileAccess::permits_resolved(const std::string& path, FileUse use) const {
  if (use == FileUse::Asset && !untrusted_) return true;
  return std::any_of(permitted_.begin(), permitted_.end(),
                     [&](const std::string& folder) { return lies_below(path, folder); });
}

bool FileAccess::permits(const std::string& path, FileUse use) const {
  return opener_ ? bool(opener_(path, use))
                 : !is_url(path) && permits_resolved(resolved(path), use);
}

OpenFile FileAccess::open(const std::string& path, FileUse use) const {
  using Fault = OpenFile::Fault;
  if (opener_) return opener_(path, use);
  const auto outside = [&](const std::string& where) {
    return OpenFile::failed(
        Fault::Outside, "it lies outside of the folders that the scene may read",
        fmt::format("if you trust it, --allow {} permits it",
                    fs::path(where.empty() ? path : where).parent_path().string()));
  };
  if (is_url(path))
    return OpenFile::failed(Fault::Url, "it is a URL, and only files are read",
                            "download it into the folder of the scene");
  const std::string name = resolved(path);
  std::error_code error;
  // The author of an own scene may know whether a file exists; that of an untrusted scene may not.
  if (!permits_resolved(name, use) && (untrusted_ || fs::exists(name, error))) return outside(name);
  OpenFile file = open_regular(path);
  if (file && !permits_resolved(file.path(), use)) return outside(file.path());
  return file;
}

}  // namespace oriel
