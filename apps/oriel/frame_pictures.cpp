// SPDX-License-Identifier: Apache-2.0
#include "frame_pictures.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <exception>
#include <filesystem>
#include <optional>
#include <utility>

#include "output/output_request.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

/// The file with another path and the same type.
PictureFile moved_to(const std::string& path, const PictureFile& file) {
  PictureFile moved = file;
  if (moved.format.empty()) {
    const std::string suffix = fs::path(file.path).extension().string();
    moved.format = suffix.empty() ? suffix : suffix.substr(1);
  }
  moved.path = path;
  return moved;
}

/// The suffix of a picture: that of the name if it is one, else the type of the file.
std::string picture_suffix(const PictureFile& file) {
  if (has_picture_suffix(file.path)) return fs::path(file.path).extension().string();
  return "." + (file.format.empty() ? std::string("exr") : file.format);
}

/// Why the file was not written; nothing if it was.
std::optional<std::string> failure_of(const PictureFile& file, const FramePictures::Writer& write) {
  try {
    write(file);
    return std::nullopt;
  } catch (const std::exception& e) {
    return e.what();
  }
}

/// A path in a new folder of the temporary folder; empty if it cannot be created.
std::string temporary_path(const PictureFile& file) {
  std::error_code error;
  std::string folder = (fs::temp_directory_path(error) / "oriel-XXXXXX").string();
  if (error || mkdtemp(folder.data()) == nullptr) return {};
  std::string stem = fs::path(file.path).stem().string();
  stem.erase(0, stem.find_first_not_of('.'));
  return (fs::path(folder) / ((stem.empty() ? "picture" : stem) + picture_suffix(file))).string();
}

}  // namespace

std::string FramePictures::part_path(const PictureFile& file) const {
  const fs::path path(file.path);
  const std::string stem =
      has_picture_suffix(file.path) ? path.stem().string() : path.filename().string();
  std::string part;
  std::string mark;
  do {
    mark += ".part";
    part = (path.parent_path() / (stem + mark + picture_suffix(file))).string();
  } while (targets_.contains(part));
  return part;
}

void FramePictures::warn(const std::string& path, const std::string& why) {
  if (reported_.insert(path).second)
    diagnostics_.warning("OR-RN-065", where_, why + "; it is tried again at the end of the render");
}

bool FramePictures::test(const std::vector<std::string>& paths, SourceLocation where) {
  where_ = where;
  targets_ = {paths.begin(), paths.end()};
  reported_.clear();
  parts_.clear();
  written_.clear();
  std::map<std::string, std::string> faults;
  for (const std::string& path : targets_)
    if (const std::string fault = output_fault(path, roots_); !fault.empty())
      faults[path] = fmt::format("cannot write '{}': {}", path, fault);
  const bool none = faults.size() == targets_.size();
  for (const auto& [path, why] : faults) {
    if (none)
      diagnostics_.error("OR-RN-065", where_, why);
    else
      warn(path, why);
  }
  return !none;
}

void FramePictures::write_pass(const std::vector<PictureFile>& files, const Writer& write) {
  for (const PictureFile& file : files) {
    const std::string path = live_ ? file.path : part_path(file);
    const auto failure = failure_of(moved_to(path, file), write);
    if (failure) warn(file.path, *failure);
    if (!failure && !live_) parts_.insert(path);
  }
}

void FramePictures::write_final(const std::vector<PictureFile>& files, PictureState state,
                                const Writer& write) {
  written_.clear();
  if (state == PictureState::Empty) return;
  for (const PictureFile& file : files) {
    const std::string part = part_path(file);
    std::error_code error;
    const bool keeps_old = state == PictureState::FirstPass && fs::exists(file.path, error);
    const std::string target = keeps_old ? part : file.path;
    const std::string fault = keeps_old ? std::string() : output_fault(file.path, roots_);
    const auto failure = fault.empty()
                             ? failure_of(moved_to(target, file), write)
                             : std::optional(fmt::format("cannot write '{}': {}", target, fault));
    if (failure) {
      write_elsewhere(file, *failure, write);
      continue;
    }
    written_.push_back(target);
    if (!keeps_old && parts_.erase(part) > 0) fs::remove(part, error);
  }
}

void FramePictures::write_elsewhere(const PictureFile& file, const std::string& why,
                                    const Writer& write) {
  const auto error = [&](const std::string& consequence) {
    diagnostics_.error("OR-RN-065", where_, why + "; " + consequence);
  };
  const std::string part = part_path(file);
  if (!failure_of(moved_to(part, file), write)) {
    written_.push_back(part);
    return error(fmt::format("the picture is in '{}'", part));
  }
  const std::string temporary = temporary_path(file);
  if (!temporary.empty() && !failure_of(moved_to(temporary, file), write)) {
    written_.push_back(temporary);
    return error(fmt::format("the picture is in '{}'", temporary));
  }
  std::error_code ignored;
  if (!temporary.empty()) fs::remove(fs::path(temporary).parent_path(), ignored);
  error(parts_.contains(part) ? fmt::format("an earlier pass is in '{}'", part)
                              : "the picture is lost");
}

}  // namespace oriel::app
