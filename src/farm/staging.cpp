// SPDX-License-Identifier: Apache-2.0
#include "farm/staging.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "base/checksum.h"
#include "base/input_files.h"
#include "farm/pack_layout.h"

namespace oriel::farm {
namespace {

namespace fs = std::filesystem;

/// Copies a folder with the modification times of its files, by which checkpoints recognise large
/// files.
void copy_folder(const fs::path& from, const fs::path& to, std::error_code& error) {
  fs::copy(from, to, fs::copy_options::recursive, error);
  if (error) return;
  for (const auto& entry : fs::recursive_directory_iterator(from, error))
    if (entry.is_regular_file(error))
      fs::last_write_time(to / entry.path().lexically_relative(from), entry.last_write_time(error),
                          error);
}

/// Whether the folder is complete and nobody else can change it.
bool is_own_copy(const fs::path& folder) {
  struct stat about {};
  return ::lstat(folder.c_str(), &about) == 0 && S_ISDIR(about.st_mode) &&
         about.st_uid == ::geteuid() && (about.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

}  // namespace

std::string staged_scene(const Job& job) {
  const std::string shared = job.path("scene");
  if (job.stage.empty()) return shared;
  Checksum64 sum;
  sum.add(job.folder.data(), job.folder.size());
  const std::uint64_t content =
      file_checksum(shared + "/" + kPackManifest, std::uint64_t{1} << 26) ^
      file_checksum(shared + "/" + job.scene, std::uint64_t{1} << 26);
  sum.add(&content, sizeof content);
  const fs::path target =
      fs::path(job.stage) / fmt::format("oriel-{}-{:016x}", job.name, sum.value());
  if (is_own_copy(target)) return target.string();
  std::error_code error;
  fs::create_directories(job.stage, error);
  std::string temporary = target.string() + "-XXXXXX";
  if (::mkdtemp(temporary.data()) != nullptr) {
    copy_folder(shared, temporary, error);
    // Another task may have been faster.
    if (!error) fs::rename(temporary, target, error);
    if (error) {
      std::error_code ignored;
      fs::remove_all(temporary, ignored);
    }
    if (is_own_copy(target)) return target.string();
  }
  fmt::print(stderr, "oriel: the scene cannot be copied to '{}'; it is read from '{}'\n",
             target.string(), shared);
  return shared;
}

}  // namespace oriel::farm
