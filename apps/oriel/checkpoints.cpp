// SPDX-License-Identifier: Apache-2.0
#include "checkpoints.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>

#include "base/input_files.h"
#include "checkpoint_labels.h"
#include "command.h"
#include "interrupt.h"
#include "parts.h"
#include "progress_line.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

/// Default interval. Writing then takes at most a hundredth of the time: after a slow write the
/// interval is longer.
constexpr double kCheckpointSeconds = 300, kCheckpointShare = 0.01;

/// Labels that say where in the render the checkpoint is.
constexpr const char *kFrameLabel = "at frame", *kEyeLabel = "at eye", *kFinishedLabel = "at end";

constexpr std::string_view kNotePrefix = "at ";

}  // namespace

std::optional<double> take_checkpoint_seconds(std::string& checkpoint) {
  constexpr std::string_view kEvery = ",every";
  if (const std::size_t at = checkpoint.rfind(kEvery); at != checkpoint.npos) {
    std::string number = checkpoint.substr(at + kEvery.size());
    number.erase(0, number.find_first_not_of(" ="));
    double seconds = 0;
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), seconds);
    if (error != std::errc() || end != number.data() + number.size() || !(seconds > 0))
      throw UsageError(fmt::format(
          "--checkpoint {}: expected FILE or \"FILE,every SECONDS\" with a positive number",
          checkpoint));
    checkpoint.resize(at);
    return seconds;
  }
  return std::nullopt;
}

CheckpointLabels labels_of_picture(const std::string& scene, const CheckpointLabels& options,
                                   const RenderSession& session) {
  const std::string folder = fs::path(scene).parent_path().string();
  CheckpointLabels labels = options;
  labels[kProgramLabel] = program_label();
  add_session_labels(session, labels);
  add_file_labels(folder, InputKind::Scene, labels);
  add_file_labels(folder, InputKind::Frame, labels);
  return labels;
}

void erase_notes(CheckpointLabels& labels) {
  std::erase_if(labels, [](const auto& label) { return label.first.starts_with(kNotePrefix); });
}

std::optional<RenderPlace> place_of_labels(const CheckpointLabels& labels) {
  const auto frame = label_number(labels, kFrameLabel, std::numeric_limits<int>::max());
  const auto eye = label_number(labels, kEyeLabel, static_cast<int>(Eye::Right));
  if (!frame || !eye) return std::nullopt;
  return RenderPlace{*frame, static_cast<Eye>(*eye)};
}

CheckpointRequest checkpoint_request(const std::string& checkpoint, const std::string& resume) {
  CheckpointRequest request;
  request.resume = resume;
  request.file = checkpoint;
  request.seconds = take_checkpoint_seconds(request.file);
  if (request.file.empty() && !checkpoint.empty())
    throw UsageError(fmt::format("--checkpoint {}: the name of the file is missing", checkpoint));
  request.may_start = !resume.empty() && request.file == resume;
  if (request.file.empty()) request.file = resume;
  if (request.file.empty()) return request;
  const auto fault = [&](const std::string& why) {
    return UserError(fmt::format("cannot write the checkpoint '{}': {}", request.file, why));
  };
  const fs::path folder = fs::path(request.file).parent_path();
  if (!folder.empty() && !fs::is_directory(folder))
    throw fault(fmt::format("there is no folder '{}'", folder.string()));
  if (const std::string why = target_fault(request.file); !why.empty()) throw fault(why);
  if (request.file == resume) return request;
  if (const std::string why = own_file_fault(request.file, kCheckpointMagic, "checkpoint of Oriel");
      !why.empty())
    throw fault(why);
  if (!first_bytes(request.file, 1).empty())
    throw fault(
        fmt::format("it contains an unfinished render; continue it with --resume {}, or "
                    "remove it",
                    request.file));
  return request;
}

Checkpoints::Checkpoints(const CheckpointRequest& request, const std::string& scene,
                         const CheckpointLabels& options, Diagnostics& diagnostics)
    : request_(request),
      scene_(scene),
      folder_(fs::path(scene).parent_path().string()),
      options_(options),
      diagnostics_(diagnostics) {
  if (!writes()) return;
  options_[kProgramLabel] = program_label();
  schedule();
  if (request_.resume.empty()) return;
  if (std::error_code error;
      request_.may_start && !fs::exists(fs::symlink_status(request_.resume, error))) {
    if (!request_.starts_quietly)
      diagnostics_.note(
          "OR-RN-074", {},
          fmt::format("there is no checkpoint '{}' yet; the render starts", request_.resume));
    return;
  }
  try {
    resumed_ = std::make_unique<CheckpointReader>(request_.resume);
  } catch (const CheckpointError& e) {
    refuse(e.what(), "render without --resume");
  }
  const CheckpointLabels& labels = resumed_->labels();
  if (const auto found = labels.find(kProgramLabel);
      found == labels.end() || found->second != options_[kProgramLabel])
    refuse(fmt::format("it was written by {}, and this is {}",
                       found == labels.end() ? "another program" : shown_label(found->second),
                       options_[kProgramLabel]),
           "resume it with that program, or render without --resume");
  const auto place = place_of_labels(labels);
  const auto finished = label_number(labels, kFinishedLabel, 1);
  if (!place || !finished) refuse("it is damaged", "render without --resume");
  resumed_place_ = *place;
  resumed_is_finished_ = *finished == 1;
}

void Checkpoints::refuse(const std::string& why, const std::string& what_to_do) const {
  throw UserError(fmt::format("cannot resume '{}': {}; {}", request_.resume, why, what_to_do));
}

bool Checkpoints::is_finished(RenderPlace place) const {
  if (!resumed_) return false;
  return place < resumed_place_ || (resumed_is_finished_ && place == resumed_place_);
}

void Checkpoints::require_same(const CheckpointLabels& here, bool of_finished) const {
  CheckpointLabels there = resumed_->labels();
  erase_notes(there);
  // Between pictures it is unknown which files the next one reads.
  const std::string difference = label_difference(there, here, of_finished);
  if (!difference.empty())
    refuse("it belongs to another render: " + difference,
           "use the same scene and options, or render without --resume");
}

void Checkpoints::begin(RenderPlace place, RenderSession& session) {
  if (!writes()) return;
  place_ = place;
  picture_labels_ = labels_of_picture(scene_, options_, session);
  if (!resumed_) return;
  if (!resumed_is_finished_) {
    if (place != resumed_place_)
      refuse(fmt::format("it contains frame {}, which is not rendered", resumed_place_.frame),
             "use the same --frames, or render without --resume");
    require_same(picture_labels_, false);
    try {
      session.restore(*resumed_);
    } catch (const CheckpointError& e) {
      refuse(e.what(), "render without --resume");
    }
    const Progress p = session.progress();
    diagnostics_.note("OR-RN-075", {},
                      fmt::format("resumed '{}': {:.4g} samples, {}", request_.resume,
                                  session.film().mean_samples(), duration_text(p.elapsed)));
  } else {
    CheckpointLabels here = options_;
    add_file_labels(folder_, InputKind::Scene, here);
    require_same(here, true);
  }
  resumed_.reset();
}

bool Checkpoints::is_due() const {
  return checkpoint_requested() || Clock::now() >= next_.load(std::memory_order_relaxed);
}

void Checkpoints::schedule() {
  const double seconds =
      request_.seconds.value_or(std::max(kCheckpointSeconds, write_seconds_ / kCheckpointShare));
  // Years are more than the clock counts.
  constexpr double kMaxSeconds = 1e8;
  next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                             std::chrono::duration<double>(std::min(seconds, kMaxSeconds)));
}

bool Checkpoints::write(RenderSession& session, bool at_end) {
  if (!writes() || !session.can_save()) return true;
  CheckpointLabels labels = picture_labels_;
  const CheckpointLabels place = labels_of(place_, false);
  labels.insert(place.begin(), place.end());
  labels.insert(notes_.begin(), notes_.end());
  return write_file(labels, &session, at_end);
}

CheckpointLabels Checkpoints::labels_of(RenderPlace place, bool finished) const {
  return {{kFrameLabel, std::to_string(place.frame)},
          {kEyeLabel, std::to_string(static_cast<int>(place.eye))},
          {kFinishedLabel, finished ? "1" : "0"}};
}

void Checkpoints::end_picture(RenderPlace place) {
  if (!writes()) return;
  CheckpointLabels labels = labels_of(place, true);
  labels.insert(options_.begin(), options_.end());
  add_file_labels(folder_, InputKind::Scene, labels);
  write_file(labels, nullptr, false);
}

bool Checkpoints::write_file(const CheckpointLabels& labels, RenderSession* session, bool at_end) {
  const Clock::time_point start = Clock::now();
  checkpoint_requested() = false;
  std::string failure;
  try {
    CheckpointWriter out(request_.file, labels);
    if (session) session->save(out);
    out.commit();
  } catch (const std::exception& e) {
    failure = e.what();
  }
  write_seconds_ = std::chrono::duration<double>(Clock::now() - start).count();
  schedule();
  write_failed_ = !failure.empty();
  if (failure.empty()) return true;
  diagnostics_.report(
      at_end ? Severity::Error : Severity::Warning, "OR-RN-073", {},
      fmt::format("cannot write the checkpoint '{}': {}; {}", request_.file, failure,
                  at_end ? "the render cannot be resumed from here"
                         : "it is tried again after the next interval"));
  return false;
}

bool Checkpoints::can_resume() const {
  return writes() && !write_failed_ &&
         first_bytes(request_.file, kCheckpointMagic.size()) == kCheckpointMagic;
}

void Checkpoints::remove() {
  if (!writes() || first_bytes(request_.file, kCheckpointMagic.size()) != kCheckpointMagic) return;
  std::error_code ignored;
  fs::remove(request_.file, ignored);
}

}  // namespace oriel::app
