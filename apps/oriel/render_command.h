// SPDX-License-Identifier: Apache-2.0
// What oriel render shares with commands that continue its renders.
#pragma once

namespace CLI {  // NOLINT(readability-identifier-naming): named by the library
class App;
}

namespace oriel::app {

struct RenderArguments;
struct RenderPlan;

/// All options of oriel render.
void add_render_options(CLI::App& command, RenderArguments& arguments);

/// Reads and renders the scene; returns the exit code.
int render_scene(const RenderArguments& arguments, const RenderPlan& plan);

}  // namespace oriel::app
