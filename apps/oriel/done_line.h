// SPDX-License-Identifier: Apache-2.0
// The last line of a picture that --json prints.
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

}  // namespace oriel::app
