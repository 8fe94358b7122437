// SPDX-License-Identifier: Apache-2.0
#include "frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <optional>

#include "command.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

constexpr int kLastFrame = std::numeric_limits<int>::max();

std::optional<int> number_of(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 1) return std::nullopt;
  return number;
}

}  // namespace

FrameList::FrameList(const std::string& text) {
  const auto refuse = [&] {
    throw UsageError(fmt::format(
        "--frames {}: write numbers from 1 on, as 1..20 or 3,7,12..15 or 8.. to the end", text));
  };
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string_view part = std::string_view(text).substr(at, end - at);
    const std::size_t dots = part.find("..");
    const auto first = number_of(part.substr(0, dots));
    auto last = first;
    if (dots != part.npos)
      last = dots + 2 == part.size() ? kLastFrame : number_of(part.substr(dots + 2));
    if (!first || !last || *last < *first) refuse();
    ranges_.emplace_back(*first, *last);
    at = end + 1;
  }
}

bool FrameList::holds(int frame) const {
  return ranges_.empty() || std::any_of(ranges_.begin(), ranges_.end(), [&](const auto& r) {
           return r.first <= frame && frame <= r.second;
         });
}

bool FrameList::goes_on_from(int frame) const {
  return ranges_.empty() || std::any_of(ranges_.begin(), ranges_.end(),
                                        [&](const auto& r) { return frame <= r.second; });
}

std::string frame_path(const std::string& path, int frame) {
  const fs::path p(path);
  std::string name = p.filename().string();
  const std::size_t first = name.find('#');
  if (first != std::string::npos) {
    const std::size_t end = std::min(name.find_first_not_of('#', first), name.size());
    name.replace(first, end - first, fmt::format("{:0{}}", frame, end - first));
  } else if (frame > 1) {
    name = fmt::format("{}.{:04}{}", p.stem().string(), frame, p.extension().string());
  }
  return (p.parent_path() / name).string();
}

void FrameFiles::begin(int frame, const std::vector<std::string>& outputs,
                       const scene::Camera* camera, const OutputRoots& roots,
                       const std::string& otherwise) {
  if (frame != frame_) taken_ = known_;
  frame_ = frame;
  expected_.clear();
  eyes_ = camera ? eyes_of(*camera) : std::vector{Eye::Middle};
  for (const std::string& output : outputs) expected_.push_back(frame_path(output, frame));
  if (!outputs.empty()) return;
  std::vector<std::string> named;
  if (camera) {
    for (const scene::Output& output : camera->outputs)
      if (output.shaders.empty()) named.push_back(output.file);
    for (const scene::FrameBuffer& buffer : camera->frame_buffers)
      if (!buffer.filename.empty()) named.push_back(buffer.filename);
  }
  for (const std::string& file : named) {
    const std::string path = output_place(file, roots).path;
    if (path.empty()) continue;
    known_.insert(path);
    expected_.push_back(path_of(path));
  }
  if (expected_.empty()) expected_.push_back(frame_path(otherwise, frame));
}

std::string FrameFiles::path_of(const std::string& path) const {
  return taken_.contains(path) || path.find('#') != std::string::npos ? frame_path(path, frame_)
                                                                      : path;
}

std::vector<std::string> FrameFiles::all() const {
  std::vector<std::string> paths;
  for (const std::string& path : expected_)
    for (const Eye eye : eyes_) paths.push_back(eye_path(path, eye));
  return paths;
}

bool FrameFiles::all_exist() const {
  const std::vector<std::string> paths = all();
  return std::all_of(paths.begin(), paths.end(), [](const std::string& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
  });
}

}  // namespace oriel::app
