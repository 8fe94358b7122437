// SPDX-License-Identifier: Apache-2.0
#include "part_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "checkpoint_labels.h"
#include "command.h"

namespace oriel::app {
namespace {

constexpr int kMostRounds = 1000000;

CheckpointLabels without_notes(CheckpointLabels labels) {
  erase_notes(labels);
  return labels;
}

}  // namespace

PartSet::PartSet(const std::vector<std::string>& paths) {
  // A file that is named twice is one file.
  std::set<std::string> known;
  for (const std::string& path : paths) {
    std::error_code error;
    const auto file = std::filesystem::weakly_canonical(path, error);
    if (known.insert(error ? path : file.string()).second) read(path);
  }
  require_one_render();
  require_all_parts();
}

void PartSet::fault(const std::string& path, const std::string& why) {
  faults_.push_back(fmt::format("'{}': {}", path, why));
}

void PartSet::read(const std::string& path) try {
  const CheckpointReader in(path);
  const CheckpointLabels& labels = in.labels();
  const auto program = labels.find(kProgramLabel);
  if (program == labels.end() || program->second != program_label())
    return fault(path, fmt::format("it was written by {}, and this is {}",
                                   program == labels.end() ? "another program"
                                                           : shown_label(program->second),
                                   program_label()));
  const auto name = labels.find(kPartNote);
  const auto part = name == labels.end() ? std::nullopt : part_of_name(name->second);
  const auto place = place_of_labels(labels);
  const auto round = label_number(labels, kRoundNote, kMostRounds);
  if (!part || !place || !round) return fault(path, "it is not a part of a picture");
  if (label_number(labels, kPartEndNote, 1) != 1)
    fault(path,
          fmt::format("part {} is not finished; render it again, it continues", part_name(*part)));
  files_.push_back({path, *part, *place, *round, labels});
} catch (const CheckpointError& e) {
  fault(path, e.what());
}

void PartSet::require_one_render() {
  // The render of most files is the one that is merged.
  std::map<CheckpointLabels, std::size_t> renders;
  for (const PartFile& file : files_) ++renders[without_notes(file.labels)];
  const auto most =
      std::max_element(renders.begin(), renders.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  std::map<int, std::size_t> counts;
  for (const PartFile& file : files_) ++counts[file.part.count];
  const auto count =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<PartFile> same;
  for (PartFile& file : files_) {
    const std::string difference = label_difference(without_notes(file.labels), most->first, false);
    if (!difference.empty())
      fault(file.path, "it belongs to another render than the other parts: " + difference);
    else if (file.part.count != count->first)
      fault(file.path, fmt::format("it is part {}, and the other files are parts of {}",
                                   part_name(file.part), count->first));
    else
      same.push_back(std::move(file));
  }
  files_ = std::move(same);
  std::stable_sort(files_.begin(), files_.end(), [](const PartFile& a, const PartFile& b) {
    return a.place == b.place ? a.part.number < b.part.number : a.place < b.place;
  });
}

void PartSet::require_all_parts() {
  for (std::size_t begin = 0, end = 0; begin < files_.size(); begin = end) {
    const PartFile& first = files_[begin];
    while (end < files_.size() && files_[end].place == first.place) ++end;
    int last_round = 0, expected = 1;
    for (std::size_t i = begin; i < end; ++i) last_round = std::max(last_round, files_[i].round);
    const auto missing_until = [&](int number) {
      for (; expected < number; ++expected)
        fault(part_path(first.path, {expected, first.part.count}),
              fmt::format("part {} is missing", part_name({expected, first.part.count})));
    };
    for (std::size_t i = begin; i < end; ++i) {
      const PartFile& file = files_[i];
      missing_until(file.part.number);
      if (file.part.number < expected)
        fault(file.path,
              fmt::format("it is part {}, as is '{}'", part_name(file.part), files_[i - 1].path));
      if (file.round < last_round)
        fault(file.path, fmt::format("part {} has not rendered round {}; render it again, it "
                                     "continues",
                                     part_name(file.part), last_round));
      expected = file.part.number + 1;
    }
    missing_until(first.part.count + 1);
  }
}

std::string PartSet::note(const char* name) const {
  if (files_.empty()) return {};
  const auto found = files_.front().labels.find(name);
  return found == files_.front().labels.end() ? std::string() : found->second;
}

std::vector<std::string> PartSet::words() const {
  const nlohmann::json words = nlohmann::json::parse(note(kCommandNote), nullptr, false);
  std::vector<std::string> result;
  if (words.is_array())
    for (const nlohmann::json& word : words)
      if (word.is_string()) result.push_back(word.get<std::string>());
  return result;
}

std::string PartSet::folder() const { return note(kFolderNote); }

std::string PartSet::frames() const {
  std::set<int> frames;
  for (const PartFile& file : files_) frames.insert(file.place.frame);
  return fmt::format("{}", fmt::join(frames, ","));
}

std::vector<const PartFile*> PartSet::parts_of(RenderPlace place) const {
  std::vector<const PartFile*> parts;
  for (const PartFile& file : files_)
    if (file.place == place) parts.push_back(&file);
  return parts;
}

}  // namespace oriel::app
