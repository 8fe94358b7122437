// SPDX-License-Identifier: Apache-2.0
// The option --denoiser of the commands that denoise.
#pragma once

#include <string>

#include "command.h"
#include "denoise/denoise.h"

namespace oriel::app {

/// Adds --denoiser; the value is for denoiser_of().
void add_denoiser_option(CLI::App& app, std::string& name);

/// The denoiser of a value that the option accepted; empty: the best.
Denoiser denoiser_of(const std::string& name);

}  // namespace oriel::app
