// SPDX-License-Identifier: Apache-2.0
// The end of a picture: its last line, and whether it is complete.
#pragma once

#include <string>
#include <vector>

#include "render/session.h"

namespace oriel::app {

/// Prints the event "done".
void print_done_line(const RenderSession& session, StopReason reason,
                     const std::vector<std::string>& files);

/// One line for people: files, samples, noise and time. Nothing without files.
void print_summary(const RenderSession& session, StopReason reason,
                   const std::vector<std::string>& files);

/// Whether nothing that was asked for is missing. Errors that shaders report (mi_error) do not
/// count: the shader has returned a result all the same.
bool is_complete(const Diagnostics& diagnostics);

}  // namespace oriel::app
