// SPDX-License-Identifier: Apache-2.0
// What identifies the render of a checkpoint: the program, and the options and files that decide
// the picture.
#pragma once

#include <string>

#include "base/checkpoint_file.h"
#include "base/input_files.h"
#include "render/session.h"

namespace oriel::app {

struct RenderArguments;

inline constexpr const char* kProgramLabel = "program";

/// Version and build of this program: the checksum of its file.
std::string program_label();

/// The options of the command line that decide the pictures, as they were given.
CheckpointLabels option_labels(const RenderArguments& a);

/// Adds the settings of the session that decide the values of the film, some of them in place of
/// options. Options that decide only
/// how files show them, such as --bits, are not part of it, nor are threads and time limits.
void add_session_labels(const RenderSession& session, CheckpointLabels& labels);

/// Adds the checksums of the input files of one kind, named relative to the folder of the scene, or
/// by their last component if they are elsewhere. Files above 64 MB that are not text of the scene
/// count by size and modification time.
void add_file_labels(const std::string& folder, InputKind kind, CheckpointLabels& labels);

/// The first differences in words; empty if there is none. `some`: labels that are only in `here`
/// do not count.
std::string label_difference(const CheckpointLabels& there, const CheckpointLabels& here,
                             bool some);

/// A text of a file for messages: shortened, and without control characters.
std::string shown_label(const std::string& text);

}  // namespace oriel::app
