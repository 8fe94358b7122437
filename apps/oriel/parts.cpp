// SPDX-License-Identifier: Apache-2.0
#include "parts.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "checkpoint_labels.h"
#include "command.h"
#include "render_frames.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxRounds = 1000000;

/// "2", separator, "7".
std::optional<PicturePart> part_of_text(std::string_view text, std::string_view separator) {
  const std::size_t at = text.find(separator);
  if (at == text.npos) return std::nullopt;
  PicturePart part{0, 0};
  const auto number = [](std::string_view digits, int& value) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() && end == digits.data() + digits.size();
  };
  if (!number(text.substr(0, at), part.number) ||
      !number(text.substr(at + separator.size()), part.count) || part.number < 1 ||
      part.count > kMaxParts || part.number > part.count)
    return std::nullopt;
  return part;
}

CheckpointRequest request_of(const CheckpointRequest& request, const std::string& path) {
  CheckpointRequest own = request;
  own.file = own.resume = path;
  own.may_start = own.starts_quietly = true;
  return own;
}

}  // namespace

PicturePart read_part(const std::string& text) {
  if (const auto part = part_of_text(text, "/")) return *part;
  throw UsageError(
      fmt::format("--part {}: expected K/N with K from 1 to N, and N up to {}", text, kMaxParts));
}

std::string part_name(const PicturePart& part) {
  return fmt::format("{} of {}", part.number, part.count);
}

std::optional<PicturePart> part_of_name(const std::string& text) {
  return part_of_text(text, " of ");
}

std::string part_path(const std::string& picture, const PicturePart& part) {
  return fs::path(picture)
      .replace_extension(fmt::format(".part-{}-of-{}", part.number, part.count))
      .string();
}

std::string round_path(const std::string& picture_or_part) {
  return fs::path(picture_or_part).replace_extension(".round").string();
}

std::optional<int> label_number(const CheckpointLabels& labels, const std::string& name, int most) {
  const auto found = labels.find(name);
  if (found == labels.end()) return std::nullopt;
  const std::string& text = found->second;
  int value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > most)
    return std::nullopt;
  return value;
}

PartRender::PartRender(const RenderArguments& arguments, const CheckpointRequest& request,
                       const PicturePart& part, RenderPlace place, const std::string& picture,
                       Diagnostics& diagnostics)
    : part_(part),
      place_(place),
      path_(part_path(picture, part)),
      round_path_(round_path(picture)) {
  for (const std::string& resumed : {request.resume, request.file})
    if (!resumed.empty() && fs::path(resumed).filename() != fs::path(path_).filename())
      throw UsageError(fmt::format("--part {}/{} writes and continues '{}', not '{}'", part.number,
                                   part.count, path_, resumed));
  const fs::path folder = fs::path(path_).parent_path();
  std::error_code error;
  notes_[kCommandNote] = nlohmann::json(command_words()).dump();
  notes_[kFolderNote] = fs::current_path(error).string();
  notes_[kPartNote] = part_name(part);
  file_.emplace(request_of(request, path_), arguments.scene.path, option_labels(arguments),
                diagnostics);
}

void PartRender::write_notes(bool finished) {
  notes_[kRoundNote] = std::to_string(round_);
  notes_[kPartEndNote] = finished ? "1" : "0";
  file_->set_notes(notes_);
}

void PartRender::begin(RenderSession& session) {
  const CheckpointLabels labels = file_->resumed_labels();
  if (!labels.empty()) {
    const auto found = labels.find(kPartNote);
    if (found == labels.end() || found->second != notes_[kPartNote])
      throw UserError(fmt::format("cannot continue '{}': it is not part {}; remove the file", path_,
                                  part_name(part_)));
    round_ = label_number(labels, kRoundNote, kMaxRounds).value_or(0);
    was_finished_ = label_number(labels, kPartEndNote, 1) == 1;
  }
  file_->begin(place_, session);
  read_round(session);
  write_notes(false);
}

void PartRender::read_round(RenderSession& session) {
  std::error_code error;
  if (!fs::exists(round_path_, error)) return;
  try {
    CheckpointReader in(round_path_);
    CheckpointLabels labels = in.labels();
    const int round = label_number(labels, kRoundNote, kMaxRounds).value_or(0);
    erase_notes(labels);
    const std::string difference = label_difference(labels, file_->picture_labels(), false);
    if (!difference.empty()) throw CheckpointError("it belongs to another render: " + difference);
    if (round <= round_) return;
    std::vector<std::uint32_t> targets;
    in.list(targets);
    in.end();
    session.raise_targets(targets);
    round_ = round;
    was_finished_ = false;
  } catch (const CheckpointError& e) {
    throw UserError(fmt::format("cannot use '{}': {}; remove the file", round_path_, e.what()));
  }
}

bool PartRender::end(RenderSession& session, bool finished) {
  write_notes(finished);
  return file_->write(session, true);
}

void write_round(const std::string& path, const CheckpointLabels& identity, int round,
                 const std::vector<std::uint32_t>& targets) {
  CheckpointLabels labels = identity;
  labels[kRoundNote] = std::to_string(round);
  CheckpointWriter out(path, labels);
  out.list(targets);
  out.commit();
}

}  // namespace oriel::app
