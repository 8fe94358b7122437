// SPDX-License-Identifier: Apache-2.0
#include "maps_file.h"

#include <fmt/format.h>

#include <filesystem>

#include "checkpoint_labels.h"
#include "command.h"
#include "render_frames.h"

namespace oriel::app {
namespace {

constexpr const char* kMapsNote = "at maps";

}  // namespace

std::string maps_path(const std::string& folder, RenderPlace place) {
  const std::string name = eye_path(fmt::format("frame-{:04}.maps", place.frame), place.eye);
  return (std::filesystem::path(folder) / name).string();
}

void write_maps(const RenderArguments& arguments, RenderPlace place, RenderSession& session) {
  const std::string path = maps_path(arguments.maps_only, place);
  try {
    std::filesystem::create_directories(arguments.maps_only);
    CheckpointLabels labels =
        labels_of_picture(arguments.scene.path, option_labels(arguments), session);
    labels[kMapsNote] = "all";
    CheckpointWriter out(path, labels);
    session.save_maps(out);
    out.commit();
  } catch (const std::exception& e) {
    throw UserError(fmt::format("cannot write the maps '{}': {}", path, e.what()));
  }
}

void read_maps(const RenderArguments& arguments, RenderPlace place, RenderSession& session) {
  const std::string path = maps_path(arguments.maps, place);
  try {
    CheckpointReader in(path);
    CheckpointLabels labels = in.labels();
    if (!labels.contains(kMapsNote)) throw CheckpointError("it does not contain maps");
    erase_notes(labels);
    const std::string difference = label_difference(
        labels, labels_of_picture(arguments.scene.path, option_labels(arguments), session), false);
    if (!difference.empty())
      throw CheckpointError("it belongs to another render: " + difference +
                            "; write it again with --maps-only and the same options");
    session.read_maps(in);
  } catch (const CheckpointError& e) {
    throw UserError(fmt::format("cannot use the maps '{}': {}", path, e.what()));
  }
}

}  // namespace oriel::app
